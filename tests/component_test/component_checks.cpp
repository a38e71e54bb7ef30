// Checks of one component: its messages with valid and invalid arguments.
#include <algorithm>
#include <thread>

#include "component_test/checks.hpp"
#include "component_test/steps.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;

void can_be_bound_and_released(Program& program, std::string const& ref) {
    require_ok(program.ask(Release{identifier(ref)}), "release");
    require_ok(program.ask(Release{identifier(ref)}), "release of a component that is not bound");
    bind(program, ref);
    require(program.ask(Bind{identifier(unknown_name)}).return_code != ReturnCode::ok,
            "bind of an unknown component: expected a refusal");
}

void answers_the_query(Program& program, std::string const& ref, MessageProfile const& query) {
    auto const reply = program.ask(query_of(ref, query.name));
    require_ok(reply, query.name);
    require(reply.component_ref.code == ref, query.name + ": expected component_ref " + quoted(ref));
    auto const why = why_not(reply.results, query.results);
    require(why.empty(), query.name + ": " + why);
    if (query.name == "get_parameter") return;  // parameters without a value are not in the results
    for (auto const& each : query.results)
        require(find(reply.results.parameters, each.name) != nullptr,
                query.name + ": expected the result " + quoted(each.name) + ", got none");
}

void refuses_an_unknown_argument(Program& program, std::string const& ref, MessageProfile const& command) {
    auto arguments = arguments_of(command);
    arguments.push_back(parameter({.name = unknown_name, .data_type_ref = {}, .default_value = {}, .description = {}}, {"1"}));
    arguments.back().data_type_ref.code = "int";
    require_refusal(program.execute(ref, command.name, arguments, true).reply, "an argument that is not in the profile");
}

// Returns texts that are not values of the argument's type. Any text is a value of a string.
std::vector<std::string> invalid_values(ParameterProfile const& argument) {
    std::vector<std::string> values{"no value", "1.5"};
    auto const type = DataType::of(argument.data_type_ref);
    std::erase_if(values, [&](auto const& value) { return !rois::why_not(type, std::vector{value}); });
    return values;
}

void refuses_invalid_values(Program& program, std::string const& ref, MessageProfile const& command,
                            ParameterProfile const& argument) {
    for (auto const& value : invalid_values(argument)) {
        auto arguments = arguments_of(command);
        for (auto& each : arguments)
            if (each.name == argument.name) each.values = {value};
        require_refusal(program.execute(ref, command.name, arguments, true).reply,
                        "the value " + quoted(value) + " of a parameter of type " + argument.data_type_ref.code);
        require_refusal(program.execute(ref, command.name, arguments).reply,
                        "the value " + quoted(value) + " without check_only");
    }
}

void does_not_run_with_check_only(Program& program, ComponentEntry const& component, MessageProfile const& command) {
    auto const before = program.events_of(component.ref);
    auto const reply = program.execute(component.ref, command.name, arguments_of(command), true).reply;
    require(reply.return_code == ReturnCode::ok || reply.return_code == ReturnCode::bad_parameter ||
                reply.return_code == ReturnCode::unsupported,
            "check_only: expected OK, BAD_PARAMETER or UNSUPPORTED, got " + std::string{to_text(reply.return_code)});
    auto const what = "check_only of " + quoted(command.name);
    require_rest(program, component, what, 200ms);
    require(program.events_of(component.ref) == before, what + ": expected that nothing runs, got an event");
}

void answers_a_request_behind_the_query(Program& program, std::string const& ref, std::string const& query) {
    auto const asked = query_of(ref, query);
    program.answers_to({asked, Connect{}, asked, GetCommandResult{{unknown_name}, {}}});
}

// Adds checks that run with a bound component and with subscriptions to its events.
class Checks {
public:
    Checks(Group& group, ComponentEntry component) : group_{group}, component_{std::move(component)} {}

    void add(std::string name, std::function<void(Program&)> run) {
        group_.checks.push_back({std::move(name), [component = component_, run = std::move(run)](Program& program) {
                                     program.ensure_ready();
                                     bind(program, component.ref);
                                     subscribe(program, component);
                                     if (has_command(component, "start")) is_quiet(program, component);
                                     run(program);
                                     program.settle();
                                 }});
    }

private:
    Group& group_;
    ComponentEntry component_;
};

void add_checks_of(Checks& checks, ComponentEntry const& component, MessageProfile const& command) {
    auto const& name = command.name;
    auto const& ref = component.ref;
    checks.add("refuses_an_unknown_argument_of_" + name,
               [ref, command](Program& program) { refuses_an_unknown_argument(program, ref, command); });
    for (auto const& argument : command.arguments)
        if (!invalid_values(argument).empty())
            checks.add("refuses_an_invalid_" + argument.name + "_of_" + name,
                       [ref, command, argument](Program& program) { refuses_invalid_values(program, ref, command, argument); });
    checks.add("does_not_run_" + name + "_with_check_only",
               [component, command](Program& program) { does_not_run_with_check_only(program, component, command); });
}

}  // namespace

Group checks_of(ComponentEntry const& component) {
    auto const ref = component.ref;
    Group group{"Component " + ref, {}};
    Checks checks{group, component};
    bool const acts = has_command(component, "start");
    if (acts) {
        auto activity = activity_check_of(component);  // first: no other check has started the component before
        checks.add(std::move(activity.name), std::move(activity.run));
    }
    checks.add("can_be_bound_and_released", [ref](Program& program) { can_be_bound_and_released(program, ref); });
    for (auto const& query : messages(component, MessageKind::query)) {
        checks.add("answers_the_query_" + query.name, [ref, query](Program& program) { answers_the_query(program, ref, query); });
        checks.add("answers_requests_behind_the_query_" + query.name,
                   [ref, query](Program& program) { answers_a_request_behind_the_query(program, ref, query.name); });
    }
    checks.add("refuses_an_unknown_command", [ref](Program& program) {
        require_refusal(program.execute(ref, unknown_name, {}, true).reply, "an unknown command");
    });
    for (auto const& command : messages(component, MessageKind::command)) add_checks_of(checks, component, command);
    if (!acts) return group;
    checks.add("completes_start_once", [ref](Program& program) {
        auto const id = start(program, ref);
        std::this_thread::sleep_for(300ms);
        stop(program, ref);
        program.completed(id, longest_halt);
    });
    checks.add("accepts_stop_without_a_start", [ref](Program& program) {
        stop(program, ref);
        stop(program, ref);
    });
    for (auto const& command : own_commands(component))
        checks.add("completes_" + command.name + "_once", [ref, command](Program& program) {
            program.completed(run(program, ref, command.name, arguments_of(command)), program.patience());
        });
    for (auto& check : halting_checks_of(component)) checks.add(std::move(check.name), std::move(check.run));
    for (auto const* pause : {"suspend", "resume"})
        checks.add("answers_" + std::string{pause}, [ref, pause](Program& program) {
            auto const run = program.execute(ref, pause);
            if (run.reply.return_code == ReturnCode::ok) program.completed(run.id, longest_halt);
        });
    return group;
}

}  // namespace rois::component_test
