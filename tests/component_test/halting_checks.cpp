// Checks that a component stands still when it must: after stop, release and disconnect, and without signs of life.
#include <algorithm>

#include "component_test/checks.hpp"
#include "component_test/steps.hpp"
#include "conformance/check.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;
using conformance::NotObservable;
using conformance::Skipped;

constexpr auto between_signs_of_life = 250ms;

void require_stopped(Completed const& end, std::string const& what) {
    require(end.status == CompletedStatus::ok || end.status == CompletedStatus::abort,
            what + ": expected `completed` with OK or ABORT, got " + std::string{to_text(end.status)});
}

void stop_ends(Program& program, ComponentEntry const& component, std::string const& command, std::string const& id) {
    stop(program, component.ref);
    require_stopped(program.completed(id, longest_halt), "a stopped " + command);
    require_rest(program, component, "after `stop` completed");
}

void release_ends(Program& program, ComponentEntry const& component, std::string const& command, std::string const& id) {
    require_ok(program.ask(Release{identifier(component.ref)}), "release");
    require_stopped(program.completed(id, longest_halt), command + " of a released component");
    program.settle(longest_halt);
    require_rest(program, component, std::to_string(longest_halt.count()) + " ms after release");
}

void disconnect_ends(Program& program, ComponentEntry const& component, std::string const&, std::string const&) {
    program.disconnect();
    program.connect();
    program.ensure_ready();
    bind(program, component.ref);
    subscribe(program, component);
    program.settle(longest_halt);  // `completed` of a command of the ended session would be unexpected
    require_rest(program, component, std::to_string(longest_halt.count()) + " ms after disconnect");
}

using Ending = void (*)(Program&, ComponentEntry const&, std::string const& command, std::string const& id);

struct Round {
    bool active = false;
    Switches before, started, stopped;
};

// Starts and stops the component. Throws Skipped if `start` does not complete soon: `active` says nothing before its end.
Round start_and_stop(Program& program, ComponentEntry const& component) {
    Round round{.active = false, .before = switches(program, component), .started = {}, .stopped = {}};
    auto const id = start(program, component.ref);
    program.settle(longest_halt);
    if (!program.has_completed(id)) {
        stop(program, component.ref);
        throw Skipped{"start runs until it is stopped, or for longer than " + std::to_string(longest_halt.count()) + " ms"};
    }
    round.active = program.completed(id, 0ms).active.value_or(false);
    round.started = switches(program, component);
    stop(program, component.ref);
    round.stopped = switches(program, component);
    return round;
}

// A function that `start` has begun may show in a result. If `stop` resets a result, `start` must have reported active="true".
void reports_an_active_function(Program& program, ComponentEntry const& component) {
    auto const first = start_and_stop(program, component), second = start_and_stop(program, component);
    for (auto const& [name, value] : first.started) {
        auto const changed = [&](Round const& round) {
            return round.started.contains(name) && round.stopped.contains(name) &&
                   round.started.at(name) != round.stopped.at(name);
        };
        if (!first.active && !second.active && changed(first) && changed(second))
            Program::fail("start completed with active=\"false\", but a function was active: `stop` changed the result " + name +
                          " from " + quoted(value) + " to " + quoted(first.stopped.at(name)));
        if (first.active && first.before.contains(name) && first.before.at(name) != value && !changed(first) && !changed(second))
            throw NotObservable{"the result " + name + " became " + quoted(value) + " after start, and is still " +
                                quoted(value) +
                                " after stop: if this result shows that the function is active, halt does not end the function"};
    }
}

// Sends signs of life for this time. Returns whether the command still runs.
bool runs_with_signs_of_life(Program& program, std::string const& id, std::chrono::milliseconds time) {
    for (auto const until = Clock::now() + time; Clock::now() < until && !program.has_completed(id);) {
        require_ok(program.ask(Connect{}), "connect as a sign of life");
        program.settle(between_signs_of_life);
    }
    if (!program.has_completed(id)) return true;
    auto const end = program.completed(id, 0ms);
    require(end.status != CompletedStatus::abort,
            "a sign of life arrived every " + std::to_string(between_signs_of_life.count()) +
                " ms: expected that the command goes on, got `completed` with ABORT: " + end.reason);
    return false;
}

// Runs commands until one lasts for longer than the motion lease. A component that is held, and not halted, reports an error.
void is_halted_without_signs_of_life(Program& program, ComponentEntry const& component) {
    auto commands = own_actions(component);
    commands.push_back(*find_message(*component.profile, MessageKind::command, "start"));
    for (auto const& command : commands) {
        auto const run = program.execute(component.ref, command.name, long_arguments(program, component.ref, command));
        if (run.reply.return_code != ReturnCode::ok) continue;
        auto errors = program.errors_of(component.ref);
        bool const lasts = runs_with_signs_of_life(program, run.id, motion_lease + longest_halt);
        require(program.errors_of(component.ref) == errors, "a sign of life arrived every " +
                                                                std::to_string(between_signs_of_life.count()) +
                                                                " ms: expected that the command goes on, got an error");
        if (!lasts) continue;
        auto const longest = motion_lease + longest_halt + 500ms;
        program.settle(longest);
        require(program.has_completed(run.id) || program.errors_of(component.ref) > errors,
                quoted(command.name) + ": no request arrived for " + std::to_string(longest.count()) +
                    " ms: expected `completed`, or an error, after the motion lease of " + std::to_string(motion_lease.count()) +
                    " ms");
        require_ok(program.ask(Connect{}), "connect after the motion lease");
        require_rest(program, component, "after the motion lease");
        return stop(program, component.ref);
    }
    throw Skipped{"no command lasts longer than the motion lease"};
}

}  // namespace

Check activity_check_of(ComponentEntry const& component) {
    return {"reports_in_active_whether_start_began_a_function",
            [component](Program& program) { reports_an_active_function(program, component); }};
}

std::vector<Check> halting_checks_of(ComponentEntry const& component) {
    std::vector<Check> checks;
    auto const add = [&](std::string name, std::function<void(Program&, ComponentEntry const&)> run) {
        checks.push_back({std::move(name), [component, run = std::move(run)](Program& program) { run(program, component); }});
    };
    std::vector<std::pair<std::string, Ending>> const endings{
        {"stop", stop_ends}, {"release", release_ends}, {"disconnect", disconnect_ends}};
    for (auto const& [name, end] : endings) {
        add(name + "_ends_a_running_start", [end](Program& program, ComponentEntry const& of) {
            auto const id = start(program, of.ref);
            end(program, of, "start", id);
        });
        for (auto const& command : own_actions(component))
            add(name + "_ends_" + command.name, [end, command](Program& program, ComponentEntry const& of) {
                auto const id = run(program, of.ref, command.name, long_arguments(program, of.ref, command));
                end(program, of, command.name, id);
            });
    }
    if (component.traits != nullptr && component.traits->moves)
        add("is_halted_without_signs_of_life", is_halted_without_signs_of_life);
    return checks;
}

}  // namespace rois::component_test
