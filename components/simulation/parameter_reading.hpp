// Reading parameters whose values were already checked to be of their types.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "types/values.hpp"

namespace rois::simulation {

// Nothing when the parameter is not there.
std::optional<std::int32_t> integer_of(ParameterList const&, std::string_view name);

// Without white space at the ends; empty when the parameter is not there.
std::string_view text_of(ParameterList const&, std::string_view name);

// False when the parameter is not there.
bool is_true(ParameterList const&, std::string_view name);

// The codebook of a parameter of type RoISIdentifier; empty when the parameter or its codebook is not there.
std::string_view codebook_of(ParameterList const&, std::string_view name);

// Of a list of numbers; empty when the parameter is not there.
std::vector<std::int32_t> integers_of(ParameterList const&, std::string_view name);

// Why this number is none of those allowed, or nothing; an absent one is fine.
std::optional<std::string> not_between(ParameterList const&, std::string_view name, std::int32_t least, std::int32_t most);
std::optional<std::string> negative(ParameterList const&, std::string_view name);

// Why one of these is no position to go to, or nothing; the plan has the places that may be named.
std::optional<std::string> not_targets(Parameter const&, FloorPlan const&,
                                       std::function<bool(std::string const&)> const& is_target);

}  // namespace rois::simulation
