#include "component_test/checks.hpp"

#include <algorithm>
#include <array>
#include <thread>

#include "conformance/check.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;
using conformance::Skipped;

constexpr auto unknown_name = "unknown";  // a name that no program has

void require(bool holds, std::string const& message) {
    if (!holds) Program::fail(message);
}

void require_ok(Outcome const& outcome, std::string const& what) {
    require(outcome.return_code == ReturnCode::ok,
            what + ": expected OK, got " + std::string{to_text(outcome.return_code)} + ": " + outcome.reason);
}

void require_refusal(Execute::Reply const& reply, std::string const& what) {
    require(reply.return_code != ReturnCode::ok, what + ": expected a refusal, got OK");
}

Condition only(std::string const& ref) {
    return {PropertyComparison{.left = {ValueReference{"component_ref"}}, .right = {Literal{ref}}}};
}

Identifier identifier(std::string const& ref) {
    Identifier of;
    of.code = ref;
    return of;
}

Parameter parameter(ParameterProfile const& profile, std::vector<std::string> values) {
    Parameter made;
    made.name = profile.name;
    made.data_type_ref = profile.data_type_ref;
    made.values = std::move(values);
    return made;
}

// Returns a valid value of this type.
std::vector<std::string> some_value(ParameterProfile const& profile) {
    if (profile.default_value) return default_values(profile.data_type_ref, *profile.default_value);
    switch (DataType::of(profile.data_type_ref).base) {
        case BaseType::integer:
        case BaseType::real:
            return {"1"};
        case BaseType::boolean:
            return {"true"};
        case BaseType::date_time:
            return {"2026-01-01T00:00:00Z"};
        case BaseType::date:
            return {"2026-01-01"};
        case BaseType::time:
            return {"00:00:00Z"};
        default:
            return {"x"};
    }
}

ParameterList arguments_of(MessageProfile const& command) {
    ParameterList all;
    for (auto const& each : command.arguments) all.push_back(parameter(each, some_value(each)));
    return all;
}

constexpr std::array common_commands{"start", "stop", "suspend", "resume"};

bool is_common(std::string const& command) { return std::ranges::find(common_commands, command) != common_commands.end(); }

bool has_command(ComponentEntry const& component, char const* name) {
    return find_message(*component.profile, MessageKind::command, name) != nullptr;
}

// Returns whether this engine or one of its sub engines has the component.
bool has_component(EngineProfile const& engine, std::string const& ref) {
    return std::ranges::find(engine.components, ref) != engine.components.end() ||
           std::ranges::any_of(engine.sub_profiles, [&](EngineProfile const& sub) { return has_component(sub, ref); });
}

std::vector<MessageProfile> messages(ComponentEntry const& component, MessageKind kind) {
    std::vector<MessageProfile> found;
    std::ranges::copy_if(component.profile->messages, std::back_inserter(found),
                         [&](auto const& each) { return each.kind == kind; });
    return found;
}

void bind(Program& program, std::string const& ref) { require_ok(program.ask(Bind{identifier(ref)}), "bind"); }

// Stops the component, and waits until `stop` completes. Commands that ran before it have completed then.
void stop(Program& program, std::string const& ref) {
    auto const stopped = program.execute(ref, "stop");
    require_ok(stopped.reply, "stop");
    auto const end = program.completed(stopped.id, longest_halt);
    require(end.status == CompletedStatus::ok,
            "stop: expected `completed` with OK, got " + std::string{to_text(end.status)} + ": " + end.reason);
    require(end.active == false, "stop: expected `completed` with active=\"false\"");
}

// Starts the component, and returns the id of the command. Throws Skipped if the program refuses `start`.
std::string start(Program& program, std::string const& ref) {
    auto const started = program.execute(ref, "start");
    if (started.reply.return_code != ReturnCode::ok) throw Skipped{"start is refused: " + started.reply.reason};
    return started.id;
}

// --- Joining ---

void joins_with_the_name_in_rois_name(Program& program) {
    auto const join = program.await_join();
    require(join.name == "tested", "join: expected the name 'tested' from ROIS_NAME, got " + quoted(join.name));
}

