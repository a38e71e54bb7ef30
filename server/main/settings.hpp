// All settings, with their defaults.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "engine/settings.hpp"
#include "media/settings.hpp"
#include "net/settings.hpp"
#include "wire/tls_files.hpp"

namespace rois {

enum class LogFormat : std::uint8_t { text, json };
enum class LogLevel : std::uint8_t { debug, info, warning, error };

// Whether the component simulated_hall exists (docs/simulation.md).
enum class Steering : std::uint8_t { off, on };

// Whether the robots of the simulated hall have components. Without them, the engine has only those of its sub engines.
enum class Robots : std::uint8_t { simulated, none };

struct GatewaySettings {
    net::Settings net;
    EngineSettings engine;
    media::Settings media;                                // without a host, no streams are served
    tls::Files tls;                                       // without a certificate, both serve without TLS
    std::string tokens;                                   // a file; empty: clients need no token
    bool allow_anyone = false;                            // without tokens, serve other machines too
    std::size_t max_wrong_tokens = 10;                    // of one address in a minute
    std::string audit_log;                                // a file; empty: none
    std::size_t audit_log_bytes = std::size_t{10} << 20;  // of one file
    std::size_t audit_log_files = 10;                     // earlier ones that are kept
    std::string state;                                    // the journal's folder; empty: nothing is stored
    std::size_t state_bytes = std::size_t{512} << 20;     // of its files
    std::string engine_name = "reception";
    double sim_speed = 1;  // 0: simulated time stands still, and there is steering
    Steering steering = Steering::off;
    Robots robots = Robots::simulated;
    std::uint64_t seed = 1;
    std::string floor_plan;  // a file; empty: the built-in reception hall
    std::string scenario;
    std::string profiles;               // a folder of component profiles; empty: none
    std::string engines;                // a file of sub engines; empty: none
    std::string join;                   // URL of the gateway to join as a sub engine; empty: none
    std::string join_as;                // name used to join; empty: engine_name
    std::string join_token_file;        // holds the token that is sent to that gateway; empty: none
    std::string join_ca_file;           // certificates that it may have; empty: those of the system
    std::string join_certificate_file;  // the own certificate and its key, shown to it; empty: none
    LogFormat log_format = LogFormat::text;
    LogLevel log_level = LogLevel::info;

    GatewaySettings();
};

// An invalid setting. The message is one line, with the place and the reason.
class BadSettings : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace rois
