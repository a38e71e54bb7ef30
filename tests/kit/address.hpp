// The address of a gateway.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rois::kit {

struct Address {
    std::string host = "127.0.0.1";  // a name or an IP address
    std::uint16_t port = 0;
    std::string authority = "localhost";  // for the header Host
    std::string token{};                  // the bearer token; may be empty
    bool tls = false;
    std::string ca_file{};                       // PEM: the only certificates to trust; empty: those of the system
    std::string certificate{}, key{};            // PEM files: the client's own; may be empty
    std::chrono::milliseconds patience{20'000};  // longest wait for one answer, notification or connection
};

}  // namespace rois::kit
