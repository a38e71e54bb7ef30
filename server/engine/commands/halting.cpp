// Halts components until they confirm that they stand still (decision 35).
#include <algorithm>
#include <utility>

#include "engine/commands/executor.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds between_attempts{200};
constexpr std::ptrdiff_t most_stops_of_engines = 8;  // that wait for one halt

// Another engine has its own time to confirm, and asks again. Its `stop` waits until the halt is confirmed (decision 39):
// otherwise a component that always needs a little longer would never be confirmed over several levels.
bool is_stop_of_engine(std::shared_ptr<Command> const& command) {
    bool const waits = command->state == Command::State::running && command->session != nullptr;
    return waits && command->type == "stop" && command->session->is_engine && command->session->owner == nullptr;
}

// Takes the commands that do not wait longer for an unconfirmed halt.
std::vector<std::shared_ptr<Command>> take_late(UnconfirmedHalt& halting) {
    auto const first_late = std::ranges::stable_partition(halting.waiting, is_stop_of_engine).begin();
    std::vector<std::shared_ptr<Command>> late{first_late, halting.waiting.end()};
    halting.waiting.erase(first_late, halting.waiting.end());
    return late;
}

}  // namespace

void Executor::halt(RegisteredComponent& component, CompletedStatus status_of_start, std::string_view reason, Instant now) {
    ++component.stops;
    end_action(component, status_of_start, reason, now);
}

// Calls the component first, so that it is halted even if a later step fails.
void Executor::end_action(RegisteredComponent& component, CompletedStatus status_of_start, std::string_view reason, Instant now) {
    Attempts attempts;
    attempts([&] { ask_to_halt(component, now); });
    component.activity = RegisteredComponent::Activity::idle;
    component.suspended = Suspended::nothing;
    if (auto const start = std::exchange(component.start, nullptr)) attempts([&] { end(start, status_of_start, reason, now); });
    attempts([&] { end_each(std::exchange(component.functions, {}), CompletedStatus::abort, reason, now); });
    for (std::size_t i = 0; component.halting && i < component.halting->waiting.size(); ++i) {
        auto const waiting = component.halting->waiting[i];
        if (waiting->type != "stop") attempts([&] { end(waiting, CompletedStatus::abort, reason, now); });
    }
    attempts.rethrow();
}

// For a component that failed to begin an action but may move.
void Executor::halt_if_it_moves(RegisteredComponent& component, Instant now) {
    if (component.moves()) halt(component, CompletedStatus::abort, "the component failed", now);
}

// Needs no memory before the component is called.
void Executor::ask_to_halt(RegisteredComponent& component, Instant now) {
    if (component.has_departed()) return;
    auto const ticket = questions_.fresh_ticket();
    component.hosted().halt(ticket, now);
    ++component.halts;
    if (component.halting && component.halting->failed) return halt_again_later(component, now);
    if (!component.halting) component.halting.emplace().first = ticket;
    if (component.halting->due == Deadlines::Ticket{}) await_confirmation(component, now);
}

void Executor::await_confirmation(RegisteredComponent& component, Instant now) {
    needs_repair_ = true;  // if a later step throws, the next tick repairs
    component.halting->due =
        deadlines_.add(now.steady + time_to_confirm, [this, weak = component.weak_from_this()](Instant then) {
            auto const late = weak.lock();
            if (!late || !late->halting || late->halting->failed) return;
            std::string const reason = "the component did not confirm that it stands still";
            late->report_no_response(reason, Report::each, then.steady);
            halt_failed(*late, CompletedStatus::timeout, reason, then);
            run_ready(then);
        });
}

// Only a confirmed halt ends the state `failed`.
void Executor::halt_failed(RegisteredComponent& component, CompletedStatus status, std::string_view reason, Instant now) {
    if (!component.halting) component.halting.emplace();
    bool const first = !std::exchange(component.halting->failed, true);
    Attempts attempts;
    if (first) attempts([&] { trace_->halt_failed(component.ref().code, reason); });
    attempts([&] { halt_again_later(component, now); });
    auto& waiting = component.halting->waiting;
    attempts([&] {
        end_each(status == CompletedStatus::timeout ? take_late(*component.halting) : std::exchange(waiting, {}), status, reason,
                 now);
    });
    for (auto const& call : std::exchange(component.halting->over, {})) attempts([&] { call(now); });
    attempts.rethrow();
}

void Executor::halt_again_later(RegisteredComponent& component, Instant now) {
    auto& due = component.halting->due;
    deadlines_.cancel(std::exchange(due, {}));
    needs_repair_ = true;  // if a later step throws, the next tick repairs
    due = deadlines_.add(now.steady + between_attempts, [this, weak = component.weak_from_this()](Instant then) {
        auto const failed = weak.lock();
        if (!failed || !failed->halting) return;
        Attempts attempts;
        attempts([&] { end_each(take_late(*failed->halting), CompletedStatus::timeout, "the component failed to halt", then); });
        attempts([&] { ask_to_halt(*failed, then); });
        attempts([&] { run_ready(then); });
        attempts.rethrow();
    });
}

void Executor::halted(RegisteredComponent& component, Ticket ticket, Instant now) {
    if (!component.halting || ticket < component.halting->first) return count_stray_answer();
    go_on(component, now);
}

void Executor::halt_failed(RegisteredComponent& component, Ticket ticket, Instant now) {
    if (!component.halting || ticket < component.halting->first) return;
    halt_failed(component, CompletedStatus::error, "the component failed to halt", now);
    run_ready(now);
}

void Executor::go_on(RegisteredComponent& component, Instant now) {
    component.has_stood = component.stands_still = true;
    auto const halting = std::exchange(component.halting, {});
    if (!halting) return;
    deadlines_.cancel(halting->due);
    Attempts attempts;
    if (halting->failed) {
        component.clear_failure();
        attempts([&] { trace_->halted_at_last(component.ref().code); });
    }
    for (auto const& command : halting->waiting) {
        attempts([&] {
            if (command->type == "stop")
                end(command, CompletedStatus::ok, {}, now);
            else if (command->type == "start")
                attempt(command, [&] { go_on_with_start(command, now); });
            else
                attempt(command, [&] { run_function(command, now); });
        });
    }
    for (auto const& call : halting->over) attempts([&] { call(now); });
    attempts([&] { run_ready(now); });
    attempts.rethrow();
}

// A `stop`, or a `start` that replaces another one, continues when the halt is confirmed. If the halt has failed, a `stop` waits
// for the next attempt, which it has caused.
void Executor::wait_for_halt(SharedCommand const& command, Instant now) {
    auto& halting = *command->component->halting;
    if (halting.failed && command->type != "stop")
        return end(command, CompletedStatus::error, "the component failed to halt", now);
    halting.waiting.push_back(command);
    if (std::ranges::count_if(halting.waiting, is_stop_of_engine) <= most_stops_of_engines) return;
    auto const oldest = std::ranges::find_if(halting.waiting, is_stop_of_engine);
    auto const forgotten = std::move(*oldest);
    halting.waiting.erase(oldest);
    end(forgotten, CompletedStatus::timeout, "the component failed to halt", now);
}

// For a component that leaves the engine: ends the commands that wait for its halt.
void Executor::forget_halt(RegisteredComponent& component, Instant now) {
    auto const halting = std::exchange(component.halting, {});
    if (!halting) return;
    deadlines_.cancel(halting->due);
    Attempts attempts;
    attempts([&] { end_each(halting->waiting, CompletedStatus::abort, "its component was removed", now); });
    for (auto const& call : halting->over) attempts([&] { call(now); });
    attempts.rethrow();
}

}  // namespace rois
