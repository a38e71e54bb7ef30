// Ids of people and robots in the hall.
#pragma once

#include <cstdint>
#include <variant>

#include "basic/body/entity.hpp"

namespace rois::simulation {

// One visit of one person: a serial number. A visitor who comes again gets a new number.
enum class PersonId : std::uint32_t {};

// The index of a robot in the floor plan.
enum class RobotId : std::uint32_t {};

using Entity = std::variant<PersonId, RobotId>;

// Convert to the ids of components/basic, and back. The ids of robots have the highest bit.
inline constexpr std::uint64_t robot_bit = std::uint64_t{1} << 63U;

constexpr basic::EntityId entity_id(Entity const& entity) {
    if (auto const* robot = std::get_if<RobotId>(&entity)) return basic::EntityId{robot_bit | static_cast<std::uint32_t>(*robot)};
    return basic::EntityId{static_cast<std::uint32_t>(std::get<PersonId>(entity))};
}

constexpr Entity entity(basic::EntityId id) {
    auto const number = static_cast<std::uint64_t>(id);
    auto const serial = static_cast<std::uint32_t>(number);
    return (number & robot_bit) != 0 ? Entity{RobotId{serial}} : Entity{PersonId{serial}};
}

}  // namespace rois::simulation
