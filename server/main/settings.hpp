// All that can be configured, with its default.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "engine/settings.hpp"
#include "media/settings.hpp"
#include "net/settings.hpp"

namespace rois {

enum class LogFormat : std::uint8_t { text, json };
enum class LogLevel : std::uint8_t { debug, info, warning, error };

struct Settings {
    net::Settings net;
    EngineSettings engine;
    media::Settings media;  // without a host nothing is streamed
    std::string engine_name = "reception";
    double sim_speed = 1;
    std::uint64_t seed = 1;
    std::string floor_plan;  // a file; empty: the reception hall that comes with the program
    std::string scenario;
    std::string profiles;  // a folder of component profiles; empty: none
    LogFormat log_format = LogFormat::text;
    LogLevel log_level = LogLevel::info;

    Settings();
};

// One line that says what is wrong, and where.
class BadSettings : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace rois
