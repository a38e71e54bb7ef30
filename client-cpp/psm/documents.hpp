// The documents of operations whose conditions and sequences are the application's own XML texts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rois::psm {

// One element of a request with a text inside, before the condition.
using Child = std::pair<std::string_view, std::string>;

// A request whose condition is this text, or without one if it is empty or blank. The element names are literals.
std::string request_with_condition(std::string_view operation, std::vector<Child> const&, std::string_view condition);
// `execute` of this sequence.
std::string request_with_sequence(std::string_view sequence);

// Why a text cannot stand inside a request; nothing if it can: if it is well-formed elements and nothing else. The engine
// judges all the rest.
std::optional<std::string> problem_with(std::string_view xml);

// The engine profile of a get_profile_response as a document of its own; empty if there is none.
std::string engine_profile_in(std::string const& response);

}  // namespace rois::psm
