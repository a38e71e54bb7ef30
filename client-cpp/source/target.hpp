// Where the gateway is.
#pragma once

#include <string>
#include <string_view>

#include "rois/settings.hpp"

namespace rois::client {

enum class Security : std::uint8_t { plain, tls };

struct Target {
    std::string host;  // a name or an address; an IPv6 address without its brackets
    std::string port;
    std::string authority;  // as the header Host has it
    std::string path;       // of /rois
    Security security = Security::plain;
};

// Throws std::invalid_argument for what is no URL of http, https, ws or wss.
Target read_url(std::string_view url);

}  // namespace rois::client
