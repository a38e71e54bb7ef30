// Checks whether commands may run, before any of them does (decision 10).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/registry.hpp"
#include "engine/session.hpp"
#include "types/command_units.hpp"

namespace rois {

struct Objection {
    ReturnCode return_code = ReturnCode::bad_parameter;
    std::string reason;
};

// A command that passed the checks of the engine. The component has still to be asked (Component::prepare).
struct Preparation {
    std::shared_ptr<RegisteredComponent> component;
    std::string command_type;
    ParameterList parameters;  // for Component::prepare, in the engine's frame
    std::string path;          // of its unit: "command_unit_list[2]"; empty without a sequence
    std::uint64_t stops = 0;   // RegisteredComponent::stops, when it was checked
    Begin begin{};             // the answer of the component

    // Returns whether the component is asked: it cannot refuse to stop, to suspend or to resume.
    bool asks() const { return command_type != "stop" && command_type != "suspend" && command_type != "resume"; }
};

// Checks the units of one document in order. Takes into account what earlier units will have stored.
class SequenceCheck {
public:
    // `frames`: those that the session may name.
    SequenceCheck(Session const& session, Registry const& registry, Frames const& frames)
        : session_{session}, registry_{registry}, frames_{frames} {}

    // Returns the first objection, beginning with the path of the unit; nullopt if all commands may run.
    std::optional<Objection> objection(CommandUnitSequence const&);

    // Checks one command: id, component known, bound, type, values, in this order.
    std::optional<Objection> objection(CommandMessage const&);

    // The commands that were checked, in document order.
    std::vector<Preparation>& preparations() { return preparations_; }
    std::size_t commands() const { return preparations_.size(); }

    // Returns whether one of the commands begins or resumes an action.
    bool begins_something() const { return begins_something_; }

    // Returns whether a unit has a delay. A sequence without delays that begins nothing is over soon.
    bool delays_something() const { return delays_something_; }

    // Returns whether one of the commands sets parameters.
    bool sets_something() const { return sets_something_; }

    // The ids that the application chose.
    std::set<CommandId> const& ids() const { return ids_; }

private:
    std::optional<Objection> in_list(std::vector<CommandUnit> const&, std::string const& path, std::string_view element);
    std::optional<Objection> in_unit(CommandUnit const&, std::string const& path);
    std::optional<Objection> in_branches(ConcurrentCommands const&, std::string const& path);
    std::optional<Objection> command(CommandMessage const&, std::string const& path);
    std::optional<Objection> values(CommandMessage const&, RegisteredComponent&, std::string const& path);
    std::optional<Objection> id(CommandId const&);

    Session const& session_;
    Registry const& registry_;
    Frames const& frames_;
    std::vector<Preparation> preparations_;
    bool begins_something_ = false;
    bool delays_something_ = false;
    bool sets_something_ = false;
    std::set<CommandId> ids_;
    std::map<RegisteredComponent const*, ParameterList> stored_;  // for components whose parameters an earlier unit changes
};

// The parameters that a command of this type accepts; null if the component has no such command.
std::vector<ParameterProfile> const* arguments_of(RegisteredComponent const&, std::string_view command_type);

// Returns whether a command of this type begins or resumes an action.
bool begins_action(std::string_view command_type);

// Returns whether the values of this command are stored (decision 8). Other commands have arguments, which have default values.
bool stores_arguments(std::string_view command_type);

// The longest delay_time, in milliseconds: one day.
inline constexpr std::int64_t max_delay_time = 86'400'000;

}  // namespace rois
