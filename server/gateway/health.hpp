// Whether the gateway is alive (/healthz) and ready (/readyz). The functions return the reason why not, as lines of text, or an
// empty text.
#pragma once

#include <string>

#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"

namespace rois {

// Does not use the engine, which may be locked.
std::string why_not_alive(Telemetry const&);
// With the components that the asker may see; null: all.
std::string why_not_ready(Gateway const&, Telemetry const&, Principal const* asker = nullptr);

}  // namespace rois
