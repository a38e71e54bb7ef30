// How commands end (7.4.2, figure 10; tables 8, 20, 32; decisions 8, 9, 12 and 17).

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::unit;
using kit::where;

void require_once(Guest const& guest, std::string const& id, std::string const& status) {
    auto const endings = guest.endings(id);
    require(endings == std::vector{status},
            "the command " + id + " should complete once with " + status + ", and did with " + list(endings));
}

void an_action_completes_at_its_end(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const id = guest.order(short_speech(speaker, ""));
    guest.require_success(id, speaker);
    guest.settle(speaker);
    require_once(guest, id, "OK");
}

void a_function_completes_start_when_it_is_active(Stage& stage) {
    auto const& detector = stage.detector();
    Guest guest{stage};
    guest.take(detector);
    guest.require_success(guest.order(command(detector, "start")), detector);
    same("the status of stop", "OK", guest.ending(command(detector, "stop")));
}

void every_command_of_a_sequence_completes_once(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    kit::Xml units;
    for (int i = 0; i < 10; ++i) units += unit(command(component, "stop"));
    auto const ids = kit::command_ids(ok(guest.execute(units)));
    require(ids.size() == 10, "ten commands should have ten ids, and have " + list(ids));
    guest.status_of(ids.back());
    guest.settle(component);
    for (auto const& id : ids) require_once(guest, id, "OK");
}

void stop_ends_the_action(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const speech = guest.order(long_speech(speaker, ""));
    auto const stop = guest.order(command(speaker, "stop"));
    same("the status of stop", "OK", guest.status_of(stop));
    guest.settle(speaker);
    require_once(guest, speech, "ABORT");
    same("the status of stop when idle", "OK", guest.ending(command(speaker, "stop")));
}

void a_new_start_replaces_the_old_one(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const first = guest.order(long_speech(speaker, ""));
    auto const second = guest.order(short_speech(speaker, ""));
    guest.require_success(second, speaker);
    require_once(guest, first, "ABORT");
}

void suspend_holds_and_resume_goes_on(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const speech = guest.order(long_speech(speaker, ""));
    same("the status of suspend", "OK", guest.ending(command(speaker, "suspend")));
    same("the status of suspend again", "ERROR", guest.ending(command(speaker, "suspend")));
    same("the state of the speech", "RUNNING", guest.state_of(speech));
    same("the status of resume", "OK", guest.ending(command(speaker, "resume")));
    same("the status of resume again", "ERROR", guest.ending(command(speaker, "resume")));
    require(guest.endings(speech).empty(), "the speech has completed while it was held");
    same("the status of stop", "OK", guest.ending(command(speaker, "stop")));
    require_once(guest, speech, "ABORT");
}

void in_a_wrong_state_there_is_an_error(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    same("the status of suspend when idle", "ERROR", guest.ending(command(component, "suspend")));
    same("the status of resume when idle", "ERROR", guest.ending(command(component, "resume")));
}

void results_report_the_progress_of_a_command(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const ids = kit::command_ids(ok(guest.execute(unit(long_speech(speaker, "")) + unit(command(speaker, "stop")))));
    require(ids.size() == 2, "two commands should have two ids, and have " + list(ids));
    same("the state of what runs", "RUNNING", guest.state_of(ids[0]));
    same("the state of a waiting command", "WAITING", guest.state_of(ids[1]));
    auto const stop = guest.order(command(speaker, "stop"));
    same("the status of stop", "OK", guest.status_of(stop));
    same("the state of a stopped command", "ABORT", guest.state_of(ids[0]));
    same("the state of what followed it", "ABORT", guest.state_of(ids[1]));
    same("the state of stop", "OK", guest.state_of(stop));
}

void results_are_chosen_by_condition(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const id = guest.order(command(component, "stop"));
    guest.status_of(id);
    require(!ok(guest.get_command_result(id, where(kit::equal("status", "OK")))).values().empty(),
            "the condition status = OK holds, but there are no results");
    require(ok(guest.get_command_result(id, where(kit::equal("status", "ABORT")))).values().empty(),
            "the condition status = ABORT does not hold, but there are results");
}

void results_of_an_unknown_or_anothers_command_are_refused(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage}, other{stage};
    refused(guest.get_command_result(nobody), "BAD_PARAMETER");
    guest.take(component);
    auto const name = unique_name();
    guest.order(command(component, "stop", name));
    guest.status_of(name);
    refused(other.get_command_result(name), "BAD_PARAMETER");
}

