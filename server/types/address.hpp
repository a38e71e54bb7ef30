// Where a server listens, as people write it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

struct HostAndPort {
    std::string host;  // a name or an address; an IPv6 address without its brackets
    std::uint16_t port = 0;
};

// Reads "HOST:PORT"; an IPv6 address stands in brackets. Returns nothing for any other text, also for "*:PORT" and ":PORT": they
// do not say which addresses are meant.
std::optional<HostAndPort> read_host_and_port(std::string_view);

}  // namespace rois
