// A simple type of the schemas as the tables have it: it accepts some of the type's values, and never what is none.
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
        unknown,  // a type, a facet or a combination of them that the tables do not know: accepts nothing
        text,
        form,  // told by how it is written: booleans, times, names
        number,
        id,              // xsd:ID: a name; that no other one is the same is for the caller to see
        qualified_name,  // xsd:QName: its form; that the prefix is declared is for the caller to see
        list,
        alternatives,  // xsd:union
    };
    enum class Notation : std::uint8_t { integer, decimal, floating };  // how a number may be written

    struct Bound {
        double value = 0;
        bool inclusive = true;
    };

    Kind kind = Kind::unknown;
    bool (*has_form)(std::string_view) = nullptr;  // of Kind::form; without white space around
    bool collapse = false;                         // white space around a text does not count
    std::vector<std::string> enumeration;          // of texts; empty: any
    std::size_t least = 0;                         // characters of a text, items of a list
    std::size_t most = std::numeric_limits<std::size_t>::max();
    Notation notation = Notation::floating;
    std::optional<Bound> lower, upper;
    std::vector<ValueType const*> members;  // of alternatives; of a list the type of its items

    // Whether every text is a value, with references and all.
    bool takes_any_text() const { return kind == Kind::text && enumeration.empty() && !has_length(); }

    // Whether the text, as it stands in the document, is a value for sure. What it accepts of a type that does not take any text
    // holds no reference, no markup and no "]]>".
    bool accepts(std::string_view text) const;

private:
    bool has_length() const { return least > 0 || most != std::numeric_limits<std::size_t>::max(); }
    bool accepts_text(std::string_view) const;
    bool accepts_number(std::string_view) const;
    bool accepts_list(std::string_view) const;
    bool accepts_alternative(std::string_view) const;
};

// Forms of XML Schema's types; each knows the usual values of its type only.
bool is_boolean(std::string_view);
bool is_date_time(std::string_view);
bool is_date(std::string_view);
bool is_time(std::string_view);
bool is_year_month(std::string_view);
bool is_year(std::string_view);
bool is_duration(std::string_view);
bool is_name_without_colon(std::string_view);

}  // namespace rois::xml
