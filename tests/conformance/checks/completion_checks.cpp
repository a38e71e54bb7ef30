// The completion of commands (7.4.2, figure 10; tables 8, 20, 32; decisions 8, 9, 12 and 17).

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::unit;
using kit::where;

void require_once(Client const& client, std::string const& id, std::string const& status) {
    auto const completion_statuses = client.completion_statuses(id);
    require(completion_statuses == std::vector{status},
            "expected command " + id + " to complete once with " + status + ", got " + list(completion_statuses));
}

void an_action_completes_at_its_end(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const id = client.execute_one(short_speech(speaker, ""));
    client.require_success(id, speaker);
    client.flush_notifications(speaker);
    require_once(client, id, "OK");
}

void start_of_a_function_completes_while_it_is_active(Context& context) {
    auto const& detector = context.detector();
    Client client{context};
    client.bind_or_skip(detector);
    client.require_success(client.execute_one(command(detector, "start")), detector);
    require_equal("the status of stop", "OK", client.run(command(detector, "stop")));
}

void every_command_of_a_sequence_completes_once(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    kit::Xml units;
    for (int i = 0; i < 10; ++i) units += unit(command(component, "stop"));
    auto const ids = kit::command_ids(require_ok(client.execute(units)));
    require(ids.size() == 10, "expected ten ids for ten commands, got " + list(ids));
    client.status_of(ids.back());
    client.flush_notifications(component);
    for (auto const& id : ids) require_once(client, id, "OK");
}

void stop_aborts_the_running_action(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const speech = client.execute_one(long_speech(speaker, ""));
    auto const stop = client.execute_one(command(speaker, "stop"));
    require_equal("the status of stop", "OK", client.status_of(stop));
    client.flush_notifications(speaker);
    require_once(client, speech, "ABORT");
    require_equal("the status of stop when idle", "OK", client.run(command(speaker, "stop")));
}

void a_new_start_aborts_the_previous_one(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const first = client.execute_one(long_speech(speaker, ""));
    auto const second = client.execute_one(short_speech(speaker, ""));
    client.require_success(second, speaker);
    require_once(client, first, "ABORT");
}

void suspend_pauses_and_resume_continues_a_command(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const speech = client.execute_one(long_speech(speaker, ""));
    require_equal("the status of suspend", "OK", client.run(command(speaker, "suspend")));
    require_equal("the status of suspend again", "ERROR", client.run(command(speaker, "suspend")));
    require_equal("the state of the speech", "RUNNING", client.command_state(speech));
    require_equal("the status of resume", "OK", client.run(command(speaker, "resume")));
    require_equal("the status of resume again", "ERROR", client.run(command(speaker, "resume")));
    require(client.completion_statuses(speech).empty(), "the speech completed while it was suspended");
    require_equal("the status of stop", "OK", client.run(command(speaker, "stop")));
    require_once(client, speech, "ABORT");
}

void suspend_and_resume_fail_in_a_wrong_state(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    require_equal("the status of suspend when idle", "ERROR", client.run(command(component, "suspend")));
    require_equal("the status of resume when idle", "ERROR", client.run(command(component, "resume")));
}

void results_report_the_progress_of_a_command(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const ids =
        kit::command_ids(require_ok(client.execute(unit(long_speech(speaker, "")) + unit(command(speaker, "stop")))));
    require(ids.size() == 2, "expected two ids for two commands, got " + list(ids));
    require_equal("the state of a running command", "RUNNING", client.command_state(ids[0]));
    require_equal("the state of a waiting command", "WAITING", client.command_state(ids[1]));
    auto const stop = client.execute_one(command(speaker, "stop"));
    require_equal("the status of stop", "OK", client.status_of(stop));
    require_equal("the state of a stopped command", "ABORT", client.command_state(ids[0]));
    require_equal("the state of the command after a stopped one", "ABORT", client.command_state(ids[1]));
    require_equal("the state of stop", "OK", client.command_state(stop));
}

void a_condition_selects_results_of_a_command(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const id = client.execute_one(command(component, "stop"));
    client.status_of(id);
    require(!require_ok(client.get_command_result(id, where(kit::equal("status", "OK")))).values().empty(),
            "expected results for the condition status = OK, got none");
    require(require_ok(client.get_command_result(id, where(kit::equal("status", "ABORT")))).values().empty(),
            "expected no results for the condition status = ABORT of a command with the status OK");
}

void results_of_unknown_and_foreign_commands_are_refused(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context}, other{context};
    require_refusal(client.get_command_result(unknown_name), "BAD_PARAMETER");
    client.bind_or_skip(component);
    auto const name = unique_name();
    client.execute_one(command(component, "stop", name));
    client.status_of(name);
    require_refusal(other.get_command_result(name), "BAD_PARAMETER");
}

