// A connection of the load generator: HTTP or WebSocket over TCP to 127.0.0.1. All sent bytes are prepared in advance. The
// connection blocks only while it is prepared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois::bench {

enum class Via : std::uint8_t { http, websocket };

// The bytes of one request. `session` is left out when empty.
std::string http_post(std::string_view path, std::string_view session, std::string_view body);
std::string http_get(std::string_view path, std::string_view session, std::string_view accept);
std::string text_frame(std::string_view payload);  // masked, as clients must

class Socket {
public:
    // Connects, and performs the handshake of a WebSocket. Throws std::runtime_error if either fails.
    Socket(std::uint16_t port, Via via, std::string_view path);
    ~Socket();
    Socket(Socket&&) noexcept;
    Socket& operator=(Socket&&) = delete;
    Socket(Socket const&) = delete;

    int descriptor() const { return descriptor_; }
    Via via() const { return via_; }

    // Sends all bytes; blocks until the kernel has taken them.
    void send(std::string_view bytes);

    // The next complete answer or text frame, or nothing if none has arrived. Valid until the next call. Answers pings. Throws
    // std::runtime_error if the server closed the connection.
    struct Message {
        std::string_view head;  // HTTP only
        std::string_view body;
    };
    std::optional<Message> next();

    // The same, but waits up to 20 s.
    Message wait();

    // Discards all received messages, but answers pings.
    void drain();

private:
    enum class Received : std::uint8_t { some, none };
    Received receive();
    std::optional<Message> next_received();
    std::optional<Message> next_http();
    std::optional<Message> next_frame();
    std::string_view rest() const { return {input_.data() + used_, filled_ - used_}; }

    int descriptor_ = -1;
    Via via_;
    std::string input_;  // grows only
    std::size_t used_ = 0;
    std::size_t filled_ = 0;
};

}  // namespace rois::bench
