// The address of the gateway.
#pragma once

#include <string>
#include <string_view>

#include "rois/settings.hpp"

namespace rois::client {

enum class Security : std::uint8_t { plain, tls };

struct Target {
    std::string host;  // a name or an address; an IPv6 address without its brackets
    std::string port;
    std::string authority;  // for the header Host
    std::string path;       // of /rois, with the URL's own path before it
    Security security = Security::plain;
};

// Whether others could read messages to this target: it is another machine, and has no TLS.
bool is_in_the_clear(Target const&);

// Throws std::invalid_argument if the text is not a URL of http, https, ws or wss, or if the token would be sent to another
// machine without TLS. `token`: empty if there is none.
Target read_url(std::string_view url, std::string_view token = {});

}  // namespace rois::client
