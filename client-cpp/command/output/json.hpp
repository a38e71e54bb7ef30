// Messages as JSON objects, for --json. Names are those of the documents; values are numbers, booleans, strings and arrays by
// their data type.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "rois/connection.hpp"
#include "types/messages.hpp"

namespace rois::command {

using Json = nlohmann::ordered_json;

Json to_json(Reply const&, std::string_view operation);
Json to_json(Fault const&);
Json to_json(Notification const&, std::uint64_t sequence);
Json to_json(ComponentProfile const&);
Json to_json(StateChange const&);
Json to_json(Gap const&);

// Returns the object as one line. Replaces bytes that are not UTF-8.
std::string line_of(Json const&);

}  // namespace rois::command
