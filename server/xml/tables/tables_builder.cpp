#include "xml/tables/tables_builder.hpp"

#include <array>
#include <utility>
#include <xercesc/framework/psvi/XSAttributeDeclaration.hpp>
#include <xercesc/framework/psvi/XSAttributeUse.hpp>
#include <xercesc/framework/psvi/XSNamedMap.hpp>

#include "xml/codec/names.hpp"
#include "xml/tables/content_automaton.hpp"
#include "xml/validation/scan.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

namespace {

using xercesc::XSConstants;

xercesc::XSComplexTypeDefinition* complex(xercesc::XSTypeDefinition* type) {
    bool const is_complex = type != nullptr && type->getTypeCategory() == xercesc::XSTypeDefinition::COMPLEX_TYPE;
    return is_complex ? static_cast<xercesc::XSComplexTypeDefinition*>(type) : nullptr;
}

xercesc::XSSimpleTypeDefinition* simple(xercesc::XSTypeDefinition* type) {
    bool const is_simple = type != nullptr && type->getTypeCategory() == xercesc::XSTypeDefinition::SIMPLE_TYPE;
    return is_simple ? static_cast<xercesc::XSSimpleTypeDefinition*>(type) : nullptr;
}

// Returns whether `type` is derived from `declared` by extension. Returns false if any type on the way blocks a derivation.
bool extends(xercesc::XSComplexTypeDefinition* type, xercesc::XSComplexTypeDefinition& declared, int blocked) {
    while (type != nullptr && type != &declared) {
        auto* const base = complex(type->getBaseType());
        if (type->getDerivationMethod() != XSConstants::DERIVATION_EXTENSION || base == type) return false;
        blocked |= type->getProhibitedSubstitutions();
        type = base;
    }
    return type == &declared && ((blocked | declared.getProhibitedSubstitutions()) & XSConstants::DERIVATION_EXTENSION) == 0;
}

// Returns whether type and declaration alone decide if the element is valid: not abstract, no default value, no identity
// constraints.
bool stands_alone(xercesc::XSElementDeclaration& element) {
    auto* const constraints = element.getIdentityConstraints();
    return !element.getAbstract() && element.getConstraintType() == XSConstants::VALUE_CONSTRAINT_NONE &&
           (constraints == nullptr || constraints->getLength() == 0);
}

// Returns whether the tables support this type as item of a list or member of a union.
bool fits_inside(ValueType const& type) {
    bool const plain = type.kind == ValueType::Kind::form || type.kind == ValueType::Kind::number;
    return plain || (type.kind == ValueType::Kind::text && !type.takes_any_text());
}

}  // namespace

void TablesBuilder::build(xercesc::XMLGrammarPool& locked) {
    bool changed = false;
    auto& model = *locked.getXSModel(changed);
    unknown_ = &tables_.types_.emplace_back();
    auto& types = *model.getComponents(XSConstants::TYPE_DEFINITION);
    for (XMLSize_t i = 0; i < types.getLength(); ++i) {
        auto* const each = complex(static_cast<xercesc::XSTypeDefinition*>(types.item(i)));
        if (each == nullptr || each->getAnonymous()) continue;
        named_.push_back(each);
        type(*each);
    }
    auto& elements = *model.getComponents(XSConstants::ELEMENT_DECLARATION);
    for (XMLSize_t i = 0; i < elements.getLength(); ++i) {
        auto& each = *static_cast<xercesc::XSElementDeclaration*>(elements.item(i));
        tables_.roots_.emplace_back(name(each), declaration(each));
    }
    for (auto const& [element, made] : declarations_) {
        limit_length(*made, *element);
        add_substitutes(*made, *element);
    }
    for (auto& each : tables_.types_) {
        for (auto& state : each.states) state.number = ++tables_.states_;
    }
}

Name TablesBuilder::name(XMLCh const* name_space, XMLCh const* local) {
    return {tables_.names_.add(from_xerces(name_space)), tables_.names_.add(from_xerces(local))};
}

ElementDeclaration const* TablesBuilder::declaration(xercesc::XSElementDeclaration& element) {
    auto const [found, is_new] = declarations_.try_emplace(&element, nullptr);
    if (!is_new) return found->second;
    auto& made = tables_.declarations_.emplace_back();
    found->second = &made;
    bool const known = stands_alone(element) && element.getTypeDefinition() != nullptr;
    made.type = known ? type(*element.getTypeDefinition()) : unknown_;
    return &made;
}

// The length of a list of numbers is limited, whatever its type.
void TablesBuilder::limit_length(ElementDeclaration& made, xercesc::XSElementDeclaration& element) const {
    bool const named_so = holds_list_of_numbers(from_xerces(element.getName()));
    bool const has_value = made.type->content == ElementType::Content::value;
    made.of_limited_length = named_so || (has_value && made.type->value->kind == ValueType::Kind::list);
    if (named_so && !has_value) made.type = unknown_;
}

