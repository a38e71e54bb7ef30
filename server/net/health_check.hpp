// Asks a running gateway whether it lives: for containers that have no other tool to do so.
#pragma once

#include <cstdint>
#include <string>

namespace rois::net {

// Nothing wrong: an empty text; otherwise why the gateway that listens there is not healthy. Takes two seconds at most.
std::string check_health(std::string const& host, std::uint16_t port);

}  // namespace rois::net
