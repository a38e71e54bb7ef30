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
    // server more than many a request where cores are virtual.
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
    std::array<epoll_event, 512> ready_{};
};

}  // namespace rois::bench
