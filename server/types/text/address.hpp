// The address on which a server listens, as a text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

struct HostAndPort {
    std::string host;  // a name or an address; an IPv6 address has no brackets
    std::uint16_t port = 0;
};

// Parses "HOST:PORT", with an IPv6 address in brackets. Returns nothing for any other text. "*:PORT" and ":PORT" are rejected
// too: they do not say whether IPv4 or IPv6 is meant.
std::optional<HostAndPort> read_host_and_port(std::string_view);

// Returns "HOST:PORT", with an IPv6 address in brackets.
std::string host_and_port(std::string const& host, std::uint16_t port);

}  // namespace rois