void TablesBuilder::add_substitutes(ElementDeclaration& made, xercesc::XSElementDeclaration& element) {
    auto* const declared = complex(element.getTypeDefinition());
    if (declared == nullptr || made.type == unknown_) return;
    for (auto* const each : named_) {
        if (!extends(each, *declared, element.getDisallowedSubstitutions()) && each != declared) continue;
        made.substitutes.emplace_back(name(each->getNamespace(), each->getName()), type(*each));
    }
}

ElementType const* TablesBuilder::type(xercesc::XSTypeDefinition& definition) {
    auto const [found, is_new] = types_.try_emplace(&definition, nullptr);
    if (!is_new) return found->second;
    auto& made = tables_.types_.emplace_back();
    found->second = &made;
    if (auto* const with_value = simple(&definition)) {
        made.value = value(*with_value);
        made.content = ElementType::Content::value;
    } else {
        fill(made, *complex(&definition));
    }
    return &made;
}

void TablesBuilder::fill(ElementType& made, xercesc::XSComplexTypeDefinition& definition) {
    auto const content = definition.getContentType();
    if (content == xercesc::XSComplexTypeDefinition::CONTENTTYPE_SIMPLE) {
        made.value = value(*definition.getSimpleType());
    } else if (content != xercesc::XSComplexTypeDefinition::CONTENTTYPE_EMPTY) {
        auto states = automaton_of(
            definition.getParticle(), [&](auto& element) { return name(element); },
            [&](auto& element) { return declaration(element); });
        if (!states) return;
        made.states = *std::move(states);
    }
    auto* const uses = definition.getAttributeUses();
    constexpr std::size_t most_attributes = 64;  // bits of ElementType::required
    if (definition.getAbstract() || (uses != nullptr && uses->size() > most_attributes)) return;
    add_attributes(made, definition);
    constexpr std::array contents{ElementType::Content::empty, ElementType::Content::value, ElementType::Content::elements,
                                  ElementType::Content::mixed};
    made.content = contents.at(content);
}

void TablesBuilder::add_attributes(ElementType& made, xercesc::XSComplexTypeDefinition& definition) {
    static ValueType const of_unknown_type;
    auto* const uses = definition.getAttributeUses();
    for (XMLSize_t i = 0; uses != nullptr && i < uses->size(); ++i) {
        auto& use = *uses->elementAt(i);
        auto& declared = *use.getAttrDeclaration();
        bool const fixed = use.getConstraintType() == XSConstants::VALUE_CONSTRAINT_FIXED ||
                           declared.getConstraintType() == XSConstants::VALUE_CONSTRAINT_FIXED;
        auto* const its_type = declared.getTypeDefinition();
        if (use.getRequired()) made.required |= std::uint64_t{1} << made.attributes.size();
        made.attributes.push_back({name(declared.getNamespace(), declared.getName()),
                                   fixed || its_type == nullptr ? &of_unknown_type : value(*its_type)});
    }
}

ValueType const* TablesBuilder::value(xercesc::XSSimpleTypeDefinition& definition) {
    auto const [found, is_new] = values_.try_emplace(&definition, nullptr);
    if (!is_new) return found->second;
    auto& made = tables_.values_.emplace_back();
    found->second = &made;
    made = made_from(definition);
    return &made;
}

ValueType TablesBuilder::made_from(xercesc::XSSimpleTypeDefinition& definition) {
    auto* const base = simple(definition.getBaseType());
    bool const from_scratch = base == nullptr || base == &definition || from_xerces(base->getName()) == "anySimpleType";
    switch (definition.getVariety()) {
        case xercesc::XSSimpleTypeDefinition::VARIETY_LIST:
            return from_scratch ? list(definition) : with_facets(*value(*base), definition);
        case xercesc::XSSimpleTypeDefinition::VARIETY_UNION:
            return from_scratch ? alternatives(definition) : with_facets(*value(*base), definition);
        case xercesc::XSSimpleTypeDefinition::VARIETY_ATOMIC:
            break;
        default:
            return {};
    }
    if (from_xerces(definition.getNamespace()) != xsd_namespace)
        return from_scratch ? ValueType{} : with_facets(*value(*base), definition);
    if (auto const known = built_in(from_xerces(definition.getName())); known.kind != ValueType::Kind::unknown) return known;
    // Other built-in integer types differ from their base only in their bounds.
    bool const number =
        !from_scratch && value(*base)->kind == ValueType::Kind::number && value(*base)->notation == ValueType::Notation::integer;
    return number ? with_facets(*value(*base), definition) : ValueType{};
}

ValueType TablesBuilder::list(xercesc::XSSimpleTypeDefinition& definition) {
    ValueType made;
    auto const* const item = value(*definition.getItemType());
    if (!fits_inside(*item)) return made;
    made.kind = ValueType::Kind::list;
    made.members.push_back(item);
    return with_facets(made, definition);
}

ValueType TablesBuilder::alternatives(xercesc::XSSimpleTypeDefinition& definition) {
    ValueType made;
    made.kind = ValueType::Kind::alternatives;
    auto* const members = definition.getMemberTypes();
    for (XMLSize_t i = 0; members != nullptr && i < members->size(); ++i) {
        auto const* const member = value(*members->elementAt(i));
        if (fits_inside(*member)) made.members.push_back(member);
    }
    return with_facets(made, definition);
}

}  // namespace rois::xml
