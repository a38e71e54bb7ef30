// Reads parameters whose values have been validated against their data types.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basic/body/body.hpp"
#include "types/values.hpp"

namespace rois::basic {

// Returns nothing if the parameter is missing.
std::optional<std::int32_t> integer_of(ParameterList const&, std::string_view name);

// Returns the trimmed text; empty if the parameter is missing.
std::string_view text_of(ParameterList const&, std::string_view name);

// Returns false if the parameter is missing.
bool is_true(ParameterList const&, std::string_view name);

// Returns the codebook of a parameter of type RoISIdentifier; empty if the parameter or its codebook is missing.
std::string_view codebook_of(ParameterList const&, std::string_view name);

// Returns a list of numbers; empty if the parameter is missing.
std::vector<std::int32_t> integers_of(ParameterList const&, std::string_view name);

// Return an error if the number is out of range, else nothing. A missing parameter is valid.
std::optional<std::string> not_between(ParameterList const&, std::string_view name, std::int32_t least, std::int32_t most);
std::optional<std::string> negative(ParameterList const&, std::string_view name);

// Returns an error if one of the values is not a valid target, else nothing. The error lists the places.
std::optional<std::string> not_targets(Parameter const&, std::vector<NamedPlace> const&,
                                       std::function<bool(std::string const&)> const& is_target);

}  // namespace rois::basic
