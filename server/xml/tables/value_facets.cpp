#include "xml/tables/tables_builder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <xercesc/framework/psvi/XSFacet.hpp>

#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

namespace {

using Definition = xercesc::XSSimpleTypeDefinition;

enum class Understood { yes, no };

// Returns whether numbers can be compared with this bound as doubles. A decimal bound with too many digits might round to an
// accepted number; an integer bound with more digits than the tables accept is beyond all of them.
bool is_comparable(ValueType const& type, std::string_view bound) {
    constexpr std::size_t most_digits = 15;
    auto const digits = static_cast<std::size_t>(std::ranges::count_if(bound, [](char c) { return c >= '0' && c <= '9'; }));
    return type.notation != ValueType::Notation::decimal || digits <= most_digits;
}

Understood apply_bound(ValueType& type, Definition::FACET facet, std::string_view text) {
    auto const number = to_double(text);
    if (type.kind != ValueType::Kind::number || !number || !is_comparable(type, text)) return Understood::no;
    bool const lower = facet == Definition::FACET_MININCLUSIVE || facet == Definition::FACET_MINEXCLUSIVE;
    bool const inclusive = facet == Definition::FACET_MININCLUSIVE || facet == Definition::FACET_MAXINCLUSIVE;
    auto& bound = lower ? type.lower : type.upper;
    bool const tighter = !bound || (lower ? *number > bound->value : *number < bound->value);
    if (tighter) bound = {*number, inclusive};
    if (bound->value == *number) bound->inclusive = bound->inclusive && inclusive;
    return Understood::yes;
}

Understood apply_length(ValueType& type, Definition::FACET facet, std::string_view text) {
    auto const length = to_number<std::size_t>(text);
    if (!length || (type.kind != ValueType::Kind::text && type.kind != ValueType::Kind::list)) return Understood::no;
    if (facet != Definition::FACET_MAXLENGTH) type.least = std::max(type.least, *length);
    if (facet != Definition::FACET_MINLENGTH) type.most = std::min(type.most, *length);
    return Understood::yes;
}

Understood apply(ValueType& type, Definition::FACET facet, std::string_view text) {
    switch (facet) {
        case Definition::FACET_WHITESPACE:
            type.collapse = text == "collapse";
            return Understood::yes;
        case Definition::FACET_LENGTH:
        case Definition::FACET_MINLENGTH:
        case Definition::FACET_MAXLENGTH:
            return apply_length(type, facet, text);
        case Definition::FACET_MININCLUSIVE:
        case Definition::FACET_MINEXCLUSIVE:
        case Definition::FACET_MAXINCLUSIVE:
        case Definition::FACET_MAXEXCLUSIVE:
            return apply_bound(type, facet, text);
        case Definition::FACET_FRACTIONDIGITS:
            return type.notation == ValueType::Notation::integer ? Understood::yes : Understood::no;
        default:
            return Understood::no;
    }
}

bool has_pattern(Definition& type) {
    auto const* const patterns = type.getLexicalPattern();
    return patterns != nullptr && patterns->size() > 0;
}

// Keeps the values that need no escaping and do not change when white space is normalised.
Understood apply_enumeration(ValueType& type, Definition& derived) {
    auto* const values = derived.getLexicalEnumeration();
    if (values == nullptr || values->size() == 0) return Understood::yes;
    if (type.kind != ValueType::Kind::text) return Understood::no;
    type.enumeration.clear();
    for (XMLSize_t i = 0; i < values->size(); ++i) {
        auto value = from_xerces(values->elementAt(i));
        if (value.find_first_of("\t\r\n&<>]") == value.npos) type.enumeration.push_back(std::move(value));
    }
    return type.enumeration.empty() ? Understood::no : Understood::yes;
}

ValueType of_kind(ValueType::Kind kind, bool collapse = true) {
    ValueType type;
    type.kind = kind;
    type.collapse = collapse;
    return type;
}

ValueType with_form(bool (*has_form)(std::string_view)) {
    auto type = of_kind(ValueType::Kind::form);
    type.has_form = has_form;
    return type;
}

ValueType number(ValueType::Notation notation) {
    auto type = of_kind(ValueType::Kind::number);
    type.notation = notation;
    return type;
}

}  // namespace

ValueType built_in(std::string_view name) {
    using Kind = ValueType::Kind;
    using Notation = ValueType::Notation;
    std::array<std::pair<std::string_view, ValueType>, 16> const known{{
        {"string", of_kind(Kind::text, false)},
        {"normalizedString", of_kind(Kind::text, false)},
        {"token", of_kind(Kind::text)},
        {"boolean", with_form(is_boolean)},
        {"double", number(Notation::floating)},
        {"decimal", number(Notation::decimal)},
        {"integer", number(Notation::integer)},
        {"dateTime", with_form(is_date_time)},
        {"date", with_form(is_date)},
        {"time", with_form(is_time)},
        {"gYearMonth", with_form(is_year_month)},
        {"gYear", with_form(is_year)},
        {"duration", with_form(is_duration)},
        {"NCName", with_form(is_name_without_colon)},
        {"ID", of_kind(Kind::id)},
        {"QName", of_kind(Kind::qualified_name)},
    }};
    auto const* const found = std::ranges::find(known, name, &std::pair<std::string_view, ValueType>::first);
    return found == known.end() ? ValueType{} : found->second;
}

ValueType with_facets(ValueType base, Definition& derived) {
    if (has_pattern(derived) || apply_enumeration(base, derived) == Understood::no) return {};
    auto* const facets = derived.getFacets();
    for (XMLSize_t i = 0; facets != nullptr && i < facets->size(); ++i) {
        auto& facet = *facets->elementAt(i);
        if (apply(base, facet.getFacetKind(), from_xerces(facet.getLexicalFacetValue())) == Understood::no) return {};
    }
    return base;
}

}  // namespace rois::xml
