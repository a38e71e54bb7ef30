#include "load/measure.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace rois::bench {

namespace {

Nanoseconds read(clockid_t clock) {
    timespec time{};
    if (clock_gettime(clock, &time) != 0) throw std::runtime_error("clock_gettime failed");
    return time.tv_sec * Nanoseconds{1'000'000'000} + time.tv_nsec;
}

}  // namespace

Nanoseconds now() { return read(CLOCK_MONOTONIC); }

Nanoseconds cpu_of(int pid) {
    clockid_t clock{};
    if (clock_getcpuclockid(pid, &clock) != 0) throw std::runtime_error("unknown process " + std::to_string(pid));
    return read(clock);
}

double Latencies::at(double share) const {
    if (all_.empty()) return 0;
    auto const last = static_cast<double>(all_.size() - 1);
    return static_cast<double>(all_[static_cast<std::size_t>(std::ceil(share * last))]) / 1'000;
}

std::string Latencies::json() {
    std::ranges::sort(all_);
    return member("p50_us", at(0.5)) + "," + member("p99_us", at(0.99)) + "," + member("p999_us", at(0.999)) + "," +
           member("max_us", at(1));
}

std::string member(std::string const& name, double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f", value);
    return "\"" + name + "\":" + text;
}

}  // namespace rois::bench
