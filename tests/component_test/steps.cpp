#include "component_test/steps.hpp"

#include <algorithm>
#include <thread>

#include "conformance/check.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;
using conformance::Skipped;

Condition only(std::string const& ref) {
    return {PropertyComparison{.left = {ValueReference{"component_ref"}}, .right = {Literal{ref}}}};
}

// Returns a valid value of this type. `number`: the value of a number without a default value.
std::vector<std::string> some_value(ParameterProfile const& profile, std::string const& number) {
    if (profile.default_value) return default_values(profile.data_type_ref, *profile.default_value);
    switch (DataType::of(profile.data_type_ref).base) {
        case BaseType::integer:
        case BaseType::real:
            return {number};
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

ParameterList arguments_with(MessageProfile const& command, std::string const& number) {
    ParameterList all;
    for (auto const& each : command.arguments) all.push_back(parameter(each, some_value(each, number)));
    return all;
}

}  // namespace

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

void require_no_session(xml::EngineMessage const& answer, std::string const& what) {
    auto const* fault = std::get_if<Fault>(&answer);
    require(fault != nullptr && fault->code == FaultCode::no_session, what + ": expected the fault no_session");
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

Query query_of(std::string const& ref, std::string const& query) {
    Query asked{.query_type = query, .condition = {}};
    asked.condition.filter = only(ref);
    return asked;
}

std::vector<MessageProfile> messages(ComponentEntry const& component, MessageKind kind) {
    std::vector<MessageProfile> found;
    std::ranges::copy_if(component.profile->messages, std::back_inserter(found),
                         [&](auto const& each) { return each.kind == kind; });
    return found;
}

bool has_command(ComponentEntry const& component, char const* name) {
    return find_message(*component.profile, MessageKind::command, name) != nullptr;
}

std::vector<MessageProfile> own_commands(ComponentEntry const& component) {
    auto found = messages(component, MessageKind::command);
    std::erase_if(found, [](auto const& each) { return std::ranges::find(common_commands, each.name) != common_commands.end(); });
    return found;
}

std::vector<MessageProfile> own_actions(ComponentEntry const& component) {
    auto found = own_commands(component);
    std::erase_if(found, [](auto const& each) { return each.name == "set_parameter"; });
    return found;
}

ParameterList arguments_of(MessageProfile const& command) { return arguments_with(command, "1"); }

ParameterList long_arguments(Program& program, std::string const& ref, MessageProfile const& command) {
    for (auto const* number : {"100", "10"}) {
        auto arguments = arguments_with(command, number);
        if (program.execute(ref, command.name, arguments, true).reply.return_code == ReturnCode::ok) return arguments;
    }
    return arguments_of(command);
}

void open_session(Program& program, std::chrono::milliseconds with_window) {
    program.ensure_ready();
    program.disconnect();
    program.connect(with_window);
    program.ensure_ready();
}

void lose_link(Program& program, std::chrono::milliseconds down) {
    program.cut();
    std::this_thread::sleep_for(down);
    program.await_join();
    require_ok(program.ask(Resume{program.session(), program.last_sequence()}), "resume within the window");
}

void bind(Program& program, std::string const& ref) { require_ok(program.ask(Bind{identifier(ref)}), "bind"); }

void subscribe(Program& program, ComponentEntry const& component) {
    bool has_new = false;
    for (auto const& event : messages(component, MessageKind::event)) {
        if (program.has_subscribed(event.name)) continue;
        has_new = true;
        auto const reply = program.ask(Subscribe{.event_type = event.name, .condition = {}, .inline_results = true});
        require_ok(reply, "subscribe to " + event.name);
        require(!reply.subscribe_id.text.empty(), "subscribe: expected a subscribe_id, got none");
    }
    if (has_new) program.settle();
}

std::string start(Program& program, std::string const& ref) { return run(program, ref, "start", {}); }

std::string run(Program& program, std::string const& ref, std::string const& command, ParameterList const& arguments) {
    auto const started = program.execute(ref, command, arguments);
    if (started.reply.return_code != ReturnCode::ok)
        throw Skipped{command + " is refused with the arguments that rois-component-test has chosen: " + started.reply.reason};
    return started.id;
}

void stop(Program& program, std::string const& ref) {
    auto const stopped = program.execute(ref, "stop");
    require_ok(stopped.reply, "stop");
    auto const end = program.completed(stopped.id, longest_halt);
    require(end.status == CompletedStatus::ok,
            "stop: expected `completed` with OK, got " + std::string{to_text(end.status)} + ": " + end.reason);
    require(end.active == false, "stop: expected `completed` with active=\"false\"");
}

Switches switches(Program& program, ComponentEntry const& component) {
    Switches found;
    for (auto const& query : messages(component, MessageKind::query)) {
        auto const reply = program.ask(query_of(component.ref, query.name));
        for (auto const& result : query.results) {
            if (DataType::of(result.data_type_ref).base != BaseType::boolean) continue;
            auto const* given = find(reply.results.parameters, result.name);
            if (given != nullptr && !given->values.empty())
                found[quoted(result.name) + " of the query " + quoted(query.name)] = given->values.front();
        }
    }
    return found;
}

bool is_quiet(Program& program, ComponentEntry const& component) {
    auto const known = program.quiet().find(component.ref);
    if (known != program.quiet().end()) return known->second;
    subscribe(program, component);
    auto const before = program.events_of(component.ref);
    program.settle(time_at_rest);
    return program.quiet()[component.ref] = program.events_of(component.ref) == before;
}

void require_rest(Program& program, ComponentEntry const& component, std::string const& after, std::chrono::milliseconds time) {
    if (!is_quiet(program, component)) throw Skipped{"the component also reports events when nothing runs"};
    auto const before = program.events_of(component.ref);
    program.settle(time);
    auto const late = program.events_of(component.ref) - before;
    require(late == 0, after + ": expected that the component stands still, got " + std::to_string(late) + " events within " +
                           std::to_string(time.count()) + " ms");
}

}  // namespace rois::component_test
