// What people in the hall can be told to do from outside, and what becomes of it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "simulation/entity.hpp"
#include "simulation/scenario.hpp"
#include "simulation/wire_units.hpp"

namespace rois::simulation {

// What somebody was told to do: looked at by whoever told, while the world steps.
struct Deed {
    enum class State : std::uint8_t {
        goes_on,
        done,
        failed,  // `why` says it
        dropped  // something else was told instead
    } state = State::goes_on;
    std::string why;

    void fail(std::string reason) {
        state = State::failed;
        why = std::move(reason);
    }
};
using SharedDeed = std::shared_ptr<Deed const>;

// To one target after the other.
struct Way {
    std::vector<Target> stops;  // one or more
};
using Order = std::variant<Way, Say, Gesture, Leave>;

// The numbers of those who are steered begin here, so that those of the others are the same with and without them.
inline constexpr std::uint32_t first_steered = 1U << 30U;
constexpr bool is_steered(PersonId id) { return static_cast<std::uint32_t>(id) >= first_steered; }

}  // namespace rois::simulation