void events_of_an_action_precede_its_completion(Context& context) {
    auto const& navigation = context.component_of_kind({"navigation"});
    std::string const event = "reached_target";
    if (!navigation.event(event)) throw Skipped{navigation.ref + " has no event " + event};
    Client client{context};
    client.bind_or_skip(navigation);
    auto const robot = client.robot_of(navigation);
    if (!robot) throw Skipped{"the position of the robot of " + navigation.ref + " is not reported"};
    require_ok(client.subscribe(event, only(navigation)));
    auto const id = client.execute_one(
        {.component = navigation.ref, .arguments = {argument(navigation, "target_position", {robot->position})}});
    auto const status = client.status_of(id);
    if (status != "OK") throw Skipped{"navigation to the robot's own position completed with " + status};
    require(client.count_events(event) == 1, "expected one " + event + " before the command completes");
}

// Follow runs until it is stopped, even while its target is not in sight.
Command endless_follow(Component const& follow) {
    return {.component = follow.ref,
            .arguments = {argument(follow, "target_object_ref", {unknown_name}), argument(follow, "distance", {"1000"})}};
}

// Returns the id of a running follow. Throws Skipped if the gateway refuses unknown targets.
std::string started_follow(Client& client, Command const& command) {
    auto const answer = client.execute(command);
    if (answer.return_code() == "BAD_PARAMETER") throw Skipped{"follow refuses an unknown target: " + answer.reason()};
    return first_of("a command in the answer", kit::command_ids(require_ok(answer)));
}

void follow_continues_until_stop(Context& context) {
    auto const& follow = context.component_of_kind({"follow"});
    Client client{context};
    client.bind_or_skip(follow);
    auto start = endless_follow(follow);
    if (follow.parameter_named("time_limit")) start.arguments.push_back(argument(follow, "time_limit", {"0"}));
    auto const id = started_follow(client, start);
    client.flush_notifications(follow);
    if (!client.completion_statuses(id).empty())
        throw Skipped{"follow of an unknown target completed with " + list(client.completion_statuses(id))};
    require_equal("the status of stop", "OK", client.run(command(follow, "stop")));
    client.flush_notifications(follow);
    if (client.completion_statuses(id) == std::vector<std::string>{"ERROR"})
        throw Skipped{"follow of an unknown target completed with ERROR"};
    require_once(client, id, "OK");
}

void follow_ends_at_its_time_limit(Context& context) {
    auto const& follow = context.component_of_kind({"follow"});
    Client client{context};
    client.bind_or_skip(follow);
    auto start = endless_follow(follow);
    start.arguments.push_back(argument(follow, "time_limit", {"200"}));
    auto const id = started_follow(client, start);
    auto const status = client.status_of(id);
    if (status == "ERROR") throw Skipped{"follow of an unknown target completed with ERROR"};
    if (status == "OUT_OF_RESOURCES") throw Skipped{"another application uses a resource that " + follow.ref + " needs"};
    require_equal("the status of a follow whose time_limit has passed", "TIMEOUT", status);
}

}  // namespace

Clause completion_clause() {
    return {
        "7.4.2 Command interface: completion and results",
        {{"an_action_completes_at_its_end", "figure 10; table 8; decisions 8, 12", an_action_completes_at_its_end},
         {"start_of_a_function_completes_while_it_is_active", "table 32; decision 8",
          start_of_a_function_completes_while_it_is_active},
         {"every_command_of_a_sequence_completes_once", "figure 10; decision 12", every_command_of_a_sequence_completes_once},
         {"stop_aborts_the_running_action", "tables 8, 32; decision 9", stop_aborts_the_running_action},
         {"a_new_start_aborts_the_previous_one", "decision 9", a_new_start_aborts_the_previous_one},
         {"suspend_pauses_and_resume_continues_a_command", "table 32; decision 9", suspend_pauses_and_resume_continues_a_command},
         {"suspend_and_resume_fail_in_a_wrong_state", "tables 8, 32; decision 9", suspend_and_resume_fail_in_a_wrong_state},
         {"results_report_the_progress_of_a_command", "figure 10; table 20; decision 17",
          results_report_the_progress_of_a_command},
         {"a_condition_selects_results_of_a_command", "tables 3, 20; decision 19", a_condition_selects_results_of_a_command},
         {"results_of_unknown_and_foreign_commands_are_refused", "table 3; decision 17",
          results_of_unknown_and_foreign_commands_are_refused},
         {"follow_continues_until_stop", "table 47; decisions 8, 9", follow_continues_until_stop},
         {"follow_ends_at_its_time_limit", "tables 8, 47; decisions 8, 16", follow_ends_at_its_time_limit},
         {"events_of_an_action_precede_its_completion", "table 46; decision 8", events_of_an_action_precede_its_completion}}};
}

}  // namespace rois::conformance
