// JSON with // comments, and the places of mistakes in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace rois {

// Returns the object that the text holds. Throws BadSettings with the file, the place and the reason if it is not JSON, holds
// something else, or gives a key twice.
nlohmann::json parse_json(std::string const& file, std::string const& text);

// The place of the first or last setting of the key behind the position `from`, as "LINE:COLUMN", both from 1; that of `from` if
// there is none. Ignores comments.
enum class Which : std::uint8_t { first, last };
std::string place_of_key(std::string const& text, std::string const& key, Which = Which::first, std::size_t from = 0);

}  // namespace rois
