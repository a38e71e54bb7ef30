#include "simulation/world/random.hpp"

#include <cmath>
#include <numbers>

namespace rois::simulation {

double Random::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::size_t Random::below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

// Box-Muller transform. Discards the second number, so that engine_ is the only state.
double Random::gaussian() {
    double const length = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return length * std::cos(2.0 * std::numbers::pi * uniform());
}

bool Random::chance(double probability) { return uniform() < probability; }

// Chains the finalizer of splitmix64.
std::uint64_t mixed(std::initializer_list<std::uint64_t> parts) {
    std::uint64_t state = 0x9e3779b97f4a7c15u;
    for (std::uint64_t part : parts) {
        state += part + 0x9e3779b97f4a7c15u;
        state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
        state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
        state ^= state >> 31;
    }
    return state;
}

}  // namespace rois::simulation
