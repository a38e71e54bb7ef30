// How a gateway is reached.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rois::client {

struct Address {
    std::string host = "127.0.0.1";  // a name or a number
    std::uint16_t port = 0;
    std::string authority = "localhost";         // what the header Host says
    std::string token{};                         // the bearer token; empty: none
    std::chrono::milliseconds patience{20'000};  // how long one thing is waited for
};

}  // namespace rois::client
