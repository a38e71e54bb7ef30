// Clocks, the server's CPU time, and what is made of latencies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rois::bench {

using Nanoseconds = std::int64_t;

// CLOCK_MONOTONIC, which is the same in all processes.
Nanoseconds now();

// CPU time of a process, all its threads, user and system; 0: this one. Throws when there is no such process.
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
