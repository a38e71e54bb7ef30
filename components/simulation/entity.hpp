// Names of those who move in the hall.
#pragma once

#include <compare>
#include <cstdint>
#include <variant>

namespace rois::simulation {

// One visit of one person: the serial number of their coming in. A known visitor who comes again gets a new one.
enum class PersonId : std::uint32_t {};

// A robot by its position in the floor plan.
enum class RobotId : std::uint32_t {};

using Entity = std::variant<PersonId, RobotId>;

}  // namespace rois::simulation
