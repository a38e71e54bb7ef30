// Whether other machines can reach an address that the gateway listens on.
#pragma once

#include <string>
#include <vector>

#include "main/settings.hpp"

namespace rois {

// Throws BadSettings if other machines can reach the gateway without a token, and `allow_anyone` does not permit that, or if
// others could read the token for joining. Returns warnings: that it permits that, or that clients send their tokens without TLS.
std::vector<std::string> check_exposure(GatewaySettings const&);

}  // namespace rois
