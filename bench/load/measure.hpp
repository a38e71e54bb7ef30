// Clocks, the CPU time of a process, and latency statistics.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rois::bench {

using Nanoseconds = std::int64_t;

// CLOCK_MONOTONIC, which is the same in all processes.
Nanoseconds now();

// The user and system CPU time of all threads of a process; 0: this process. Throws std::runtime_error for an unknown process.
Nanoseconds cpu_of(int pid);

class Latencies {
public:
    void add(Nanoseconds latency) { all_.push_back(latency); }
    void clear() { all_.clear(); }
    std::size_t size() const { return all_.size(); }

    // "p50_us":12.3,"p99_us":...,"p999_us":...,"max_us":...
    std::string json();

private:
    double at(double share) const;

    std::vector<Nanoseconds> all_;
};

// "name":1.234
std::string member(std::string const& name, double value);

}  // namespace rois::bench
