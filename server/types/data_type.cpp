#include "types/data_type.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "types/codes.hpp"
#include "types/identifier_length.hpp"
#include "types/instant.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois {

namespace {

struct Known {
    std::string_view name;
    BaseType base;
    std::int64_t lowest = std::numeric_limits<std::int32_t>::min();
    std::int64_t highest = std::numeric_limits<std::int32_t>::max();
};

constexpr std::int64_t longest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t natural = std::numeric_limits<std::int32_t>::max();

// The first name of a base is its canonical name, used for all names with the same range.
constexpr std::array<Known, 44> known_types{{{"int", BaseType::integer},
                                             {"string", BaseType::string},
                                             {"double", BaseType::real},
                                             {"bool", BaseType::boolean},
                                             {"DateTime", BaseType::date_time},
                                             {"RoISIdentifier", BaseType::identifier},
                                             {"Component_Status", BaseType::component_status},
                                             {"Stream_Status", BaseType::stream_status},
                                             {"Date", BaseType::date},
                                             {"Time", BaseType::time},
                                             {"integer", BaseType::integer},
                                             {"real", BaseType::real},
                                             {"boolean", BaseType::boolean},
                                             {"RoIS_Identifier", BaseType::identifier},
                                             {"ComponentStatus", BaseType::component_status},
                                             {"StreamStatus", BaseType::stream_status},
                                             {"UnlimitedNatural", BaseType::integer, 0, natural},
                                             {"float", BaseType::real},
                                             {"decimal", BaseType::real},
                                             {"number", BaseType::real},
                                             {"long", BaseType::integer, -longest - 1, longest},
                                             {"short", BaseType::integer, -0x8000, 0x7FFF},
                                             {"byte", BaseType::integer, -0x80, 0x7F},
                                             {"unsignedLong", BaseType::integer, 0, longest},
                                             {"unsignedInt", BaseType::integer, 0, 0xFFFF'FFFF},
                                             {"unsignedShort", BaseType::integer, 0, 0xFFFF},
                                             {"unsignedByte", BaseType::integer, 0, 0xFF},
                                             {"nonNegativeInteger", BaseType::integer, 0, natural},
                                             {"positiveInteger", BaseType::integer, 1, natural},
                                             {"nonPositiveInteger", BaseType::integer, -natural - 1, 0},
                                             {"negativeInteger", BaseType::integer, -natural - 1, -1},
                                             {"CharacterString", BaseType::string},
                                             {"Data", BaseType::string},  // RLS (decision 27)
                                             {"normalizedString", BaseType::string},
                                             {"token", BaseType::string},
                                             {"anyURI", BaseType::string},
                                             {"URI", BaseType::string},
                                             {"language", BaseType::string},
                                             {"Name", BaseType::string},
                                             {"NCName", BaseType::string},
                                             {"NMTOKEN", BaseType::string},
                                             {"ID", BaseType::string},
                                             {"char", BaseType::string},
                                             {"QName", BaseType::string}}};

// Types whose texts have a form of their own (annex C).
constexpr std::array<std::string_view, 2> known_forms{"NBestType", "LatticeType"};

constexpr std::array<std::string_view, 4> names_of_lists{"Set", "List", "Sequence", "seq"};

// Returns the name in `urn:x-rois:def:DataType:<authority>::<name>`, and any other text unchanged.
std::string_view without_urn(std::string_view code) {
    constexpr std::string_view urn = "urn:x-rois:def:datatype:";
    if (code.size() <= urn.size() || !equal_ignoring_case(code.substr(0, urn.size()), urn)) return code;
    auto const colon = code.rfind(':');
    return code.substr(colon + 1);
}

// Returns "int" for "xsd:int", "urn:x-other:int" and "http://www.w3.org/2001/XMLSchema#int".
std::string_view last_part(std::string_view code) { return code.substr(code.find_last_of(":#/") + 1); }

// Returns `T` for `T[]`, `Set<T>`, `List<T>` and so on; nothing if the type is not a list.
std::optional<std::string_view> item_of(std::string_view code) {
    if (code.ends_with("[]")) return trimmed(code.substr(0, code.size() - 2));
    auto const open = code.find('<');
    if (open == code.npos || !code.ends_with('>')) return {};
    auto const name = trimmed(code.substr(0, open));
    auto const item = trimmed(code.substr(open + 1, code.size() - open - 2));
    bool const is_list = std::ranges::any_of(names_of_lists, [&](auto known) { return equal_ignoring_case(known, name); });
    if (!is_list || item.empty()) return {};
    return item;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "+09:00": at most 14 hours.
bool is_offset(std::string_view text) {
    if (text.size() != 6 || (text[0] != '+' && text[0] != '-') || text[3] != ':') return false;
    for (std::size_t const i : {1, 2, 4, 5})
        if (!is_digit(text[i])) return false;
    auto const hours = text.substr(1, 2), minutes = text.substr(4);
    return (hours < "14" && minutes < "60") || (hours == "14" && minutes == "00");
}

// Removes the shape from the beginning of the text, where a 'd' matches any digit. Returns false if the text does not match.
bool take_shape(std::string_view& text, std::string_view shape) {
    if (text.size() < shape.size()) return false;
    for (std::size_t i = 0; i < shape.size(); ++i)
        if (shape[i] == 'd' ? !is_digit(text[i]) : text[i] != shape[i]) return false;
    text.remove_prefix(shape.size());
    return true;
}

unsigned two_digits(std::string_view text, std::size_t at) {
    return static_cast<unsigned>((text[at] - '0') * 10 + (text[at + 1] - '0'));
}

// Takes "2026-11-20" if the day exists.
bool take_date(std::string_view& text) {
    auto const whole = text;
    if (!take_shape(text, "dddd-dd-dd")) return false;
    std::chrono::year_month_day const date{std::chrono::year{static_cast<int>(two_digits(whole, 0) * 100 + two_digits(whole, 2))},
                                           std::chrono::month{two_digits(whole, 5)}, std::chrono::day{two_digits(whole, 8)}};
    return date.ok();
}

// Takes "12:00:00.123", with any number of digits after the point.
bool take_time(std::string_view& text) {
    auto const whole = text;
    if (!take_shape(text, "dd:dd:dd")) return false;
    if (two_digits(whole, 0) > 23 || two_digits(whole, 3) > 59 || two_digits(whole, 6) > 59) return false;
    if (!text.starts_with('.')) return true;
    auto const end = std::ranges::find_if_not(text.substr(1), is_digit);
    auto const digits = static_cast<std::size_t>(end - text.begin()) - 1;
    text.remove_prefix(digits + 1);
    return digits > 0;
}

bool is_zone(std::string_view text) { return text == "Z" || is_offset(text); }

// "2026-11-20T12:00:00.123Z", with Z or an offset.
bool is_date_time(std::string_view text) {
    text = trimmed(text);
    auto rest = text;
    if (!take_date(rest) || !take_shape(rest, "T") || !take_time(rest) || !is_zone(rest)) return false;
    return rest == "Z" || in_utc(text).ends_with('Z');  // its year in UTC also has four digits
}

// The zone of dates and times is optional.
bool is_date(std::string_view text) {
    text = trimmed(text);
    return take_date(text) && (text.empty() || is_zone(text));
}
bool is_time(std::string_view text) {
    text = trimmed(text);
    return take_time(text) && (text.empty() || is_zone(text));
}

bool is_component_status(std::string_view text) { return to_code<ComponentStatus>(trimmed(text)).has_value(); }

bool is_stream_status(std::string_view text) { return to_code<StreamStatus>(trimmed(text)).has_value(); }

bool is_whole_number(DataType const& type, std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && text.size() > 1 && is_digit(text[1])) text.remove_prefix(1);
    auto const number = to_number<std::int64_t>(text);
    return number && type.lowest <= *number && *number <= type.highest;
}

bool is_of(DataType const& type, std::string_view text) {
    switch (type.base) {
        case BaseType::integer:
            return is_whole_number(type, text);
        case BaseType::real:
            return to_double(text).has_value();
        case BaseType::boolean:
            text = trimmed(text);
            return text == "true" || text == "false" || text == "1" || text == "0";
        case BaseType::date_time:
            return is_date_time(text);
        case BaseType::date:
            return is_date(text);
        case BaseType::time:
            return is_time(text);
        case BaseType::identifier:
            return !trimmed(text).empty();
        case BaseType::component_status:
            return is_component_status(text);
        case BaseType::stream_status:
            return is_stream_status(text);
        case BaseType::string:
        case BaseType::other:
            return true;
    }
    return true;
}

bool is_packed(BaseType base) { return base == BaseType::integer || base == BaseType::real || base == BaseType::boolean; }

std::string not_of(DataType const& type, std::string_view text) { return quoted(text) + " is not of the type " + type.name; }

// A list of numbers or bools is one value with items separated by white space; an empty list may have none.
std::optional<std::string> why_not_packed(DataType const& type, std::span<std::string const> values) {
    if (values.size() > 1)
        return "a list of the type " + to_text(type) + " is one value with items separated by spaces, got " +
               std::to_string(values.size()) + " values";
    if (values.empty()) return {};
    std::string_view rest = trimmed(values.front());
    while (!rest.empty()) {
        auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
        if (!is_of(type, item)) return not_of(type, item);
        rest = trimmed(rest.substr(item.size()));
    }
    return {};
}

}  // namespace

DataType DataType::of(Identifier const& data_type_ref) {
    std::string_view code = trimmed(data_type_ref.code);
    DataType type;
    if (auto const item = item_of(code)) {
        type.list = true;
        code = *item;
    }
    auto const last = last_part(code);
    auto const known = std::ranges::find_if(known_types, [&](Known const& k) { return equal_ignoring_case(k.name, last); });
    if (known == known_types.end()) {
        type.name = without_urn(code);
        return type;
    }
    type.base = known->base;
    type.lowest = known->lowest;
    type.highest = known->highest;
    auto const first = std::ranges::find(known_types, known->base, &Known::base);
    bool const same_range = known->lowest == first->lowest && known->highest == first->highest;
    type.name = same_range ? first->name : known->name;
    return type;
}

bool is_known(DataType const& type) {
    return type.base != BaseType::other ||
           std::ranges::any_of(known_forms, [&](auto form) { return equal_ignoring_case(form, last_part(type.name)); });
}

bool DataType::operator==(DataType const& other) const {
    if (base != other.base || list != other.list) return false;
    return base != BaseType::other || equal_ignoring_case(name, other.name);
}

std::string to_text(DataType const& type) { return type.list ? type.name + "[]" : type.name; }

std::optional<std::string> why_not(DataType const& type, std::span<std::string const> values) {
    if (type.list && is_packed(type.base)) return why_not_packed(type, values);
    if (!type.list && values.size() != 1)
        return "the type " + to_text(type) + " needs exactly one value, got " + std::to_string(values.size());
    for (auto const& value : values) {
        if (!is_of(type, value)) return not_of(type, value);
        auto too_long = type.base == BaseType::identifier ? why_too_long("the identifier", value) : std::nullopt;
        if (too_long) return too_long;
    }
    return {};
}

std::string reported_form(DataType const& type, std::string_view text) {
    return type.base == BaseType::date_time ? in_utc(text) : std::string{text};
}

std::vector<std::string> default_values(Identifier const& data_type_ref, std::string_view text) {
    auto const type = DataType::of(data_type_ref);
    if (!type.list || is_packed(type.base)) return {reported_form(type, text)};
    std::vector<std::string> values;
    for (std::string_view rest = trimmed(text); !rest.empty();) {
        auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
        values.push_back(reported_form(type, item));
        rest = trimmed(rest.substr(item.size()));
    }
    return values;
}

}  // namespace rois
