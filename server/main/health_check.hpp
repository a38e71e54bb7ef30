// Asks a running gateway whether it is ready, for containers without another tool for that.
#pragma once

#include <cstdint>
#include <string>

namespace rois {

// Returns why the gateway at this address is not healthy, or an empty text if it is. Takes at most two seconds.
std::string check_health(std::string const& host, std::uint16_t port);

}  // namespace rois
