#include "load/readiness.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

namespace rois::bench {

namespace {

constexpr Nanoseconds between_looks = 20'000;

}  // namespace

Readiness::Readiness(bool spins) : descriptor_{epoll_create1(EPOLL_CLOEXEC)}, spins_{spins} {
    if (descriptor_ < 0) throw std::runtime_error("epoll_create1 failed");
}

Readiness::~Readiness() { ::close(descriptor_); }

void Readiness::watch(int descriptor, std::size_t name) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = name;
    if (epoll_ctl(descriptor_, EPOLL_CTL_ADD, descriptor, &event) != 0) throw std::runtime_error("epoll_ctl failed");
    ++watched_;
}

std::span<epoll_event const> Readiness::wait(Nanoseconds until) {
    if (spins_ && watched_ > 1) {
        while (now() < next_look_) {
        }
    }
    auto const rest = spins_ ? 0 : std::max<Nanoseconds>(0, until - now());
    timespec const time{rest / 1'000'000'000, rest % 1'000'000'000};
    auto const count = epoll_pwait2(descriptor_, ready_.data(), static_cast<int>(ready_.size()), &time, nullptr);
    if (count < 0 && errno != EINTR) throw std::runtime_error("epoll_wait failed");
    next_look_ = now() + between_looks;
    return {ready_.data(), static_cast<std::size_t>(std::max(count, 0))};
}

}  // namespace rois::bench
