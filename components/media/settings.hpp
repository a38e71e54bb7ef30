// How media are served.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace rois::media {

// Where RTP may be sent: an application names the target, and so could make this machine send datagrams to anybody.
enum class RtpTargets : std::uint8_t { loopback, any };

struct Settings {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any free one
    std::string url;         // under which others reach it, "https://robots.example/m"; empty: http://HOST:PORT
    // Which requests are answered: by their Host, and by their Origin beside it. Null: all. Called on the server's own thread.
    std::function<bool(std::string_view host)> is_own_host;
    std::function<bool(std::string_view origin, std::string_view host)> is_allowed_origin;
    RtpTargets rtp_targets = RtpTargets::loopback;
    std::size_t max_connections = 64;
    std::size_t max_header = 8 * 1024;  // bytes
    std::chrono::milliseconds request_timeout = std::chrono::seconds{10};
    std::chrono::milliseconds write_timeout = std::chrono::seconds{10};  // for a receiver to take what is its turn
    // After the last request for a single picture, until nobody counts as receiving it.
    std::chrono::milliseconds picture_interest = std::chrono::seconds{5};
};

}  // namespace rois::media
