// The types that values have (decision 26), and whether texts are of them.
#pragma once

#include <cstdint>
#include <limits>
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
    date,
    time,
    identifier,
    component_status,
    stream_status,
    other
};

// A data_type_ref read: `int`, `string[]`, `Set<Integer>`, `xsd:float`, `urn:x-rois:def:DataType:ATR::Integer`, ... in any case.
// A type that is known is so under the last part of any name with colons.
struct DataType {
    BaseType base = BaseType::other;
    bool list = false;
    std::string name;  // the base's own name, for messages and for user-defined types (base `other`)
    // Of whole numbers, both included.
    std::int64_t lowest = std::numeric_limits<std::int32_t>::min();
    std::int64_t highest = std::numeric_limits<std::int32_t>::max();

    static DataType of(Identifier const& data_type_ref);

    // Names count for `other` only, without regard to case; how far whole numbers go does not.
    bool operator==(DataType const&) const;
};

// Whether it is said here or in the specification which texts are of the type; else any text is. Of a list, whether its items'
// is.
bool is_known(DataType const&);

std::string to_text(DataType const&);

// Why these texts are not of the type (wrong count, not a number, ...), or nothing when they are. A type `other` takes any text.
std::optional<std::string> why_not(DataType const&, std::span<std::string const> values);

// A text of this type, or of its items, in the form in which it is told: times are UTC (decision 28), all else is as it is.
std::string as_told(DataType const&, std::string_view text);

// The values that a default of a profile stands for, as they are told: one text, but for lists of texts an item each, separated
// by white space.
std::vector<std::string> default_values(Identifier const& data_type_ref, std::string_view text);

}  // namespace rois
