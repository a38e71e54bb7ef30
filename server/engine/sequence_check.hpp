// Whether a command may run, asked before anything runs (decision 10).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "engine/registry.hpp"
#include "engine/session.hpp"
#include "types/command_units.hpp"

namespace rois {

struct Objection {
    ReturnCode return_code = ReturnCode::bad_parameter;
    std::string reason;
};

// Checks the units of one document in its order, and remembers what earlier ones will have stored.
class SequenceCheck {
public:
    SequenceCheck(Session const& session, Registry const& registry) : session_{session}, registry_{registry} {}

    // The first objection, beginning with the unit's path; nothing when all of it may run.
    std::optional<Objection> objection(CommandUnitSequence const&);

    // One command: known, bound, type, values, in this order.
    std::optional<Objection> objection(CommandMessage const&);

    // How many commands were checked.
    std::size_t commands() const { return commands_; }

    // Whether one of the commands begins or resumes an action.
    bool begins_something() const { return begins_something_; }

    // The ids that the application gave.
    std::set<CommandId> const& ids() const { return ids_; }

private:
    std::optional<Objection> in_list(std::vector<CommandUnit> const&, std::string const& path, std::string_view element);
    std::optional<Objection> in_unit(CommandUnit const&, std::string const& path);
    std::optional<Objection> in_branches(ConcurrentCommands const&, std::string const& path);
    std::optional<Objection> values(CommandMessage const&, RegisteredComponent&);
    std::optional<Objection> id(CommandId const&);

    Session const& session_;
    Registry const& registry_;
    std::size_t commands_ = 0;
    bool begins_something_ = false;
    std::set<CommandId> ids_;
    std::map<RegisteredComponent const*, ParameterList> stored_;  // where it will differ from what is stored now
};

// Which parameters a command of this type may carry; null when the component has no such command.
std::vector<ParameterProfile> const* arguments_of(RegisteredComponent const&, std::string_view command_type);

// Whether a command of this type begins or resumes an action.
bool begins_action(std::string_view command_type);

// Whether what it carries is stored (decision 8); other commands carry arguments, which have default values.
bool stores_arguments(std::string_view command_type);

// The longest delay_time, in milliseconds: a day.
inline constexpr std::int64_t max_delay_time = 86'400'000;

}  // namespace rois
