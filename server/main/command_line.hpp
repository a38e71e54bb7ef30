// The command line of rois-gateway, and the settings that result from it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "main/settings.hpp"
#include "main/tokens_file.hpp"

namespace rois {

struct CommandLine {
    enum class Wish : std::uint8_t {
        serve,
        say,
        check_config,
        check_health,
        check_profiles,
        add_token,
        list_tokens,
        revoke_token
    } wish = Wish::serve;
    std::string words;                  // output for `say`: help, version, configuration
    std::string folder;                 // the folder of profiles to check
    TokenEntry token{};                 // to add or to revoke
    std::vector<std::string> warnings;  // about settings that are ignored
    GatewaySettings settings;           // in order of precedence: flags, environment variables, the file, defaults
    // Reads them again: the file may have changed. Throws BadSettings.
    std::function<GatewaySettings()> read_again{};
};

// Throws BadSettings if a setting is invalid.
CommandLine read_command_line(int argc, char const* const* argv);

}  // namespace rois
