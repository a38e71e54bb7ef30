// Messages as JSON objects, for `--json`: the names are those of the documents; values are numbers, truths, texts and lists by
// their types.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
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

// One line. What is not UTF-8 is replaced.
std::string line_of(Json const&);

}  // namespace rois::command
