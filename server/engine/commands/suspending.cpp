// Suspends and resumes components, and holds motion without signs of life (decision 33).
#include <utility>

#include "engine/commands/executor.hpp"

namespace rois {

namespace {

constexpr auto nothing_suspended = "nothing is suspended";

}  // namespace

void Executor::run_suspend(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    if (!component.works())
        return end(command, CompletedStatus::error,
                   component.suspended == Suspended::all ? "the component is suspended already" : "nothing is running", now);
    auto const ticket = ask_to_confirm(command, Suspended::all, now);
    component.hosted().suspend(ticket, now);
}

void Executor::run_resume(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    // The motion of a component of another engine may be held there.
    bool const may_be_suspended =
        component.suspended != Suspended::nothing || (component.confirms_binding() && component.works());
    if (!may_be_suspended) return end(command, CompletedStatus::error, nothing_suspended, now);
    auto const ticket = ask_to_confirm(command, Suspended::nothing, now);
    component.hosted().resume(ticket, now);
}

// A suspend or resume completes when the component has confirmed it. If it does not, its state is unknown.
Ticket Executor::ask_to_confirm(SharedCommand const& command, Suspended afterwards, Instant now) {
    bool const ends_nothing = afterwards == Suspended::nothing && command->component->suspended == Suspended::nothing;
    auto then = [this, command, afterwards, ends_nothing, halts = command->component->halts](
                    std::optional<ComponentAnswer>& answer, Instant when) {
        auto& component = *command->component;
        bool const confirmed = answer && std::holds_alternative<Done>(*answer);
        if (confirmed && component.halts == halts) component.suspended = afterwards;
        Attempts attempts;
        bool const stays_suspended = !confirmed && afterwards == Suspended::nothing && !ends_nothing;
        if (!answer || stays_suspended) attempts([&] { halt_if_it_moves(component, when); });
        attempts([&] {
            if (confirmed) return end(command, CompletedStatus::ok, {}, when);
            if (answer)
                return end(command, CompletedStatus::error, ends_nothing ? nothing_suspended : "the component failed", when);
            end(command, CompletedStatus::timeout, "the component did not confirm the suspend or resume in time", when);
        });
        attempts([&] { run_ready(when); });
        attempts.rethrow();
    };
    auto const* what = "the component did not confirm that it is suspended or resumed";
    return questions_.ask(*command->component, now.steady + time_to_confirm, what, std::move(then));
}

void Executor::hold(RegisteredComponent& component, std::string_view reason, Instant now) {
    auto then = [this, shared = component.shared_from_this(), reason = std::string{reason}, halts = component.halts](
                    std::optional<ComponentAnswer>& answer, Instant when) {
        shared->is_being_held = false;
        if (shared->halts != halts) return;
        if (answer && std::holds_alternative<Done>(*answer)) {
            shared->suspended = Suspended::all;
            agenda_.add({shared, ErrorType::user_defined_error,
                         "its motion is held: " + reason + "; to continue, send resume or a new command"});
            return;
        }
        stop_instead_of_hold(*shared, reason, when);
    };
    try {
        auto const* what = "the component did not confirm that its motion is held";
        auto const ticket = questions_.ask(component, now.steady + time_to_confirm, what, std::move(then));
        component.hosted().suspend(ticket, now);
        component.is_being_held = true;
    } catch (...) {  // a halt needs no memory
        stop_instead_of_hold(component, reason, now);
        throw;
    }
}

void Executor::stop_instead_of_hold(RegisteredComponent& component, std::string_view reason, Instant now) {
    Attempts attempts;
    attempts([&] { halt(component, CompletedStatus::abort, reason, now); });
    attempts([&] {
        agenda_.add(
            {component.shared_from_this(), ErrorType::user_defined_error, "its motion was stopped: " + std::string{reason}});
    });
    attempts([&] { run_ready(now); });
    attempts.rethrow();
}

}  // namespace rois
