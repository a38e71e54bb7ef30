// The identity of a person or robot near a body.
#pragma once

#include <cstdint>

namespace rois::basic {

// A person during one visit, or a robot. Only the body knows its meaning: a component compares ids and returns them to the body.
enum class EntityId : std::uint64_t {};

}  // namespace rois::basic
