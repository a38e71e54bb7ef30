// Orders for steered visitors, and their status.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "simulation/scenario/scenario.hpp"
#include "simulation/world/entity.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

// The status of an order. The hall updates it while the world steps; the caller reads it.
struct OrderStatus {
    enum class State : std::uint8_t {
        running,
        done,
        failed,  // see `reason`
        dropped  // by another order, or by stop_steering()
    } state = State::running;
    std::string reason;

    void fail(std::string text) {
        state = State::failed;
        reason = std::move(text);
    }
};
using SharedOrderStatus = std::shared_ptr<OrderStatus const>;

// Walks to these targets in order.
struct Way {
    std::vector<Target> stops;  // one or more
};
using Order = std::variant<Way, Say, Gesture, Leave>;

// The first PersonId of steered visitors. A separate range keeps the ids of the scenario's visitors unchanged.
inline constexpr std::uint32_t first_steered = 1U << 30U;
constexpr bool is_steered(PersonId id) { return static_cast<std::uint32_t>(id) >= first_steered; }

}  // namespace rois::simulation
