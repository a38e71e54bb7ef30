// Every configuration key, once: the same name is a flag (--sim-speed), a variable (ROIS_SIM_SPEED) and a key of the file
// (sim_speed).
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
    std::string value;    // what stands behind the flag: "SECONDS"
    std::string must_be;  // for whoever gave something else: "a number of seconds from 0.1 to 86400"
    Kind kind = Kind::text;
    std::function<bool(Settings&, std::string const&)> set;  // false, and nothing changed, when the text is no such value
    std::function<std::string(Settings const&)> show;        // the value as a text that `set` would take
};

std::vector<Key> const& keys();

std::string flag_of(Key const&);      // --sim-speed
std::string variable_of(Key const&);  // ROIS_SIM_SPEED

}  // namespace rois
