#include "xml/tables/value_type.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "xml/tables/plain_name.hpp"

namespace rois::xml {

namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_white_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view trimmed_of_white_space(std::string_view text) {
    while (!text.empty() && is_white_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_white_space(text.back())) text.remove_suffix(1);
    return text;
}

// Removes the leading digits and returns their number.
std::size_t take_digits(std::string_view& text) {
    std::size_t count = 0;
    while (count < text.size() && is_digit(text[count])) ++count;
    text.remove_prefix(count);
    return count;
}

bool take(std::string_view& text, char wanted) {
    if (text.empty() || text.front() != wanted) return false;
    text.remove_prefix(1);
    return true;
}

// Takes a number of exactly `digits` digits. Returns -1 if there is none.
int take_number(std::string_view& text, std::size_t digits) {
    if (text.size() < digits) return -1;
    int number = 0;
    for (auto const c : text.substr(0, digits)) {
        if (!is_digit(c)) return -1;
        number = number * 10 + (c - '0');
    }
    text.remove_prefix(digits);
    return number;
}

bool within(int number, int least, int most) { return number >= least && number <= most; }

// Accepts numbers such as -1.5E-3. Limits the digits, so that all parsers read the same value: decimals of up to 15 digits keep
// their order as doubles.
bool is_number(std::string_view text, ValueType::Notation notation) {
    constexpr std::size_t most_digits_of_decimal = 15, most_digits_of_double = 40, most_digits_of_exponent = 2;
    take(text, '-');
    auto const whole = take_digits(text);
    bool const has_fraction = notation != ValueType::Notation::integer && take(text, '.');
    auto const fraction = has_fraction ? take_digits(text) : 0;
    if (whole == 0 || (has_fraction && fraction == 0)) return false;
    if (notation != ValueType::Notation::floating) return text.empty() && whole + fraction <= most_digits_of_decimal;
    if (take(text, 'e') || take(text, 'E')) {
        if (!take(text, '-')) take(text, '+');
        auto const exponent = take_digits(text);
        if (exponent == 0 || exponent > most_digits_of_exponent) return false;
    }
    return text.empty() && whole + fraction <= most_digits_of_double;
}

bool take_year(std::string_view& text) { return take_number(text, 4) >= 1; }

// Returns the number of the month, or 0 if it is invalid.
int take_month(std::string_view& text) {
    auto const month = take(text, '-') ? take_number(text, 2) : 0;
    return within(month, 1, 12) ? month : 0;
}

// Takes a date such as 2026-11-21. Rejects the 29th of February.
bool take_date(std::string_view& text) {
    constexpr std::array<int, 13> days{0, 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    if (!take_year(text)) return false;
    auto const month = take_month(text);
    return month > 0 && take(text, '-') && within(take_number(text, 2), 1, days[static_cast<std::size_t>(month)]);
}

bool take_time(std::string_view& text) {
    constexpr std::size_t most_digits = 9;
    if (!within(take_number(text, 2), 0, 23) || !take(text, ':')) return false;
    if (!within(take_number(text, 2), 0, 59) || !take(text, ':')) return false;
    if (!within(take_number(text, 2), 0, 59)) return false;
    return !take(text, '.') || within(static_cast<int>(take_digits(text)), 1, most_digits);
}

// Returns whether the rest of the text is a time zone: nothing, Z or +01:30.
bool ends_with_zone(std::string_view text) {
    if (text.empty() || text == "Z") return true;
    if (!take(text, '+') && !take(text, '-')) return false;
    return within(take_number(text, 2), 0, 13) && take(text, ':') && within(take_number(text, 2), 0, 59) && text.empty();
}

// Takes numbers with their units, in the order of `units`. Returns how many.
std::size_t take_parts_of_duration(std::string_view& text, std::string_view units) {
    constexpr std::size_t most_digits = 6;
    std::size_t parts = 0;
    for (auto const unit : units) {
        auto rest = text;
        auto const digits = take_digits(rest);
        if (digits == 0 || digits > most_digits || !take(rest, unit)) continue;
        text = rest;
        ++parts;
    }
    return parts;
}

}  // namespace

bool is_boolean(std::string_view text) { return text == "true" || text == "false" || text == "1" || text == "0"; }
bool is_date_time(std::string_view text) { return take_date(text) && take(text, 'T') && take_time(text) && ends_with_zone(text); }
bool is_date(std::string_view text) { return take_date(text) && ends_with_zone(text); }
bool is_time(std::string_view text) { return take_time(text) && ends_with_zone(text); }
bool is_year_month(std::string_view text) { return take_year(text) && take_month(text) > 0 && ends_with_zone(text); }
bool is_year(std::string_view text) { return take_year(text) && ends_with_zone(text); }

bool is_duration(std::string_view text) {
    if (!take(text, 'P')) return false;
    auto const days = take_parts_of_duration(text, "YMD");
    auto const hours = take(text, 'T') ? take_parts_of_duration(text, "HMS") : days;
    return hours > 0 && text.empty();
}

bool is_name_without_colon(std::string_view text) {
    auto const name = plain_name(text);
    return !name.none() && name.prefix().empty();
}

bool ValueType::accepts(std::string_view text) const {
    switch (kind) {
        case Kind::unknown:
            return false;
        case Kind::text:
            return accepts_text(text);
        case Kind::form:
            return has_form(trimmed_of_white_space(text));
        case Kind::number:
            return accepts_number(trimmed_of_white_space(text));
        case Kind::id:
            return is_name_without_colon(text);
        case Kind::qualified_name:
            return !plain_name(text).none();
        case Kind::list:
            return accepts_list(text);
        case Kind::alternatives:
            return accepts_alternative(text);
    }
    return false;
}

bool ValueType::accepts_text(std::string_view text) const {
    if (takes_any_text()) return true;
    // Each printable ASCII character is one byte, and normalising white space does not change it.
    auto const plain = [](char c) { return c > ' ' && c < 0x7F && c != '&' && c != ']'; };
    if (has_length() && (text.size() < least || text.size() > most || !std::ranges::all_of(text, plain))) return false;
    if (enumeration.empty()) return true;
    auto const value = collapse ? trimmed_of_white_space(text) : text;
    return std::ranges::find(enumeration, value) != enumeration.end();
}

bool ValueType::accepts_number(std::string_view text) const {
    if (!is_number(text, notation)) return false;
    if (!lower && !upper) return true;
    double value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{}) return false;
    if (value == 0 && text.front() == '-') return false;
    if (lower && (lower->inclusive ? value < lower->value : value <= lower->value)) return false;
    return !upper || (upper->inclusive ? value <= upper->value : value < upper->value);
}

bool ValueType::accepts_list(std::string_view text) const {
    std::size_t items = 0;
    for (;;) {
        while (!text.empty() && is_white_space(text.front())) text.remove_prefix(1);
        if (text.empty()) return items >= least && items <= most;
        auto const length = static_cast<std::size_t>(std::ranges::find_if(text, is_white_space) - text.begin());
        if (!members.front()->accepts(text.substr(0, length))) return false;
        ++items;
        text.remove_prefix(length);
    }
}

// Members of a union normalise white space differently. Texts with white space are rejected here, so that xerces-c decides.
bool ValueType::accepts_alternative(std::string_view text) const {
    if (std::ranges::any_of(text, is_white_space)) return false;
    return std::ranges::any_of(members,
                               [&](ValueType const* member) { return !member->takes_any_text() && member->accepts(text); });
}

}  // namespace rois::xml
