// The types that values have (decision 26), and whether texts are of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "types/values.hpp"

namespace rois {

enum class BaseType : std::uint8_t {
    integer,
    real,
    boolean,
    string,
    date_time,
    identifier,
    component_status,
    stream_status,
    other
};

// A data_type_ref read: `int`, `string[]`, `urn:x-rois:def:DataType:ATR::Integer`, ... in any case.
struct DataType {
    BaseType base = BaseType::other;
    bool list = false;
    std::string name;  // the base's own name, for messages and for user-defined types (base `other`)

    static DataType of(Identifier const& data_type_ref);

    bool operator==(DataType const&) const;  // names count for `other` only, without regard to case
};

std::string to_text(DataType const&);

// Why these texts are not of the type (wrong count, not a number, ...), or nothing when they are. A type `other` takes any text.
std::optional<std::string> why_not(DataType const&, std::span<std::string const> values);

// The values that a default of a profile stands for: one text, but for lists of texts an item each, separated by white space.
std::vector<std::string> default_values(Identifier const& data_type_ref, std::string_view text);

}  // namespace rois
