// The engine's side of a WebSocket that a component program has opened.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include "kit/socket.hpp"

namespace rois::component_test {

using Clock = std::chrono::steady_clock;

class Link {
public:
    // Answers the handshake. Throws Broken if it is not a WebSocket handshake for /rois/engines.
    explicit Link(int descriptor);
    ~Link();
    Link(Link const&) = delete;
    Link& operator=(Link const&) = delete;

    void send(std::string_view document);
    // Returns the next text message, or nothing if none arrives before the deadline or the link has ended.
    std::optional<std::string> next(Clock::time_point until);
    // Sends a ping with this payload. Returns whether its pong arrives before the deadline.
    bool ping(std::string const& payload, Clock::time_point until);
    bool has_ended() const;
    // Ends the connection without a close frame.
    void cut();

private:
    void read();
    void take(std::string message);

    kit::Socket socket_;
    mutable std::mutex mutex_;
    std::condition_variable news_;
    std::deque<std::string> messages_;
    std::set<std::string> pongs_;  // payloads
    bool ended_ = false;
    std::thread reader_;
};

}  // namespace rois::component_test
