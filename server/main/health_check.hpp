// Asks a running gateway whether it is ready, for containers without another tool for that.
#pragma once

#include <cstdint>
#include <string>

#include "wire/tls_files.hpp"

namespace rois {

// Returns why the gateway at this address is not healthy, or an empty text if it is. Takes at most two seconds. With TLS, shows
// the gateway's own certificate, and does not check whose certificate it gets: the gateway is on this machine.
std::string check_health(std::string const& host, std::uint16_t port, tls::Files const&);

}  // namespace rois
