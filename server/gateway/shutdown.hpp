// How the process ends: after all components have halted, or in an emergency.
#pragma once

#include <chrono>
#include <string_view>

#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"
#include "types/instant.hpp"

namespace rois {

// Waits until all components have confirmed that they stand still, at most until `until`. The gateway must still tick. Logs the
// components that have not confirmed, and returns whether there is none.
bool await_halts(Gateway const&, Steady until, std::chrono::milliseconds between_looks);

// Halts all components, logs the reason, and ends the process with 70 (EX_SOFTWARE), so that its supervisor can restart it. Not
// with the engine locked.
[[noreturn]] void halt_and_exit(Gateway&, Telemetry const&, std::string_view why);

}  // namespace rois
