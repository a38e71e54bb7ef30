// The configuration keys. Each key is also a flag (--sim-speed) and an environment variable (ROIS_SIM_SPEED).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "main/settings.hpp"

namespace rois {

struct Key {
    enum class Kind : std::uint8_t { text, number };

    std::string name;
    std::string help;
    std::string value;    // placeholder of the value in the help: "SECONDS"
    std::string must_be;  // expected values, for error messages: "a number of seconds from 0.1 to 86400"
    Kind kind = Kind::text;
    std::function<bool(GatewaySettings&, std::string const&)>
        set;  // returns false, and changes nothing, if the text is not a valid value
    std::function<std::string(GatewaySettings const&)> show;  // returns the value as a text that `set` accepts
};

std::vector<Key> const& keys();

std::string flag_of(Key const&);      // --sim-speed
std::string variable_of(Key const&);  // ROIS_SIM_SPEED

}  // namespace rois
