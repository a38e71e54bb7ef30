// Blocking TCP on the loopback: both sides of a connection, for proxies and servers of tests.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace rois::kit {

// A connection. One thread reads; any thread may send or end it.
class Socket {
public:
    explicit Socket(int descriptor) : descriptor_{descriptor} {}
    ~Socket();
    Socket(Socket const&) = delete;
    Socket& operator=(Socket const&) = delete;

    void send(std::string_view bytes);
    void end();  // shuts down both directions, so that a blocked reader returns

    // These return nothing if the peer closes first.
    std::optional<std::string> take(std::size_t size);
    std::optional<std::string> take_until(std::string_view mark);
    std::optional<std::string> take_some();

private:
    bool receive();

    int descriptor_;
    std::string received_;
    std::mutex sending_;
};

// Connects to this port of the loopback, and returns the descriptor. Throws std::runtime_error if no server listens.
int connect_to(std::uint16_t port);
int try_connect_to(std::uint16_t port);  // -1 if no server listens

// Listens on a free port of the loopback.
class Listener {
public:
    Listener();
    ~Listener();
    Listener(Listener const&) = delete;
    Listener& operator=(Listener const&) = delete;

    std::uint16_t port() const { return port_; }
    int descriptor() const { return descriptor_; }
    std::optional<int> accept();  // nothing after `end`
    void end();

private:
    int descriptor_;
    std::uint16_t port_ = 0;
};

}  // namespace rois::kit
