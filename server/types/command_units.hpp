// What execute sends (7.4.3.1, tables 10 to 15; decision 14): command messages in sequence and in parallel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "types/ids.hpp"
#include "types/values.hpp"

namespace rois {

// Table 12. The id is empty until the engine or the application gives one.
struct CommandMessage {
    Identifier component_ref;
    std::string command_type;
    CommandId command_id;
    ParameterList arguments;
};

struct CommandUnit;

// One branch of ConcurrentCommands; its commands run in sequence. Each is a CommandMessage, perhaps with a delay.
struct Branch {
    std::vector<CommandUnit> command_list;
};

// A unit without a type of its own: it only delays.
struct DelayOnly {};

// The published parallel unit. In the flat form each branch has one command and is written as command_list.
struct ConcurrentCommands {
    enum class Form : std::uint8_t { branch_list, command_list };
    Form form = Form::branch_list;
    std::vector<Branch> branches;
};

// The seed's units, nested freely (tables 14, 15).
struct SequentialCommandUnit {
    std::vector<CommandUnit> command_unit_list;
};
struct ParallelCommandUnit {
    std::vector<CommandUnit> command_unit_list;
};

// CommandBase (table 11). `delay_time`: milliseconds from when the unit's turn comes; what does not fit 64 bits is saturated.
struct CommandUnit {
    std::optional<std::int64_t> delay_time;
    std::variant<DelayOnly, CommandMessage, ConcurrentCommands, SequentialCommandUnit, ParallelCommandUnit> unit;
};

struct CommandUnitSequence {
    std::vector<CommandUnit> command_unit_list;
};

}  // namespace rois
