// How components are halted, until they confirm that they stand still (decision 35), and held (decision 33).
#include <utility>

#include "engine/executor.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds time_to_confirm{500};
constexpr std::chrono::milliseconds between_attempts{200};

}  // namespace

// The component first: whatever becomes of the rest, it has been told.
void Executor::halt(RegisteredComponent& component, CompletedStatus status_of_start, std::string const& reason, Instant now) {
    ask_to_halt(component, now);
    component.activity = RegisteredComponent::Activity::idle;
    component.suspended = Suspended::nothing;
    if (auto const start = std::exchange(component.start, nullptr)) end(start, status_of_start, reason, now);
    for (auto const& function : std::exchange(component.functions, {})) end(function, CompletedStatus::abort, reason, now);
    if (!component.halting) return;
    auto const waiting = component.halting->waiting;
    for (auto const& command : waiting)
        if (command->type == "start") end(command, CompletedStatus::abort, reason, now);
}

// After it failed to begin something: it may have begun nevertheless.
void Executor::halt_what_moves(RegisteredComponent& component, Instant now) {
    if (component.moves()) halt(component, CompletedStatus::abort, "the component failed", now);
}

void Executor::ask_to_halt(RegisteredComponent& component, Instant now) {
    auto answer = Halted::not_yet;
    auto const report = component.halting ? Report::once : Report::each;
    auto const called = component.call([&](Component& c) { answer = c.halt(now); }, report);
    if (component.has_departed()) return;
    if (called == Called::ok && answer == Halted::confirmed) return go_on(component, now);
    if (called == Called::failed) return halt_failed(component, CompletedStatus::error, "the component failed to halt", now);
    if (component.halting) {
        if (component.halting->failed) halt_again_later(component, now);
        return;
    }
    component.halting.emplace().due =
        deadlines_.add(now.steady + time_to_confirm, [this, weak = component.weak_from_this()](Instant then) {
            auto const late = weak.lock();
            if (!late) return;
            std::string const reason = "the component did not confirm that it stands still";
            agenda_.add(ErrorOccurred{late.get(), ErrorType::component_not_responding, reason});
            halt_failed(*late, CompletedStatus::timeout, reason, then);
            run_ready(then);
        });
}

// Only a confirmed halt leads out of this state.
void Executor::halt_failed(RegisteredComponent& component, CompletedStatus status, std::string const& reason, Instant now) {
    if (!component.halting) component.halting.emplace();
    component.halting->failed = true;
    halt_again_later(component, now);
    for (auto const& command : std::exchange(component.halting->waiting, {})) end(command, status, reason, now);
}

void Executor::halt_again_later(RegisteredComponent& component, Instant now) {
    auto& due = component.halting->due;
    deadlines_.cancel(due);
    due = deadlines_.add(now.steady + between_attempts, [this, weak = component.weak_from_this()](Instant then) {
        auto const failed = weak.lock();
        if (!failed) return;
        ask_to_halt(*failed, then);
        run_ready(then);
    });
}

void Executor::halted(RegisteredComponent& component, Instant now) {
    if (!component.halting) ++stray_answers_;
    go_on(component, now);
}

void Executor::go_on(RegisteredComponent& component, Instant now) {
    auto const halting = std::exchange(component.halting, {});
    if (!halting) return;
    deadlines_.cancel(halting->due);
    if (halting->failed) component.succeeded();
    for (auto const& command : halting->waiting) {
        if (command->type == "stop")
            end(command, CompletedStatus::ok, {}, now);
        else
            go_on_with_start(command, now);
    }
    run_ready(now);
}

// A `stop`, or a `start` that takes the place of another one, goes on when the halt is confirmed.
void Executor::wait_for_halt(SharedCommand const& command, Instant now) {
    auto& halting = *command->component->halting;
    if (halting.failed) return end(command, CompletedStatus::error, "the component failed to halt", now);
    halting.waiting.push_back(command);
}

// The component goes, and with it what waits for its halt.
void Executor::forget_halt(RegisteredComponent& component, Instant now) {
    auto const halting = std::exchange(component.halting, {});
    if (!halting) return;
    deadlines_.cancel(halting->due);
    for (auto const& command : halting->waiting) end(command, CompletedStatus::abort, "its component has gone", now);
}

void Executor::hold(RegisteredComponent& component, std::string const& reason, Instant now) {
    bool const held = component.call([&](Component& c) { c.suspend(now); }) == Called::ok;
    if (held)
        component.suspended = Suspended::all;
    else
        halt(component, CompletedStatus::abort, reason, now);
    agenda_.add(ErrorOccurred{&component, ErrorType::user_defined_error,
                              (held ? "its motion is held: " : "its motion was stopped: ") + reason +
                                  (held ? "; resume goes on, and so does a new command" : "")});
    run_ready(now);
}

}  // namespace rois
