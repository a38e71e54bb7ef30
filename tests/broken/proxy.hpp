// Stands in front of a gateway and breaks one of its rules: whoever asks here, asks a gateway that is broken in one way.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "broken/socket.hpp"

namespace rois::broken {

// Documents, in order.
using Documents = std::vector<std::string>;

// What an application and the gateway say to each other over one connection.
class Link {
public:
    virtual ~Link() = default;
    // Asks the gateway something of which the application hears nothing.
    virtual void ask_aside(std::string const& request) = 0;
};

// An HTTP message: its first line and header lines, each with CR LF, and its body.
struct Message {
    std::string first_line;
    std::vector<std::string> headers;
    std::string body;
    bool has_length = true;  // one Content-Length, which is a number; else it goes on as it is
};

// What the proxy does otherwise, for one connection. Without these, it changes nothing.
struct Breaking {
    // What is answered without asking the gateway; nothing to ask.
    std::function<Documents(std::string const& request)> instead{};
    // What is asked of the gateway.
    std::function<std::string(std::string request)> request{};
    // What is said instead of this answer. Notifications among them, over a WebSocket, are counted in.
    std::function<Documents(std::string const& request, std::string answer, Link&)> answer{};
    // What is said instead of this notification, over a WebSocket; those that are more or fewer than one are counted anew.
    std::function<Documents(std::string notification)> notification{};
    // Over HTTP alone: whole messages.
    std::function<void(Message& request)> http_request{};
    std::function<void(Message const& request, Message& reply)> http_reply{};
};

// Listens on a free port of the loopback until it ends. Each connection has its own Breaking.
class Proxy {
public:
    Proxy(std::uint16_t gateway, std::function<Breaking()> breaking);
    ~Proxy();
    Proxy(Proxy const&) = delete;
    Proxy& operator=(Proxy const&) = delete;

    std::uint16_t port() const { return listener_.port(); }

private:
    void accept();

    std::uint16_t gateway_;
    std::function<Breaking()> breaking_;
    Listener listener_;
    std::atomic<bool> ending_ = false;
    std::list<std::thread> connections_;
    std::thread accepting_;
};

}  // namespace rois::broken
