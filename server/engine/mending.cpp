// What becomes of commands when an exception interrupts the engine, for want of memory for example.
#include <utility>

#include "engine/executor.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

constexpr std::string_view interrupted = "the engine failed in the middle of it";

}  // namespace

void Executor::give_up(Command& command) noexcept {
    command.given_up = true;
    needs_mending_ = true;
}

// The rest of a sequence that cannot go on. What runs of it goes on by itself.
void Executor::give_up_waiting(Execution const& execution) noexcept {
    for (auto const& command : execution.commands())
        if (command->state == Command::State::waiting) give_up(*command);
}

// The request failed before any of its commands could run: they were never there.
void Executor::forget_made(Session& session, std::uint64_t after) noexcept {
    for (auto handle = after + 1; handle <= last_handle_; ++handle) {
        auto const made = live_.find(handle);
        if (made == live_.end()) continue;
        auto const known = session.commands.find(made->second->id);
        if (known != session.commands.end() && known->second == made->second) session.commands.erase(known);
        live_.erase(made);
    }
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

// A component whose answer was lost, or whose halt has no deadline.
void Executor::mend(RegisteredComponent& component, Instant now) {
    if (std::exchange(component.answer_lost, false)) halt(component, CompletedStatus::error, interrupted, now);
    if (component.halting && component.halting->due == Deadlines::Ticket{}) ask_to_halt(component, now);
}

void Executor::mend(Instant now) {
    Attempts attempts;
    if (!ready_.empty()) attempts([&] { run_ready(now); });
    bool const answers_lost = agenda_.take_lost_answers();
    if (std::exchange(needs_mending_, false) || answers_lost) {
        std::vector<SharedCommand> given_up;
        bool const listed = attempts([&] {
            for (auto const& [handle, command] : live_)
                if (command->given_up) given_up.push_back(command);
        });
        if (!listed) needs_mending_ = true;
        for (auto const& command : given_up) attempts([&] { end_given_up(command, now); });
        for (auto const& [ref, component] : registry_.all())
            if (!attempts([&] { mend(*component, now); })) needs_mending_ = true;
        attempts([&] { run_ready(now); });
    }
    attempts.rethrow();
}

}  // namespace rois
