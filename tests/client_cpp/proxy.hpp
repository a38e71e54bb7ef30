// A proxy between a client and a gateway that cuts, delays and changes the traffic.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <list>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "kit/socket.hpp"

namespace rois::test {

// Listens on a free port of the loopback. Thread-safe.
class Proxy {
public:
    explicit Proxy(std::uint16_t gateway);
    ~Proxy();
    Proxy(Proxy const&) = delete;
    Proxy& operator=(Proxy const&) = delete;

    std::uint16_t port() const { return listener_.port(); }
    std::string url() const { return "http://127.0.0.1:" + std::to_string(port()); }

    // Cuts all connections now.
    void cut();
    // Cuts all connections `times` times, each after a random number of bytes up to `longest`.
    void cut_at_random(std::uint32_t seed, std::size_t longest, std::size_t times);
    // Cuts all connections each time this number of bytes has passed; `times` times at most.
    void cut_every(std::size_t bytes, std::size_t times = std::numeric_limits<std::size_t>::max());
    // When the gateway sends this text next, drops it and cuts all connections.
    void cut_before(std::string text);
    // When the gateway sends this text next, replaces it by `as`, which must have the same length.
    void misquote(std::string text, std::string as);
    // Silently drops all bytes of the present connections, in both directions. New connections work.
    void half_open();
    // Whether to cut new connections at once.
    void refuse(bool);
    // Sets the port for new connections.
    void lead_to(std::uint16_t gateway);
    // Passes bytes on after this time; `drip` passes pieces of this size, each after this time.
    void delay(std::chrono::milliseconds);
    void drip(std::size_t bytes, std::chrono::milliseconds each);

    std::size_t connections() const { return accepted_; }  // number so far
    std::size_t cuts() const { return cuts_; }

private:
    using Clock = std::chrono::steady_clock;

    struct Direction {
        std::string waiting;
        Clock::time_point due;
    };
    struct Pair {
        int client = -1;
        int gateway = -1;
        bool swallows = false;
        Direction to_gateway;
        Direction to_client;
    };

    void run();
    void accept();
    bool pass(Pair&, int from, Direction&);
    void send_due(Pair&);
    int wait_time() const;
    void cut_all();
    bool tears(std::size_t bytes);
    std::size_t next_cut() { return evenly_ ? longest_ : dice_() % longest_ + 1; }
    void wake() const;

    kit::Listener listener_;
    int wake_ = -1;
    std::atomic<bool> ending_ = false;
    std::atomic<std::size_t> accepted_ = 0;
    std::atomic<std::size_t> cuts_ = 0;

    std::mutex mutex_;  // guards the members below
    std::list<Pair> pairs_;
    std::uint16_t gateway_;
    bool refuses_ = false;
    std::string before_;
    std::string misquoted_;
    std::string misquoted_as_;
    std::chrono::milliseconds delay_{0};
    std::size_t drip_ = 0;
    std::minstd_rand dice_;
    std::size_t longest_ = 0;
    bool evenly_ = false;    // cuts after `longest_` bytes each time
    std::size_t left_ = 0;   // bytes until the next cut
    std::size_t times_ = 0;  // cuts to come

    std::thread thread_;
};

}  // namespace rois::test
