// What the program was started to do.
#pragma once

#include <string>
#include <vector>

#include "main/settings.hpp"

namespace rois {

struct CommandLine {
    enum class Wish : std::uint8_t { serve, say, check_config, check_health, check_profiles } wish = Wish::serve;
    std::string words;                  // to say: help, version, configuration
    std::string folder;                 // whose profiles are to be checked
    std::vector<std::string> warnings;  // about what was ignored
    Settings settings;                  // from flags, else variables, else the file, else the defaults
};

// Throws BadSettings.
CommandLine read_command_line(int argc, char const* const* argv);

}  // namespace rois
