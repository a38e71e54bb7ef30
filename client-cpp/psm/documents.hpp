// Request documents with the application's own XML as condition or command sequence.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rois::psm {

// An element of a request, before the condition: its name and its text.
using Child = std::pair<std::string_view, std::string>;

// Returns a request with this condition, or without one if the text is empty or blank. Does not escape the element names.
std::string request_with_condition(std::string_view operation, std::vector<Child> const&, std::string_view condition);
// Returns an `execute` request with this sequence.
std::string request_with_sequence(std::string_view sequence);

// Returns why a text cannot be part of a request, or nothing if it consists of well-formed elements only. The engine checks the
// rest.
std::optional<std::string> problem_with(std::string_view xml);

// Returns the engine profile of a get_profile_response as a document of its own; empty if there is none.
std::string engine_profile_in(std::string const& response);

}  // namespace rois::psm
