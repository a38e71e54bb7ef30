#include "xml/validation/simple_type.hpp"

#include <array>
#include <utility>
#include <xercesc/util/KVStringPair.hpp>
#include <xercesc/util/PlatformUtils.hpp>
#include <xercesc/util/XMLString.hpp>
#include <xercesc/validators/datatype/DatatypeValidator.hpp>
#include <xercesc/validators/datatype/ListDatatypeValidator.hpp>
#include <xercesc/validators/datatype/UnionDatatypeValidator.hpp>
#include <xercesc/validators/schema/SchemaSymbols.hpp>

#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

using xercesc::DatatypeValidator;

namespace {

using Words = std::pair<std::string_view, std::string_view>;

constexpr std::array words_of_built_in{
    Words{"boolean", "true or false"},
    Words{"double", "a number"},
    Words{"float", "a number"},
    Words{"decimal", "a number"},
    Words{"integer", "a whole number"},
    Words{"int", "a whole number of 32 bits"},
    Words{"long", "a whole number of 64 bits"},
    Words{"unsignedLong", "a whole number, 0 or more, of 64 bits"},
    Words{"unsignedInt", "a whole number, 0 or more, of 32 bits"},
    Words{"nonNegativeInteger", "a whole number, 0 or more"},
    Words{"positiveInteger", "a whole number, 1 or more"},
    Words{"dateTime", "a time such as 2026-11-20T12:00:00Z"},
    Words{"ID", "a name without colons and spaces, used once in the document"},
    Words{"NCName", "a name without colons and spaces"},
    Words{"QName", "a name without a prefix, or with a declared one"},
    Words{"string", "a text"},
};

struct FacetWords {
    XMLCh const* facet;
    std::string_view before;  // the value
    std::string_view after;
};

constexpr std::array words_of_facets{
    FacetWords{u"minInclusive", "at least ", ""},
    FacetWords{u"minExclusive", "more than ", ""},
    FacetWords{u"maxInclusive", "at most ", ""},
    FacetWords{u"maxExclusive", "less than ", ""},
    FacetWords{u"length", "of ", " characters"},
    FacetWords{u"minLength", "of at least ", " characters"},
    FacetWords{u"maxLength", "of at most ", " characters"},
    FacetWords{u"pattern", "of the form ", ""},
};

bool is_built_in(DatatypeValidator const& type) {
    return xercesc::XMLString::equals(type.getTypeUri(), xercesc::SchemaSymbols::fgURI_SCHEMAFORSCHEMA);
}

std::string enumeration_of(DatatypeValidator const& type) {
    auto const* const values = type.getEnumString();
    if (values == nullptr || values->size() == 0) return {};
    if (values->size() == 1 && values->elementAt(0)[0] == 0) return "nothing";
    std::string text = values->size() == 1 ? "" : "one of ";
    for (XMLSize_t i = 0; i < values->size(); ++i) {
        if (i > 0) text += ", ";
        text += from_xerces(values->elementAt(i));
    }
    return text;
}

std::string facets_of(DatatypeValidator const& type) {
    std::string text;
    auto* const facets = type.getFacets();
    if (facets == nullptr) return text;
    for (auto const& [name, before, after] : words_of_facets) {
        auto const* const facet = facets->get(name);
        if (facet == nullptr) continue;
        auto const unit = type.getType() == DatatypeValidator::List && !after.empty() ? " items" : after;
        text.append(", ").append(before).append(from_xerces(facet->getValue())).append(unit);
    }
    return text;
}

std::string built_in_kind(DatatypeValidator const& type) {
    auto const name = from_xerces(type.getTypeLocalName());
    for (auto const& [built_in, words] : words_of_built_in) {
        if (built_in == name) return std::string{words};
    }
    return "a value of xsd:" + name;
}

std::string kind_of(DatatypeValidator& type) {
    if (is_built_in(type)) return built_in_kind(type);
    if (type.getType() == DatatypeValidator::List) {
        auto* const item = static_cast<xercesc::ListDatatypeValidator&>(type).getItemTypeDTV();
        return "a list separated by spaces, each item " + description_of(*item);
    }
    if (type.getType() == DatatypeValidator::Union) {
        auto* const members = static_cast<xercesc::UnionDatatypeValidator&>(type).getMemberTypeValidators();
        std::string text;
        for (XMLSize_t i = 0; i < members->size(); ++i)
            text.append(i == 0 ? "" : ", or ").append(description_of(*members->elementAt(i)));
        return text;
    }
    auto* const base = type.getBaseValidator();
    return base == nullptr ? "a value of " + from_xerces(type.getTypeLocalName()) : kind_of(*base);
}

// Normalises white space as the type requires.
std::u16string normalised(DatatypeValidator const& type, std::string_view text) {
    auto value = to_xerces(text);
    auto* const manager = xercesc::XMLPlatformUtils::fgMemoryManager;
    if (type.getWSFacet() == DatatypeValidator::REPLACE) xercesc::XMLString::replaceWS(value.data(), manager);
    if (type.getWSFacet() == DatatypeValidator::COLLAPSE) xercesc::XMLString::collapseWS(value.data(), manager);
    value.resize(xercesc::XMLString::stringLen(value.data()));
    return value;
}

}  // namespace

Value check(DatatypeValidator& type, std::string_view text) {
    try {
        type.validate(normalised(type, text).c_str(), nullptr, xercesc::XMLPlatformUtils::fgMemoryManager);
        return Value::good;
    } catch (xercesc::XMLException const&) {
        return Value::bad;
    }
}

std::string description_of(DatatypeValidator& type) {
    for (auto* each = &type; each != nullptr; each = each->getBaseValidator()) {
        if (auto values = enumeration_of(*each); !values.empty()) return values;
    }
    auto text = kind_of(type);
    for (auto* each = &type; each != nullptr && !is_built_in(*each); each = each->getBaseValidator()) text += facets_of(*each);
    return text;
}

}  // namespace rois::xml
