// Settings of the media server.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace rois::tls {
class Credentials;
}

namespace rois::media {

// Allowed RTP targets. Applications name the target, so `any` lets them make this machine send datagrams to any address.
enum class RtpTargets : std::uint8_t { loopback, any };

// They may change while the server runs.
struct Limits {
    std::size_t max_connections = 64;
    std::size_t max_header = 16 * 1024;  // bytes of a request line and its header fields
    std::size_t max_header_fields = 100;
    std::size_t max_target = 4 * 1024;                                      // bytes
    std::chrono::milliseconds handshake_timeout = std::chrono::seconds{5};  // of TLS
    std::chrono::milliseconds request_timeout = std::chrono::seconds{10};
    std::chrono::milliseconds write_timeout = std::chrono::seconds{10};  // of one piece to a receiver
};

struct Settings {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any free port
    std::string url;         // public URL, "https://robots.example/m"; empty: http(s)://HOST:PORT
    // Return whether a request with this Host or Origin header is accepted. Null: accept all. Called on the server's own thread.
    std::function<bool(std::string_view host)> is_own_host;
    std::function<bool(std::string_view origin, std::string_view host)> is_allowed_origin;
    RtpTargets rtp_targets = RtpTargets::loopback;
    std::shared_ptr<tls::Credentials> credentials{};  // null: no TLS
    Limits limits{};
    // How long a request for a single picture counts as a receiver.
    std::chrono::milliseconds picture_interest = std::chrono::seconds{5};
};

}  // namespace rois::media
