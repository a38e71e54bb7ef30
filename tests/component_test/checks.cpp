#include "component_test/checks.hpp"

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "component_test/steps.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;

// --- Joining ---

// Returns whether this engine or one of its sub engines has the component.
bool has_component(EngineProfile const& engine, std::string const& ref) {
    return std::ranges::find(engine.components, ref) != engine.components.end() ||
           std::ranges::any_of(engine.sub_profiles, [&](EngineProfile const& sub) { return has_component(sub, ref); });
}

void joins_with_the_name_in_rois_name(Program& program) {
    auto const join = program.await_join();
    require(join.name == "tested", "join: expected the name 'tested' from ROIS_NAME, got " + quoted(join.name));
}

void refuses_to_resume_an_unknown_session(Program& program) {
    require_no_session(program.answer_to(Resume{{unknown_name}, 0}), "resume of an unknown session");
}

void opens_a_session(Program& program) {
    auto const reply = program.connect();
    require(!reply.session.text.empty(), "connect: expected the id of a session");
    require(reply.window == window, "connect: expected window=\"" + std::to_string(window.count()) + "\", as requested");
}

void keeps_its_session_after_a_second_connect(Program& program) {
    auto const reply = program.ask(Connect{});
    require(reply.session.text == program.session().text, "a second connect on the same link: expected the same session " +
                                                              quoted(program.session().text) + ", got " +
                                                              quoted(reply.session.text));
}

void has_a_profile(Program& program) {
    program.ensure_ready();
    auto const& profile = program.profile();
    auto const* instance = find_parameter(profile.parameters, "instance");
    require(instance != nullptr && instance->default_value == program.instance(),
            "get_profile: expected the parameter instance with the instance from join, " + quoted(program.instance()));
    for (auto const& each : program.components()) {
        require(has_component(profile, each.ref),
                "get_profile: the profile of the engine lacks the component " + quoted(each.ref));
        require(each.traits != nullptr, "get_profile: expected `moves` and `when_stopped` of the component " + quoted(each.ref));
        if (std::ranges::none_of(common_commands, [&](auto const* name) { return has_command(each, name); })) continue;
        for (auto const* common : common_commands)
            require(has_command(each, common), "get_profile: the profile of " + quoted(each.ref) + " lacks the command " +
                                                   common +
                                                   ": expected all messages, including those of its SubComponentProfiles");
    }
}

void reports_the_state_of_each_component(Program& program) {
    program.ensure_ready();
    program.settle();
    for (auto const& each : program.components())
        require(program.reports(each.ref), "expected a component_changed of " + quoted(each.ref) + " after connect, got none");
}

// --- The link ---

void answers_an_unsupported_operation(Program& program) {
    program.ensure_ready();
    auto const reply = program.ask(Search{});
    require(reply.return_code == ReturnCode::unsupported || reply.return_code == ReturnCode::ok,
            "search: expected UNSUPPORTED or OK, got " + std::string{to_text(reply.return_code)});
    require_ok(program.ask(Connect{}), "connect after search");
}

void survives_malformed_xml(Program& program) {
    program.ensure_ready();
    program.send("<oops");
    for (auto const until = Clock::now() + 500ms; Clock::now() < until && !program.link_has_ended();)
        std::this_thread::sleep_for(10ms);
    if (program.link_has_ended()) return program.ensure_ready();
    auto const answer = program.answer_to(Connect{});  // requires an answer after the fault
    (void)answer;
}

void rejoins_as_the_same_instance(Program& program) {
    program.ensure_ready();
    auto const before = program.instance();
    program.cut();
    program.await_join();
    require(program.instance() == before,
            "join: expected the instance of the first join, " + quoted(before) + ", got " + quoted(program.instance()));
    auto const reply = program.ask(Resume{program.session(), program.last_sequence()});
    require_ok(reply, "resume within the window");
}

void knows_its_commands_when_the_link_returns(Program& program) {
    program.ensure_ready();
    auto const ref = program.components().front().ref;
    bind(program, ref);
    auto const id = start(program, ref);
    lose_link(program, 0ms);
    auto const known = program.ask(GetCommandResult{{id}, {}});
    require_ok(known, "get_command_result of an accepted command");
    require(program.ask(GetCommandResult{{unknown_name}, {}}).return_code == ReturnCode::bad_parameter,
            "get_command_result of an unknown command: expected BAD_PARAMETER");
    stop(program, ref);
    auto const ended = program.completed(id, longest_halt);
    auto const told = program.ask(GetCommandResult{{id}, {}});
    require_ok(told, "get_command_result of a command that has ended");
    std::string const expected{to_text(ended.status)};
    auto const* const status = find(told.results.parameters, "status");
    require(status != nullptr && status->values == std::vector{expected},
            "get_command_result of a command that has ended: expected the status " + expected + ", as in its completed");
}

