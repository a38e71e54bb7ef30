// Command sequences: what is in them, and waiting for their ends.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command/context.hpp"
#include "types/command_units.hpp"

namespace rois::command {

// All command messages, in document order, also those inside of other units.
std::vector<CommandMessage*> messages_of(CommandUnitSequence&);

// An id that no other command has.
CommandId fresh_command_id();

// Binds what the sequence needs, executes it and, with --wait, waits until all has completed, which is written as it happens.
// Throws Trouble with the code of the first command that did not end with OK.
void run(Context&, CommandUnitSequence);

// Why a command failed, as the engine says it; empty if the engine gives no reason. Asks the engine.
std::string reason_of(Context&, CommandId const&);

struct Awaited {
    CommandId id;
    std::string label;  // for people: "start navigation"
};

// What is thrown when the session is gone in which something was commanded.
Trouble ended_with_session();

// Waits until all have completed. Throws as above.
void wait_for(Context&, std::vector<Awaited>);

}  // namespace rois::command
