// The commands of an execute (7.4.3.1, tables 10 to 15; decision 14): command messages in sequence and in parallel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "types/ids.hpp"
#include "types/values.hpp"

namespace rois {

// Table 12. The application may choose the id; the engine fills in an empty one.
struct CommandMessage {
    Identifier component_ref;
    std::string command_type;
    CommandId command_id;
    ParameterList arguments;
};

struct CommandUnit;

// One branch of ConcurrentCommands. Its commands run in sequence; each is a CommandMessage with an optional delay.
struct Branch {
    std::vector<CommandUnit> command_list;
};

// A unit without a type, which only delays.
struct DelayOnly {};

// The parallel unit of the published XML. In the flat form each branch is one command, written as command_list.
struct ConcurrentCommands {
    enum class Form : std::uint8_t { branch_list, command_list };
    Form form = Form::branch_list;
    std::vector<Branch> branches;
};

// The units of 2011, nested freely (tables 14, 15).
struct SequentialCommandUnit {
    std::vector<CommandUnit> command_unit_list;
};
struct ParallelCommandUnit {
    std::vector<CommandUnit> command_unit_list;
};

// CommandBase (table 11). `delay_time` is the number of milliseconds between the unit's turn and its start, saturated to 64 bits.
struct CommandUnit {
    std::optional<std::int64_t> delay_time;
    std::variant<DelayOnly, CommandMessage, ConcurrentCommands, SequentialCommandUnit, ParallelCommandUnit> unit;
};

struct CommandUnitSequence {
    std::vector<CommandUnit> command_unit_list;
};

}  // namespace rois
