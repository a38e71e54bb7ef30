// A connection of the load generator: TCP to 127.0.0.1, HTTP or WebSocket on it. What is sent is put together beforehand; while
// a connection is prepared it waits for each answer, and afterwards it never waits.
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
    // Connects, and for a WebSocket shakes hands. Throws std::runtime_error when the server does not play along.
    Socket(std::uint16_t port, Via via, std::string_view path);
    ~Socket();
    Socket(Socket&&) noexcept;
    Socket& operator=(Socket&&) = delete;
    Socket(Socket const&) = delete;

    int descriptor() const { return descriptor_; }
    Via via() const { return via_; }

    // Sends all of it; what the kernel does not take at once is waited for.
    void send(std::string_view bytes);

    // The next whole answer or text frame, until the next call; nothing when there is none yet. Pings are answered on the way.
    // Throws when the server closed the connection.
    struct Message {
        std::string_view head;  // of HTTP
        std::string_view body;
    };
    std::optional<Message> next();

    // The same, but waits for it, five seconds at most.
    Message wait();

    // Reads away whatever came, without looking at it but for WebSockets' pings.
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
