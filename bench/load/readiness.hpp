// Waits for many sockets at once.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <cstddef>
#include <span>

#include "load/measure.hpp"

namespace rois::bench {

class Readiness {
public:
    // `spins`: looks again and again instead of sleeping. Then whoever sends to this process need not wake it, which costs a
    // server more than many a request where cores are virtual. With more than one socket it looks once in 20 µs: looks without
    // a pause would contend with the server for the epoll's lock, and bare servers then cost a quarter more.
    explicit Readiness(bool spins);
    ~Readiness();
    Readiness(Readiness const&) = delete;
    Readiness& operator=(Readiness const&) = delete;

    // `name` is what `wait` tells of it.
    void watch(int descriptor, std::size_t name);

    // Those that have something to read, until the next call; none when nothing came before `until`.
    std::span<epoll_event const> wait(Nanoseconds until);

private:
    int descriptor_;
    bool spins_;
    std::size_t watched_ = 0;
    Nanoseconds next_look_ = 0;
    std::array<epoll_event, 512> ready_{};
};

}  // namespace rois::bench