void refuses_to_resume_an_unknown_session(Program& program) {
    auto const answer = program.answer_to(Resume{{unknown_name}, 0});
    auto const* fault = std::get_if<Fault>(&answer);
    require(fault != nullptr && fault->code == FaultCode::no_session,
            "resume of an unknown session: expected the fault no_session");
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

// A command may complete while the link is down. After the program has joined again, it must report the completion.
void keeps_notifications_while_the_link_is_down(Program& program) {
    program.ensure_ready();
    auto const ref = program.components().front().ref;
    bind(program, ref);
    auto const id = start(program, ref);
    program.cut();
    program.await_join();
    require_ok(program.ask(Resume{program.session(), program.last_sequence()}), "resume within the window");
    auto const known = program.ask(GetCommandResult{{id}, {}});
    require_ok(known, "get_command_result of an accepted command");
    require(program.ask(GetCommandResult{{unknown_name}, {}}).return_code == ReturnCode::bad_parameter,
            "get_command_result of an unknown command: expected BAD_PARAMETER");
    stop(program, ref);
    program.completed(id, longest_halt);
}

void ends_its_session_after_the_window(Program& program) {
    program.ensure_ready();
    auto const session = program.session();
    program.cut();
    std::this_thread::sleep_for(window + 2'500ms);
    program.await_join();
    auto const answer = program.answer_to(Resume{session, program.last_sequence()});
    auto const* fault = std::get_if<Fault>(&answer);
    require(
        fault != nullptr && fault->code == FaultCode::no_session,
        "resume " + std::to_string((window + 2'500ms).count()) + " ms after the end of the link: expected the fault no_session");
    program.connect();
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

Group checks_of(ComponentEntry const& component) {
    auto const ref = component.ref;
    Group group{"Component " + ref, {}};
    auto const add_without_subscription = [&](std::string name, std::function<void(Program&)> run) {
        group.checks.push_back({std::move(name), [ref, run = std::move(run)](Program& program) {
                                    program.ensure_ready();
                                    bind(program, ref);
                                    run(program);
                                    program.settle();
                                }});
    };
    // Subscribes to all events, as an engine does.
    auto const subscribe = [events = messages(component, MessageKind::event)](Program& program) {
        for (auto const& event : events) {
            if (program.has_subscribed(event.name)) continue;
            auto const reply = program.ask(Subscribe{.event_type = event.name, .condition = {}, .inline_results = true});
            require_ok(reply, "subscribe to " + event.name);
            require(!reply.subscribe_id.text.empty(), "subscribe: expected a subscribe_id, got none");
        }
    };
    bool const acts = has_command(component, "start");
    if (acts)
        add_without_subscription("reports_no_event_without_a_subscription", [ref](Program& program) {
            start(program, ref);
            stop(program, ref);
        });
    auto const add = [&](std::string name, std::function<void(Program&)> run) {
        add_without_subscription(std::move(name), [subscribe, run = std::move(run)](Program& program) {
            subscribe(program);
            run(program);
        });
    };
    add("can_be_bound_and_released", [ref](Program& program) {
        require_ok(program.ask(Release{identifier(ref)}), "release");
        require_ok(program.ask(Release{identifier(ref)}), "release of a component that is not bound");
        bind(program, ref);
        require(program.ask(Bind{identifier(unknown_name)}).return_code != ReturnCode::ok,
                "bind of an unknown component: expected a refusal");
    });
    for (auto const& query : messages(component, MessageKind::query))
        add("answers_the_query_" + query.name, [ref, query](Program& program) {
            Query asked{.query_type = query.name, .condition = {}};
            asked.condition.filter = only(ref);
            auto const reply = program.ask(std::move(asked));
            require_ok(reply, query.name);
            require(reply.component_ref.code == ref, query.name + ": expected component_ref " + quoted(ref));
            auto const why = why_not(reply.results, query.results);
            require(why.empty(), query.name + ": " + why);
            if (query.name == "get_parameter") return;  // parameters without a value are not in the results
            for (auto const& each : query.results)
                require(find(reply.results.parameters, each.name) != nullptr,
                        query.name + ": expected the result " + quoted(each.name) + ", got none");
        });
    add("refuses_an_unknown_command",
        [ref](Program& program) { require_refusal(program.execute(ref, unknown_name, {}, true).reply, "an unknown command"); });
    for (auto const& command : messages(component, MessageKind::command)) {
        auto const& name = command.name;
        add("refuses_an_unknown_argument_of_" + name, [ref, command](Program& program) {
            auto arguments = arguments_of(command);
            arguments.push_back(
                parameter({.name = unknown_name, .data_type_ref = {}, .default_value = {}, .description = {}}, {"1"}));
            arguments.back().data_type_ref.code = "int";
            require_refusal(program.execute(ref, command.name, arguments, true).reply, "an argument that is not in the profile");
        });
        for (auto const& argument : command.arguments) {
            auto const type = DataType::of(argument.data_type_ref);
            if (!rois::why_not(type, std::vector<std::string>{"no value"})) continue;  // any text is a valid value
            add("refuses_an_invalid_" + argument.name + "_of_" + name, [ref, command, argument](Program& program) {
                auto arguments = arguments_of(command);
                for (auto& each : arguments)
                    if (each.name == argument.name) each.values = {"no value"};
                require_refusal(program.execute(ref, command.name, arguments, true).reply,
                                "the value 'no value' of a parameter of type " + argument.data_type_ref.code);
                require_refusal(program.execute(ref, command.name, arguments).reply, "the same without check_only");
            });
        }
        add("does_not_run_" + name + "_with_check_only", [ref, command](Program& program) {
            auto const reply = program.execute(ref, command.name, arguments_of(command), true).reply;
            require(reply.return_code == ReturnCode::ok || reply.return_code == ReturnCode::bad_parameter ||
                        reply.return_code == ReturnCode::unsupported,
                    "check_only: expected OK, BAD_PARAMETER or UNSUPPORTED, got " + std::string{to_text(reply.return_code)});
        });
    }
    if (!acts) return group;
    add("completes_start_once", [ref](Program& program) {
        auto const id = start(program, ref);
        std::this_thread::sleep_for(300ms);
        stop(program, ref);
        program.completed(id, longest_halt);
    });
    add("stop_ends_a_running_start", [ref](Program& program) {
        auto const id = start(program, ref);
        stop(program, ref);
        auto const end = program.completed(id, longest_halt);
        require(end.status == CompletedStatus::ok || end.status == CompletedStatus::abort,
                "a stopped start: expected `completed` with OK or ABORT, got " + std::string{to_text(end.status)});
    });
    add("accepts_stop_without_a_start", [ref](Program& program) {
        stop(program, ref);
        stop(program, ref);
    });
    add("release_ends_a_running_start", [ref](Program& program) {
        auto const id = start(program, ref);
        require_ok(program.ask(Release{identifier(ref)}), "release");
        program.completed(id, longest_halt);
    });
    for (auto const& command : messages(component, MessageKind::command)) {
        if (is_common(command.name)) continue;
        add("completes_" + command.name + "_once", [ref, command](Program& program) {
            auto const run = program.execute(ref, command.name, arguments_of(command));
            if (run.reply.return_code != ReturnCode::ok)
                throw Skipped{"the arguments chosen by rois-component-test are refused: " + run.reply.reason};
            program.completed(run.id, program.patience());
        });
        add("stop_ends_" + command.name, [ref, command](Program& program) {
            auto const run = program.execute(ref, command.name, arguments_of(command));
            if (run.reply.return_code != ReturnCode::ok)
                throw Skipped{"the arguments chosen by rois-component-test are refused: " + run.reply.reason};
            stop(program, ref);
            program.completed(run.id, longest_halt);
        });
    }
    for (auto const* pause : {"suspend", "resume"})
        add("answers_" + std::string{pause}, [ref, pause](Program& program) {
            auto const run = program.execute(ref, pause);
            if (run.reply.return_code == ReturnCode::ok) program.completed(run.id, longest_halt);
        });
    return group;
}

Group link_checks() {
    return {"The link",
            {{"answers_an_unsupported_operation", answers_an_unsupported_operation},
             {"survives_malformed_xml", survives_malformed_xml},
             {"rejoins_as_the_same_instance", rejoins_as_the_same_instance},
             {"keeps_notifications_while_the_link_is_down", keeps_notifications_while_the_link_is_down},
             {"ends_its_session_after_the_window", ends_its_session_after_the_window},
             {"opens_a_new_session_for_a_restarted_engine", opens_a_new_session_for_a_restarted_engine}}};
}

Group ending_checks() { return {"The end", {{"ends_on_sigterm", ends_on_sigterm}}}; }

}  // namespace rois::component_test
