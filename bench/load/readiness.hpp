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
    // `spins`: polls instead of sleeping, so that the server does not have to wake this process. On virtual cores, waking costs
    // more than most requests. With several sockets, polls every 20 µs: polling without a pause contends with the server for the
    // lock of the epoll, which raises the cost of bare servers by a quarter.
    explicit Readiness(bool spins);
    ~Readiness();
    Readiness(Readiness const&) = delete;
    Readiness& operator=(Readiness const&) = delete;

    // `wait` returns `name` for this descriptor.
    void watch(int descriptor, std::size_t name);

    // The descriptors that are readable; none if `until` passed first. Valid until the next call.
    std::span<epoll_event const> wait(Nanoseconds until);

private:
    int descriptor_;
    bool spins_;
    std::size_t watched_ = 0;
    Nanoseconds next_look_ = 0;
    std::array<epoll_event, 512> ready_{};
};

}  // namespace rois::bench
