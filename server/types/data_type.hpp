// The data types of values (decision 26), and checks of values against them.
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

// A parsed data_type_ref: `int`, `string[]`, `Set<Integer>`, `xsd:float`, `urn:x-rois:def:DataType:ATR::Integer`, ... The case is
// ignored. Known types are recognized by the part of the name after the last ':', '#' or '/'.
struct DataType {
    BaseType base = BaseType::other;
    bool list = false;
    std::string name;  // of the base, for messages and for user-defined types (base `other`)
    // The range of whole numbers, inclusive.
    std::int64_t lowest = std::numeric_limits<std::int32_t>::min();
    std::int64_t highest = std::numeric_limits<std::int32_t>::max();

    static DataType of(Identifier const& data_type_ref);

    // Compares names, ignoring case, only for the base `other`. Ignores the range of whole numbers.
    bool operator==(DataType const&) const;
};

// Returns whether the type, or the item type of a list, is defined here or in the specification. Any text is a value of an
// unknown type.
bool is_known(DataType const&);

std::string to_text(DataType const&);

// Returns why the values are not of this type (wrong count, not a number, ...), or nothing. The base `other` accepts any text.
std::optional<std::string> why_not(DataType const&, std::span<std::string const> values);

// Returns a value of this type, or an item of a list, in the form in which the engine reports it. Converts times to UTC (decision
// 28). Returns other values unchanged.
std::string reported_form(DataType const&, std::string_view text);

// Returns the values of a profile's default value, in the form in which the engine reports them: one value, or for lists of texts
// one per item (separated by white space).
std::vector<std::string> default_values(Identifier const& data_type_ref, std::string_view text);

}  // namespace rois
