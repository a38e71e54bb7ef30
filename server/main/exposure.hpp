// Whether other machines can reach an address that the gateway listens on.
#pragma once

#include "main/settings.hpp"

namespace rois {

// Throws BadSettings if other machines can reach the gateway without a token, and `allow_anyone` does not permit that.
void check_exposure(GatewaySettings const&);

}  // namespace rois
