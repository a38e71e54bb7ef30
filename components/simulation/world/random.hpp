// Random numbers that are the same on every machine. Own distributions, since those of standard libraries differ.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>

namespace rois::simulation {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double uniform();                         // [0, 1)
    double uniform(double low, double high);  // [low, high)
    std::size_t below(std::size_t count);     // 0 .. count-1; count > 0
    double gaussian();                        // mean 0, standard deviation 1
    bool chance(double probability);

private:
    std::mt19937_64 engine_;
};

// Returns a hash of the parts, as a seed for noise that does not depend on the number and order of calls.
std::uint64_t mixed(std::initializer_list<std::uint64_t> parts);

}  // namespace rois::simulation
