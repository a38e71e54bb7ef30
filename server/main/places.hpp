// Whether the gateway can make the files that its settings name.
#pragma once

#include "main/settings.hpp"

namespace rois {

// Throws BadSettings if it cannot write `state` or `audit_log`. Makes nothing.
void check_places(GatewaySettings const&);

}  // namespace rois
