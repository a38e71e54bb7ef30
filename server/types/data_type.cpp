#include "types/data_type.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "types/texts.hpp"

namespace rois {

namespace {

struct Known {
    std::string_view name;
    BaseType base;
};

// The first name of a base is the one that we write.
constexpr std::array<Known, 15> known_types{{{"int", BaseType::integer},
                                             {"integer", BaseType::integer},
                                             {"UnlimitedNatural", BaseType::integer},
                                             {"double", BaseType::real},
                                             {"real", BaseType::real},
                                             {"bool", BaseType::boolean},
                                             {"boolean", BaseType::boolean},
                                             {"string", BaseType::string},
                                             {"DateTime", BaseType::date_time},
                                             {"RoISIdentifier", BaseType::identifier},
                                             {"RoIS_Identifier", BaseType::identifier},
                                             {"Component_Status", BaseType::component_status},
                                             {"ComponentStatus", BaseType::component_status},
                                             {"Stream_Status", BaseType::stream_status},
                                             {"StreamStatus", BaseType::stream_status}}};

// `urn:x-rois:def:DataType:<authority>::<name>` gives the name; what is no such URN stays as it is.
std::string_view without_urn(std::string_view code) {
    constexpr std::string_view urn = "urn:x-rois:def:datatype:";
    if (code.size() <= urn.size() || !equal_ignoring_case(code.substr(0, urn.size()), urn)) return code;
    auto const colon = code.rfind(':');
    return code.substr(colon + 1);
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

// "2026-11-20T12:00:00.123Z": the date, the time, any number of digits after the point, and Z or an offset.
bool is_date_time(std::string_view text) {
    constexpr std::string_view shape = "dddd-dd-ddTdd:dd:dd";
    text = trimmed(text);
    if (text.size() < shape.size()) return false;
    for (std::size_t i = 0; i < shape.size(); ++i)
        if (shape[i] == 'd' ? !is_digit(text[i]) : text[i] != shape[i]) return false;
    auto const number = [&](std::size_t at) { return static_cast<unsigned>((text[at] - '0') * 10 + (text[at + 1] - '0')); };
    std::chrono::year_month_day const date{std::chrono::year{static_cast<int>(number(0) * 100 + number(2))},
                                           std::chrono::month{number(5)}, std::chrono::day{number(8)}};
    if (!date.ok() || number(11) > 23 || number(14) > 59 || number(17) > 59) return false;
    text.remove_prefix(shape.size());
    if (text.starts_with('.')) {
        auto const end = std::ranges::find_if_not(text.substr(1), is_digit);
        auto const digits = static_cast<std::size_t>(end - text.begin()) - 1;
        if (digits == 0) return false;
        text.remove_prefix(digits + 1);
    }
    return text == "Z" || is_offset(text);
}

bool is_component_status(std::string_view text) {
    text = trimmed(text);
    for (auto status : {ComponentStatus::uninitialized, ComponentStatus::ready, ComponentStatus::busy, ComponentStatus::warning,
                        ComponentStatus::error})
        if (text == to_text(status)) return true;
    return false;
}

bool is_stream_status(std::string_view text) {
    text = trimmed(text);
    for (auto status : {StreamStatus::not_running, StreamStatus::not_connected, StreamStatus::running, StreamStatus::suspended,
                        StreamStatus::resumed})
        if (text == to_text(status)) return true;
    return false;
}

bool is_of(BaseType base, std::string_view text) {
    switch (base) {
        case BaseType::integer:
            return to_int(text).has_value();
        case BaseType::real:
            return to_double(text).has_value();
        case BaseType::boolean:
            text = trimmed(text);
            return text == "true" || text == "false" || text == "1" || text == "0";
        case BaseType::date_time:
            return is_date_time(text);
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

std::string not_of(DataType const& type, std::string_view text) {
    return quoted(text) + " is not of the type " + to_text(DataType{type.base, false, type.name});
}

// A list of numbers or bools: one text, its items separated by white space; none for an empty list.
std::optional<std::string> why_not_packed(DataType const& type, std::span<std::string const> values) {
    if (values.size() > 1) return "a list of the type " + to_text(type) + " has one value, its items separated by spaces";
    if (values.empty()) return {};
    std::string_view rest = trimmed(values.front());
    while (!rest.empty()) {
        auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
        if (!is_of(type.base, item)) return not_of(type, item);
        rest = trimmed(rest.substr(item.size()));
    }
    return {};
}

}  // namespace

DataType DataType::of(Identifier const& data_type_ref) {
    std::string_view code = trimmed(data_type_ref.code);
    DataType type;
    if (code.ends_with("[]")) {
        type.list = true;
        code.remove_suffix(2);
    }
    code = without_urn(code);
    auto const known = std::ranges::find_if(known_types, [&](Known const& k) { return equal_ignoring_case(k.name, code); });
    if (known == known_types.end()) {
        type.name = code;
        return type;
    }
    type.base = known->base;
    type.name = std::ranges::find(known_types, known->base, &Known::base)->name;
    return type;
}

bool DataType::operator==(DataType const& other) const {
    if (base != other.base || list != other.list) return false;
    return base != BaseType::other || equal_ignoring_case(name, other.name);
}

std::string to_text(DataType const& type) { return type.list ? type.name + "[]" : type.name; }

std::optional<std::string> why_not(DataType const& type, std::span<std::string const> values) {
    if (type.list && is_packed(type.base)) return why_not_packed(type, values);
    if (!type.list && values.size() != 1)
        return "a single value of the type " + to_text(type) + " needs exactly one value, here are " +
               std::to_string(values.size());
    for (auto const& value : values)
        if (!is_of(type.base, value)) return not_of(type, value);
    return {};
}

std::vector<std::string> default_values(Identifier const& data_type_ref, std::string_view text) {
    auto const type = DataType::of(data_type_ref);
    if (!type.list || is_packed(type.base)) return {std::string{text}};
    std::vector<std::string> values;
    for (std::string_view rest = trimmed(text); !rest.empty();) {
        auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
        values.emplace_back(item);
        rest = trimmed(rest.substr(item.size()));
    }
    return values;
}

}  // namespace rois
