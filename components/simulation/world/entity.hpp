// Ids of people and robots in the hall.
#pragma once

#include <compare>
#include <cstdint>
#include <variant>

namespace rois::simulation {

// One visit of one person: a serial number. A visitor who comes again gets a new number.
enum class PersonId : std::uint32_t {};

// The index of a robot in the floor plan.
enum class RobotId : std::uint32_t {};

using Entity = std::variant<PersonId, RobotId>;

}  // namespace rois::simulation
