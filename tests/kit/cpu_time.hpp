// How much CPU time a piece of work takes.
#pragma once

#include <chrono>
#include <ctime>
#include <functional>

namespace rois::kit {

// Sanitizers make everything about ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool has_sanitizer = true;
#else
inline constexpr bool has_sanitizer = false;
#endif

// Returns the CPU time that the calling thread needs for the work. Other processes on the machine do not change it.
inline std::chrono::nanoseconds cpu_time_of(std::function<void()> const& work) {
    auto const used = [] {
        timespec time{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
    };
    auto const begun = used();
    work();
    return used() - begun;
}

}  // namespace rois::kit
