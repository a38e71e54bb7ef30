// A proxy in front of a gateway. It breaks one rule: its clients see a gateway with one error.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "kit/socket.hpp"

namespace rois::broken {

// XML documents, in the order in which they are sent.
using Documents = std::vector<std::string>;

// The messages between an application and the gateway over one connection.
class ProxiedConnection {
public:
    virtual ~ProxiedConnection() = default;
    // Sends a request to the gateway. The application does not receive the answer.
    virtual void send_hidden(std::string const& request) = 0;
};

// An HTTP message: its first line and header lines, each with CR LF, and its body.
struct Message {
    std::string first_line;
    std::vector<std::string> headers;
    std::string body;
    bool has_length = true;  // exactly one Content-Length with a number; otherwise the message is not changed
};

// The changes that the proxy makes on one connection. An empty function changes nothing.
struct Breaking {
    // Returns the proxy's own answer, or nothing to forward the request.
    std::function<Documents(std::string const& request)> instead{};
    // Returns the request to forward.
    std::function<std::string(std::string request)> request{};
    // Returns the documents to send instead of this answer. Over a WebSocket, notifications among them get the next sequence
    // numbers.
    std::function<Documents(std::string const& request, std::string answer, ProxiedConnection&)> answer{};
    // Returns the documents to send instead of this notification, over a WebSocket. Later notifications are renumbered.
    std::function<Documents(std::string notification)> notification{};
    // Change whole messages, over HTTP only.
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
    kit::Listener listener_;
    std::atomic<bool> ending_ = false;
    std::list<std::thread> connections_;
    std::thread accepting_;
};

}  // namespace rois::broken
