#include "engine/commands/sequence_check.hpp"

#include <utility>

#include "engine/commands/parameters.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

std::string element(std::string const& path, std::string_view name, std::size_t index) {
    return (path.empty() ? "" : path + "/") + std::string{name} + "[" + std::to_string(index + 1) + "]";
}

std::string command_types_of(ComponentProfile const& profile) {
    auto const is_command = [](MessageProfile const& message) { return message.kind == MessageKind::command; };
    auto const names = listed(profile.messages | std::views::filter(is_command), &MessageProfile::name);
    return names.empty() ? "none" : names;
}

Objection bad_parameter(std::string reason) { return {ReturnCode::bad_parameter, std::move(reason)}; }

}  // namespace

std::vector<ParameterProfile> const* arguments_of(RegisteredComponent const& component, std::string_view command_type) {
    auto const* message = find_message(component.profile(), MessageKind::command, command_type);
    if (message == nullptr) return nullptr;
    if (command_type == "set_parameter") return &component.settable();
    return command_type == "start" ? &component.startable() : &message->arguments;
}

bool begins_action(std::string_view command_type) {
    return command_type != "set_parameter" && command_type != "stop" && command_type != "suspend";
}

bool stores_arguments(std::string_view command_type) { return command_type == "start" || command_type == "set_parameter"; }

std::optional<Objection> SequenceCheck::objection(CommandUnitSequence const& sequence) {
    return in_list(sequence.command_unit_list, "", "command_unit_list");
}

std::optional<Objection> SequenceCheck::in_list(std::vector<CommandUnit> const& units, std::string const& path,
                                                std::string_view name) {
    auto const around = path.empty() ? "" : path + ": ";
    if (units.empty()) return bad_parameter(around + "there is no " + std::string{name});
    auto const before = commands();
    for (std::size_t i = 0; i < units.size(); ++i)
        if (auto problem = in_unit(units[i], element(path, name, i))) return problem;
    if (commands() == before)  // tables 10 and 13
        return bad_parameter(around + "there is no command message in the " + std::string{name} +
                             ", only delays; at least one is expected");
    return {};
}

std::optional<Objection> SequenceCheck::in_unit(CommandUnit const& unit, std::string const& path) {
    if (unit.delay_time && (*unit.delay_time < 0 || *unit.delay_time > max_delay_time))
        return bad_parameter(path + ": delay_time must be 0 to " + std::to_string(max_delay_time) + " milliseconds");
    delays_something_ = delays_something_ || unit.delay_time.value_or(0) > 0;
    if (auto const* message = std::get_if<CommandMessage>(&unit.unit)) {
        auto problem = command(*message, path);
        if (problem) problem->reason.insert(0, path + ": ");
        return problem;
    }
    if (auto const* concurrent = std::get_if<ConcurrentCommands>(&unit.unit)) return in_branches(*concurrent, path);
    if (auto const* sequential = std::get_if<SequentialCommandUnit>(&unit.unit))
        return in_list(sequential->command_unit_list, path, "command_unit_list");
    if (auto const* parallel = std::get_if<ParallelCommandUnit>(&unit.unit))
        return in_list(parallel->command_unit_list, path, "command_unit_list");
    return {};
}

std::optional<Objection> SequenceCheck::in_branches(ConcurrentCommands const& concurrent, std::string const& path) {
    if (concurrent.branches.empty()) return bad_parameter(path + ": there is no branch");
    for (std::size_t i = 0; i < concurrent.branches.size(); ++i) {
        auto const& commands = concurrent.branches[i].command_list;
        auto problem = concurrent.form == ConcurrentCommands::Form::command_list && commands.size() == 1
                           ? in_unit(commands.front(), element(path, "command_list", i))
                           : in_list(commands, element(path, "branch_list", i), "command_list");
        if (problem) return problem;
    }
    return {};
}

std::optional<Objection> SequenceCheck::objection(CommandMessage const& message) { return command(message, {}); }

std::optional<Objection> SequenceCheck::command(CommandMessage const& message, std::string const& path) {
    begins_something_ = begins_something_ || begins_action(message.command_type);
    sets_something_ = sets_something_ || message.command_type == "set_parameter";
    // First: a client that repeats a command must learn that it was accepted, also while the component is away.
    if (auto problem = id(message.command_id)) return problem;
    auto [component, problem_of_ref] = registry_.meant(message.component_ref, session_);
    if (component == nullptr) return bad_parameter(std::move(problem_of_ref));
    if (component->bound_to != &session_)
        return Objection{ReturnCode::error, "the component " + quoted(component->ref().code) + " is not bound by this session"};
    return values(message, *component, path);
}

std::optional<Objection> SequenceCheck::values(CommandMessage const& message, RegisteredComponent& component,
                                               std::string const& path) {
    auto const* profiles = arguments_of(component, message.command_type);
    if (profiles == nullptr)
        return bad_parameter("the component " + quoted(component.ref().code) + " has no command " + quoted(message.command_type) +
                             "; it has " + command_types_of(component.profile()));
    if (auto problem = why_not(*profiles, message.arguments)) return bad_parameter(std::move(*problem));
    auto parameters = normalized(*profiles, message.arguments);
    if (auto problem = component.why_no_frame(parameters, frames_)) return bad_parameter(std::move(*problem));
    if (auto problem = component.why_no_codebook(*profiles, parameters)) return bad_parameter(std::move(*problem));
    if (stores_arguments(message.command_type)) {
        bool const starts = message.command_type == "start";
        if (auto problem = starts ? component.why_no_start(parameters) : std::nullopt) return bad_parameter(std::move(*problem));
        auto const stored = stored_.try_emplace(&component, component.parameters).first;
        stored->second = component.merged(std::move(stored->second), parameters);
        parameters = starts ? component.for_start(stored->second, parameters) : stored->second;
    } else {
        if (auto problem = why_incomplete(*profiles, parameters)) return bad_parameter(std::move(*problem));
        parameters = with_defaults(*profiles, parameters);
    }
    preparations_.push_back({.component = component.shared_from_this(),
                             .command_type = message.command_type,
                             .parameters = std::move(parameters),
                             .path = path,
                             .stops = component.stops});
    return {};
}

std::optional<Objection> SequenceCheck::id(CommandId const& id) {
    if (id.text.empty()) return {};
    if (session_.commands.contains(id)) return bad_parameter("the command_id " + quoted(id.text) + " is in use in this session");
    if (!ids_.insert(id).second) return bad_parameter("the command_id " + quoted(id.text) + " is given twice");
    return {};
}

}  // namespace rois
