// A simple type of the schemas, in the tables. Conservative: may reject a valid value (xerces-c then decides), but never accepts
// an invalid one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rois::xml {

struct ValueType {
    enum class Kind : std::uint8_t {
        unknown,  // an unsupported type, facet or combination: accepts nothing
        text,
        form,  // checked by `has_form`: booleans, times, names
        number,
        id,              // xsd:ID: a name; the caller checks that it is unique
        qualified_name,  // xsd:QName: only its form; the caller checks that the prefix is declared
        list,
        alternatives,  // xsd:union
    };
    enum class Notation : std::uint8_t { integer, decimal, floating };

    struct Bound {
        double value = 0;
        bool inclusive = true;
    };

    Kind kind = Kind::unknown;
    bool (*has_form)(std::string_view) = nullptr;  // of Kind::form; takes the trimmed text
    bool collapse = false;                         // ignore white space around a text
    std::vector<std::string> enumeration;          // of Kind::text; empty: any text
    std::size_t least = 0;                         // characters of a text, items of a list
    std::size_t most = std::numeric_limits<std::size_t>::max();
    Notation notation = Notation::floating;
    std::optional<Bound> lower, upper;
    std::vector<ValueType const*> members;  // of alternatives; of a list: the type of its items

    // Returns whether every text is a value, including texts with references.
    bool takes_any_text() const { return kind == Kind::text && enumeration.empty() && !has_length(); }

    // Returns whether the raw text of the document is a value of this type; false if xerces-c must decide. Unless
    // takes_any_text(), an accepted text contains no reference, no markup and no "]]>".
    bool accepts(std::string_view text) const;

private:
    bool has_length() const { return least > 0 || most != std::numeric_limits<std::size_t>::max(); }
    bool accepts_text(std::string_view) const;
    bool accepts_number(std::string_view) const;
    bool accepts_list(std::string_view) const;
    bool accepts_alternative(std::string_view) const;
};

// Check the form of XML Schema's types. Each accepts only the usual values of its type.
bool is_boolean(std::string_view);
bool is_date_time(std::string_view);
bool is_date(std::string_view);
bool is_time(std::string_view);
bool is_year_month(std::string_view);
bool is_year(std::string_view);
bool is_duration(std::string_view);
bool is_name_without_colon(std::string_view);

}  // namespace rois::xml
