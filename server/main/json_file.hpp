// JSON with // comments, and the places of mistakes in it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// Returns the object that the text holds. Throws BadSettings with the file, the place and the reason if it is not JSON, holds
// something else, or gives a key twice.
nlohmann::json parse_json(std::string const& file, std::string const& text);

// The places in the text are offsets in bytes.
struct ObjectInText {
    struct Key {
        std::string name;
        std::size_t at = 0;
    };
    std::size_t begin = 0;  // of its '{'
    std::size_t depth = 1;  // 1: the outermost object
    std::vector<Key> keys;  // in the order of the text, repeated ones too

    // The second setting of a key that is set twice, or null.
    Key const* repeated() const;
};

// Returns all objects of a text that `parse_json` accepts, in the order in which they begin.
std::vector<ObjectInText> objects_in(std::string_view text);

// Returns "LINE:COLUMN", both from 1. Columns count characters.
std::string place_of(std::string_view text, std::size_t position);

// Returns the place of the first setting of the key in this object, or of the object if it does not set the key.
std::string place_of_key(std::string_view text, ObjectInText const&, std::string_view key);
// The same for the outermost object.
std::string place_of_key(std::string_view text, std::string_view key);

}  // namespace rois