// Starts all that each component can do. Nothing is started if the program refuses it.
void start_everything(Program& program) {
    for (auto const& each : program.components()) {
        bind(program, each.ref);
        is_quiet(program, each);
        for (auto const& command : own_actions(each))
            program.execute(each.ref, command.name, long_arguments(program, each.ref, command));
        if (has_command(each, "start")) program.execute(each.ref, "start");
    }
}

void ends_its_session_after_the_window(Program& program) {
    open_session(program, window);
    start_everything(program);
    auto const session = program.session();
    program.cut();
    std::this_thread::sleep_for(window + 2'500ms);
    program.await_join();
    require_no_session(program.answer_to(Resume{session, program.last_sequence()}),
                       "resume " + std::to_string((window + 2'500ms).count()) + " ms after the end of the link");
    program.connect();
    program.ensure_ready();
    for (auto const& each : program.components()) {
        bind(program, each.ref);
        subscribe(program, each);
    }
    for (auto const& each : program.components())
        if (has_command(each, "start")) require_rest(program, each, "after the end of the session");
}

void ends_its_session_on_disconnect(Program& program) {
    program.ensure_ready();
    auto const session = program.session();
    program.disconnect();
    program.settle();
    require_no_session(program.answer_to(Resume{session, program.last_sequence()}), "resume after disconnect");
    program.connect();
    require(program.session().text != session.text,
            "connect after disconnect, on the same link: expected a new session, got " + quoted(session.text) + " again");
    reports_the_state_of_each_component(program);
}

void reports_no_event_without_a_subscription(Program& program) {
    program.ensure_ready();
    program.disconnect();  // ends the subscriptions of other checks
    program.connect();
    for (auto const& each : program.components()) {
        if (!has_command(each, "start")) continue;
        bind(program, each.ref);
        if (program.execute(each.ref, "start").reply.return_code != ReturnCode::ok) continue;
        program.settle();
        stop(program, each.ref);
    }
    program.settle();
}

void answers_each_of_several_requests_once(Program& program) {
    program.ensure_ready();
    program.answers_to({GetProfile{}, Connect{}, Search{}, GetCommandResult{{unknown_name}, {}}, Connect{}, GetProfile{}});
}

void answers_a_ping(Program& program) {
    program.ensure_ready();
    program.ping();
}

void opens_a_new_session_for_a_restarted_engine(Program& program) {
    program.ensure_ready();
    auto const ref = program.components().front().ref;
    bind(program, ref);
    start(program, ref);
    auto const session = program.session();
    program.cut();
    program.await_join();
    program.connect();
    require(program.session().text != session.text,
            "connect on a new link: expected a new session, got " + quoted(session.text) + " again");
    program.settle();
}

// --- The end ---

void ends_on_sigterm(Program& program) {
    if (auto const code = program.exit_code())
        Program::fail("the program ended before SIGTERM, with exit code " + std::to_string(*code));
    auto const code = program.end();
    require(code.has_value(), "SIGTERM: the program did not end within " + std::to_string(program.patience().count()) + " ms");
    require(code == 0, "SIGTERM: expected exit code 0, got " + std::to_string(*code));
}

}  // namespace

Group joining_checks() {
    return {"Joining",
            {{"joins_with_the_name_in_rois_name", joins_with_the_name_in_rois_name},
             {"refuses_to_resume_an_unknown_session", refuses_to_resume_an_unknown_session},
             {"opens_a_session", opens_a_session},
             {"keeps_its_session_after_a_second_connect", keeps_its_session_after_a_second_connect},
             {"has_a_profile", has_a_profile},
             {"reports_the_state_of_each_component", reports_the_state_of_each_component}}};
}

Group link_checks() {
    Group group{"The link",
                {{"answers_an_unsupported_operation", answers_an_unsupported_operation},
                 {"answers_each_of_several_requests_once", answers_each_of_several_requests_once},
                 {"answers_a_ping", answers_a_ping},
                 {"survives_malformed_xml", survives_malformed_xml},
                 {"ends_its_session_on_disconnect", ends_its_session_on_disconnect},
                 {"reports_no_event_without_a_subscription", reports_no_event_without_a_subscription},
                 {"rejoins_as_the_same_instance", rejoins_as_the_same_instance},
                 {"knows_its_commands_when_the_link_returns", knows_its_commands_when_the_link_returns}}};
    std::ranges::move(lost_link_checks(), std::back_inserter(group.checks));
    group.checks.push_back({"ends_its_session_after_the_window", ends_its_session_after_the_window});
    group.checks.push_back({"opens_a_new_session_for_a_restarted_engine", opens_a_new_session_for_a_restarted_engine});
    return group;
}

Group ending_checks() { return {"The end", {{"ends_on_sigterm", ends_on_sigterm}}}; }

}  // namespace rois::component_test
