// Checks that a program loses nothing when its link ends and returns within the window.
#include <algorithm>
#include <map>
#include <optional>

#include "component_test/checks.hpp"
#include "component_test/steps.hpp"
#include "conformance/check.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;
using conformance::NotObservable;

constexpr auto longest_loss = 10'000ms;  // the window of these checks
constexpr auto before_the_cut = 100ms;
constexpr auto shortest_run = 200ms;
constexpr auto longest_run = 2'000ms;
constexpr int rounds = 2;  // a single event may be missing by chance

bool moves(ComponentEntry const& component) { return component.traits != nullptr && component.traits->moves; }

// A command of a component, with valid arguments.
struct Action {
    ComponentEntry component;
    std::string command;
    ParameterList arguments;
};

std::vector<Action> actions(Program& program) {
    std::vector<Action> all;
    for (auto const& component : program.components()) {
        if (!has_command(component, "start")) continue;
        for (auto const& command : own_actions(component)) all.push_back({component, command.name, arguments_of(command)});
        all.push_back({component, "start", {}});
    }
    return all;
}

// Begins an action, and waits until the link may be cut. Returns the id of the command, or nothing if the program refuses it.
std::optional<std::string> begin(Program& program, Action const& action) {
    bind(program, action.component.ref);
    subscribe(program, action.component);
    auto const run = program.execute(action.component.ref, action.command, action.arguments);
    if (run.reply.return_code != ReturnCode::ok) return {};
    program.settle(before_the_cut);
    return run.id;
}

// How an action runs while the link stands.
struct Trial {
    std::chrono::milliseconds time{};
    bool completes = false;
    std::size_t events = 0, late_events = 0;  // late: after `before_the_cut`
};

Trial try_out(Program& program, Action const& action) {
    auto const& ref = action.component.ref;
    subscribe(program, action.component);
    auto const begun = Clock::now();
    auto const events = program.events_of(ref);
    auto const id = begin(program, action);
    if (!id) return {};
    auto const early_events = program.events_of(ref);
    auto const time = [&] { return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begun); };
    while (!program.has_completed(*id) && time() < longest_run) program.settle(20ms);
    Trial trial{.time = time(), .completes = program.has_completed(*id)};
    if (trial.time < shortest_run) program.settle(longest_halt);  // a function of `start` may report events
    trial.events = program.events_of(ref) - events;
    trial.late_events = program.events_of(ref) - early_events;
    stop(program, ref);
    return trial;
}

// Returns the first action whose trial has this property. Throws NotObservable if there is none.
template <class Property>
std::pair<Action, Trial> find_action(Program& program, Property has, std::string const& otherwise) {
    open_session(program, longest_loss);
    for (auto const& action : actions(program))
        if (auto const trial = try_out(program, action); has(trial)) return {action, trial};
    throw NotObservable{otherwise};
}

std::string in_ms(std::chrono::milliseconds time) { return std::to_string(time.count()) + " ms"; }

void keeps_completions_while_the_link_is_down(Program& program) {
    auto const [action, trial] = find_action(
        program, [](Trial const& each) { return each.completes && each.time >= shortest_run; },
        "no command takes " + in_ms(shortest_run) + " to " + in_ms(longest_run) + ", so none completes while the link is down");
    program.outlast_short_link();
    auto const id = begin(program, action);
    if (!id || program.has_completed(*id)) throw NotObservable{action.command + " completed before the link was cut"};
    auto const down = trial.time + shortest_run;
    lose_link(program, down);
    for (auto const until = Clock::now() + program.patience(); Clock::now() < until && !program.has_completed(*id);)
        program.settle(20ms);
    require(program.has_completed(*id), quoted(action.command) + " takes " + in_ms(trial.time) + ", and the link was down for " +
                                            in_ms(down) + ": expected `completed` after `resume`, got none");
    stop(program, action.component.ref);
}

void keeps_events_while_the_link_is_down(Program& program) {
    auto const otherwise = "no command causes an event later than " + in_ms(before_the_cut) + " after its start";
    auto const late = [](Trial const& each) { return each.late_events > 0; };
    auto [action, trial] = find_action(program, late, otherwise);
    auto const& ref = action.component.ref;
    for (int round = 1; round <= rounds; ++round) {
        program.outlast_short_link();
        if (!begin(program, action)) throw NotObservable{action.command + " is refused when it is repeated"};
        auto const before = program.events_of(ref);
        lose_link(program, trial.time + shortest_run);
        program.settle();
        auto const kept = program.events_of(ref) - before;
        stop(program, ref);
        if (kept > 0) return;
        open_session(program, longest_loss);
        trial = try_out(program, action);
        if (!late(trial)) throw NotObservable{action.command + " does not cause an event each time"};
    }
    Program::fail(quoted(action.command) + " causes an event later than " + in_ms(before_the_cut) +
                  " after its start: expected this event after `resume`, got none");
}

