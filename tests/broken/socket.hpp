// Blocking TCP for the proxy: both sides of a connection.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace rois::broken {

// A connection. One thread reads; any may send or end it.
class Socket {
public:
    explicit Socket(int descriptor) : descriptor_{descriptor} {}
    ~Socket();
    Socket(Socket const&) = delete;
    Socket& operator=(Socket const&) = delete;

    void send(std::string_view bytes);
    void end();  // both directions, so that who reads stops

    // Nothing when the peer has closed before.
    std::optional<std::string> take(std::size_t size);
    std::optional<std::string> take_until(std::string_view mark);
    std::optional<std::string> take_some();

private:
    bool receive();

    int descriptor_;
    std::string received_;
    std::mutex sending_;
};

// A connection to this port of the loopback. Throws std::runtime_error when nobody listens.
int connect_to(std::uint16_t port);

class Listener {
public:
    Listener();
    ~Listener();
    Listener(Listener const&) = delete;
    Listener& operator=(Listener const&) = delete;

    std::uint16_t port() const { return port_; }
    std::optional<int> accept();  // nothing once it ended
    void end();

private:
    int descriptor_;
    std::uint16_t port_ = 0;
};

}  // namespace rois::broken
