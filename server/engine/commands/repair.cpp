// Ends the commands that an exception in the engine interrupted, for example because memory ran out.
#include <utility>

#include "engine/commands/executor.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::string_view interrupted = "an error in the engine interrupted it";

}  // namespace

void Executor::give_up(Command& command) noexcept {
    command.given_up = true;
    needs_repair_ = true;
}

// Gives up the waiting commands of a sequence that cannot continue. The running commands of the sequence continue.
void Executor::give_up_waiting(Execution const& execution) noexcept {
    for (auto const& command : execution.commands())
        if (command->state == Command::State::waiting) give_up(*command);
}

// Removes the commands of a request that failed before any of them could run.
void Executor::forget_made(Session& session, std::uint64_t after) noexcept {
    for (auto handle = after + 1; handle <= last_handle_; ++handle) {
        auto const made = live_.find(handle);
        if (made == live_.end()) continue;
        auto const command = made->second;
        recorder_.never_mind(command);
        withdraw(&session, *command);
    }
}

void Executor::take_back(Session* session, Execution const& execution) noexcept {
    for (auto const& command : execution.commands()) {
        if (command->state == Command::State::ended) continue;
        command->state = Command::State::ended;
        command->finished = true;
        recorder_.never_mind(command);
        withdraw(session, *command);
        command->execution.reset();
    }
}

void Executor::withdraw(Session* session, Command const& command) noexcept {
    if (session != nullptr) {
        auto const known = session->commands.find(command.id);
        if (known != session->commands.end() && known->second.get() == &command) session->commands.erase(known);
    }
    live_.erase(static_cast<std::uint64_t>(command.handle));
}

void Executor::end_each(std::vector<SharedCommand> const& commands, CompletedStatus status, std::string_view reason,
                        Instant now) {
    Attempts attempts;
    for (auto const& command : commands) attempts([&] { end(command, status, reason, now); });
    attempts.rethrow();
}

void Executor::end_given_up(SharedCommand const& command, Instant now) {
    command->given_up = false;
    if (command->state == Command::State::ended) return attempt(command, [&] { finish(command, now); });
    bool const runs = command->state == Command::State::running;
    Attempts attempts;
    if (runs) attempts([&] { halt(*command->component, CompletedStatus::error, interrupted, now); });
    attempts([&] { end(command, runs ? CompletedStatus::error : CompletedStatus::abort, interrupted, now); });
    attempts.rethrow();
}

// Halts a component whose answer was lost, or whose halt has no deadline.
void Executor::repair(RegisteredComponent& component, Instant now) {
    if (component.hosted().take_lost_report()) halt(component, CompletedStatus::error, interrupted, now);
    if (component.halting && component.halting->due == Deadlines::Ticket{}) ask_to_halt(component, now);
}

void Executor::repair(Instant now, bool reports_lost) {
    Attempts attempts;
    if (!ready_.empty()) attempts([&] { run_ready(now); });
    if (std::exchange(needs_repair_, false) || reports_lost) {
        std::vector<SharedCommand> given_up;
        bool const listed = attempts([&] {
            for (auto const& [handle, command] : live_)
                if (command->given_up) given_up.push_back(command);
        });
        if (!listed) needs_repair_ = true;
        for (auto const& command : given_up) attempts([&] { end_given_up(command, now); });
        for (auto const& [ref, component] : registry_.all())
            if (!attempts([&] { repair(*component, now); })) needs_repair_ = true;
        attempts([&] { run_ready(now); });
    }
    attempts.rethrow();
}

}  // namespace rois
