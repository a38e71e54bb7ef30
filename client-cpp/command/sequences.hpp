// Runs command sequences.
#pragma once

#include <string>
#include <vector>

#include "command/context.hpp"
#include "types/command_units.hpp"

namespace rois::command {

// Returns all command messages, at any depth, in document order.
std::vector<CommandMessage*> messages_of(CommandUnitSequence&);

// Returns a unique id.
CommandId fresh_command_id();

// Binds the components of the sequence and executes it. Unless --no-wait is given, waits until all commands have completed, and
// writes each end at once. Throws Trouble with the code of the first command that did not end with OK.
void run(Context&, CommandUnitSequence);

// Asks the engine why a command failed. Returns an empty text if the engine gives no reason.
std::string reason_of(Context&, CommandId const&);

struct Awaited {
    CommandId id;
    std::string label;  // for people: "start navigation"
};

// The error for a session that has ended before its commands.
Trouble ended_with_session();

// Waits until all have completed. Throws like `run`.
void wait_for(Context&, std::vector<Awaited>);

}  // namespace rois::command
