// Stop for everything (docs/safety.md): halts all robots of a gateway, also those that other applications command.
#pragma once

#include "rois/error.hpp"
#include "rois/settings.hpp"
#include "types/messages.hpp"

namespace rois {

// Both need no session and no Connection, and work while a Connection's link is lost or its thread is busy. They open a
// connection of their own and block until the gateway has answered, for Settings::deadline at most. From any thread. They throw
// Error: TIMEOUT if the deadline passed, ERROR if the gateway refused, the connection failed or the answer is not a `stop_state`
// document; std::invalid_argument if the URL is invalid. Of the settings they use url, token, ca_file and deadline. Both return
// the state afterwards.

// Halts every component of every session. Until `clear_everything`, nothing starts. `StopState::not_halted` names the components
// that have not confirmed yet that they stand still: the gateway waits for them, and repeats their halt if they fail.
StopState stop_everything(Settings const& = {});

// Lets commands start again.
StopState clear_everything(Settings const& = {});

}  // namespace rois