void keeps_its_subscriptions_while_the_link_is_down(Program& program) {
    auto const has_events = [](Trial const& each) { return each.events > 0; };
    auto const action = find_action(program, has_events, "no command causes an event").first;
    for (int round = 1; round <= rounds; ++round) {
        program.outlast_short_link();
        lose_link(program, before_the_cut);
        if (has_events(try_out(program, action))) return;
        open_session(program, longest_loss);
        if (!has_events(try_out(program, action))) throw NotObservable{action.command + " does not cause an event each time"};
    }
    Program::fail(quoted(action.command) + " causes events: expected an event of it after `resume`, got none");
}

// A component that moves may be halted: signs of life are missing without a link.
void goes_on_while_the_link_is_down(Program& program) {
    open_session(program, longest_loss);
    for (auto& action : actions(program)) {
        auto const* command = find_message(*action.component.profile, MessageKind::command, action.command);
        action.arguments = long_arguments(program, action.component.ref, *command);
        program.outlast_short_link();
        auto const id = begin(program, action);
        if (!id || program.has_completed(*id)) continue;
        lose_link(program, before_the_cut);
        program.settle();
        auto const status = program.has_completed(*id) ? program.completed(*id, 0ms).status : CompletedStatus::ok;
        stop(program, action.component.ref);
        if (status == CompletedStatus::abort && moves(action.component)) continue;
        require(status != CompletedStatus::abort, quoted(action.command) +
                                                      ": expected that it goes on while the link may return, got `completed` "
                                                      "with ABORT after `resume`");
        return;
    }
    throw NotObservable{"no command lasts longer than " + in_ms(before_the_cut)};
}

// Starts a function, and loses the link while it is active.
struct Loss {
    Switches before, resumed;
    std::vector<std::string> shown_by;  // the results that `start` changes, and that stay so while there is a link
};

std::vector<std::string> changed_in_both(Switches const& before, Switches const& started, Switches const& later) {
    std::vector<std::string> names;
    for (auto const& [name, value] : before) {
        auto const has_changed = [&](Switches const& now) { return now.contains(name) && now.at(name) != value; };
        if (has_changed(started) && has_changed(later)) names.push_back(name);
    }
    return names;
}

// Does not cut the link if `start` begins no function, or if no result shows it.
Loss lose_link_of_active(Program& program, ComponentEntry const& component) {
    program.outlast_short_link();
    Loss loss{.before = switches(program, component), .resumed = {}, .shown_by = {}};
    auto const id = begin(program, {component, "start", {}});
    if (id && program.has_completed(*id) && program.completed(*id, 0ms).active == true) {
        auto const started = switches(program, component);
        program.settle(longest_halt);
        loss.shown_by = changed_in_both(loss.before, started, switches(program, component));
    }
    if (!loss.shown_by.empty()) {
        lose_link(program, before_the_cut);
        program.settle();
        loss.resumed = switches(program, component);
    }
    stop(program, component.ref);
    return loss;
}

void keeps_active_functions_while_the_link_is_down(Program& program) {
    open_session(program, longest_loss);
    for (auto const& component : program.components()) {
        if (!has_command(component, "start") || moves(component)) continue;
        std::map<std::string, int> resets;  // by the name of the result
        for (int round = 1; round <= rounds; ++round) {
            auto const loss = lose_link_of_active(program, component);
            if (loss.shown_by.empty()) break;
            for (auto const& name : loss.shown_by) {
                auto const& before = loss.before.at(name);
                bool const is_reset = loss.resumed.contains(name) && loss.resumed.at(name) == before;
                require(!is_reset || ++resets[name] < rounds, "`start` changes the result " + name +
                                                                  ", which then stays so: expected the same value after "
                                                                  "`resume`, got " +
                                                                  quoted(before) + " as before `start`");
            }
            if (resets.empty()) return;
        }
    }
    throw NotObservable{"no boolean result shows whether a function is active"};
}

}  // namespace

std::vector<Check> lost_link_checks() {
    return {{"keeps_completions_while_the_link_is_down", keeps_completions_while_the_link_is_down},
            {"keeps_events_while_the_link_is_down", keeps_events_while_the_link_is_down},
            {"keeps_its_subscriptions_while_the_link_is_down", keeps_its_subscriptions_while_the_link_is_down},
            {"goes_on_while_the_link_is_down", goes_on_while_the_link_is_down},
            {"keeps_active_functions_while_the_link_is_down", keeps_active_functions_while_the_link_is_down}};
}

}  // namespace rois::component_test