void events_of_an_action_come_before_its_end(Stage& stage) {
    auto const& navigation = stage.one_of({"navigation"});
    std::string const event = "reached_target";
    if (!navigation.event(event)) throw NotPlayed{navigation.ref + " has no event " + event};
    Guest guest{stage};
    guest.take(navigation);
    auto const robot = guest.robot_of(navigation);
    if (!robot) throw NotPlayed{"where the robot of " + navigation.ref + " is cannot be known"};
    ok(guest.subscribe(event, only(navigation)));
    auto const id =
        guest.order({.component = navigation.ref, .arguments = {argument(navigation, "target_position", {robot->position})}});
    auto const status = guest.status_of(id);
    if (status != "OK") throw NotPlayed{"navigation to where the robot stands ends with " + status};
    require(guest.heard_events(event) == 1, event + " should come once before the command completes");
}

// Follow goes on until it is stopped, also while it waits for somebody whom it does not see.
Command endless_follow(Component const& follow) {
    return {.component = follow.ref,
            .arguments = {argument(follow, "target_object_ref", {nobody}), argument(follow, "distance", {"1000"})}};
}

// The id of a follow that goes on; NotPlayed when the gateway follows only whom it knows.
std::string begun_follow(Guest& guest, Command const& command) {
    auto const answer = guest.execute(command);
    if (answer.return_code() == "BAD_PARAMETER") throw NotPlayed{"it follows only whom it knows: " + answer.reason()};
    return first("a command in the answer", kit::command_ids(ok(answer)));
}

void follow_goes_on_until_it_is_stopped(Stage& stage) {
    auto const& follow = stage.one_of({"follow"});
    Guest guest{stage};
    guest.take(follow);
    auto start = endless_follow(follow);
    if (follow.parameter_named("time_limit")) start.arguments.push_back(argument(follow, "time_limit", {"0"}));
    auto const id = begun_follow(guest, start);
    guest.settle(follow);
    if (!guest.endings(id).empty()) throw NotPlayed{"it follows only whom it sees: " + list(guest.endings(id))};
    same("the status of stop", "OK", guest.ending(command(follow, "stop")));
    guest.settle(follow);
    if (guest.endings(id) == std::vector<std::string>{"ERROR"}) throw NotPlayed{"it follows only whom it sees: ERROR"};
    require_once(guest, id, "OK");
}

void follow_ends_at_its_time_limit(Stage& stage) {
    auto const& follow = stage.one_of({"follow"});
    Guest guest{stage};
    guest.take(follow);
    auto start = endless_follow(follow);
    start.arguments.push_back(argument(follow, "time_limit", {"200"}));
    auto const id = begun_follow(guest, start);
    auto const status = guest.status_of(id);
    if (status == "ERROR") throw NotPlayed{"it follows only whom it sees"};
    if (status == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses what " + follow.ref + " needs"};
    same("the status of a follow whose time_limit has passed", "TIMEOUT", status);
}

}  // namespace

Clause completion_clause() {
    return {
        "7.4.2 Command interface: completion and results",
        {{"an_action_completes_at_its_end", "figure 10; table 8; decisions 8, 12", an_action_completes_at_its_end},
         {"a_function_completes_start_when_it_is_active", "table 32; decision 8", a_function_completes_start_when_it_is_active},
         {"every_command_of_a_sequence_completes_once", "figure 10; decision 12", every_command_of_a_sequence_completes_once},
         {"stop_ends_the_action", "tables 8, 32; decision 9", stop_ends_the_action},
         {"a_new_start_replaces_the_old_one", "decision 9", a_new_start_replaces_the_old_one},
         {"suspend_holds_and_resume_goes_on", "table 32; decision 9", suspend_holds_and_resume_goes_on},
         {"in_a_wrong_state_there_is_an_error", "tables 8, 32; decision 9", in_a_wrong_state_there_is_an_error},
         {"results_report_the_progress_of_a_command", "figure 10; table 20; decision 17",
          results_report_the_progress_of_a_command},
         {"results_are_chosen_by_condition", "tables 3, 20; decision 19", results_are_chosen_by_condition},
         {"results_of_an_unknown_or_anothers_command_are_refused", "table 3; decision 17",
          results_of_an_unknown_or_anothers_command_are_refused},
         {"follow_goes_on_until_it_is_stopped", "table 47; decisions 8, 9", follow_goes_on_until_it_is_stopped},
         {"follow_ends_at_its_time_limit", "tables 8, 47; decisions 8, 16", follow_ends_at_its_time_limit},
         {"events_of_an_action_come_before_its_end", "table 46; decision 8", events_of_an_action_come_before_its_end}}};
}

}  // namespace rois::conformance
