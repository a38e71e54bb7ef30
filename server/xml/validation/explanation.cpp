#include "xml/validation/explanation.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>
#include <xercesc/validators/schema/SchemaAttDef.hpp>
#include <xercesc/validators/schema/SchemaGrammar.hpp>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/content_model.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/simple_type.hpp"
#include "xml/validation/xerces_text.hpp"

namespace rois::xml {

namespace {

using xercesc::ComplexTypeInfo;
using xercesc::SchemaElementDecl;

// Shortens a name from a document, and removes control characters.
std::string shown(std::string_view name) { return quoted(name); }

// "'a'", "one of 'a', 'b', ...".
std::string listed(std::vector<std::string> const& names) {
    constexpr std::size_t most = 20;
    if (names.empty()) return "none";
    std::string text = names.size() == 1 ? "" : "one of ";
    for (std::size_t i = 0; i < names.size() && i < most; ++i) {
        if (i > 0) text += ", ";
        text += quoted(names[i]);
    }
    return names.size() > most ? text + ", ..." : text;
}

template <class Names>
std::vector<std::string> texts_of(Names const& names) {
    std::vector<std::string> texts;
    texts.reserve(names.size());
    for (auto const& name : names) texts.push_back(to_text(name));
    return texts;
}

pugi::xml_node first_element(pugi::xml_node parent) {
    return parent.find_child([](pugi::xml_node child) { return child.type() == pugi::node_element; });
}

ElementName name_of(pugi::xml_node element) {
    return {std::string{namespace_of(element, prefix_of(element.name()))}, std::string{local_name(element)}};
}

// An attribute without a prefix is in no namespace.
ElementName name_of(pugi::xml_node element, pugi::xml_attribute attribute) {
    auto const prefix = prefix_of(attribute.name());
    return {prefix.empty() ? std::string{} : std::string{namespace_of(element, prefix)},
            std::string{local_part(attribute.name())}};
}

// The attributes of XMLSchema-instance that every element may have. `nil` is rejected.
constexpr std::array<std::string_view, 3> attributes_of_xsi{"type", "schemaLocation", "noNamespaceSchemaLocation"};

class Explainer {
public:
    Explainer(Schemas const& schemas) : pool_{schemas.grammars().pool()} {}

    std::optional<Explanation> root(pugi::xml_node, std::span<std::string_view const> roots);

private:
    using Found = std::optional<Explanation>;

    Found element(pugi::xml_node, SchemaElementDecl&);
    Found attributes(pugi::xml_node, ComplexTypeInfo*);
    Found attribute(pugi::xml_node, pugi::xml_attribute, ComplexTypeInfo*);
    Found attribute_value(pugi::xml_node, pugi::xml_attribute, xercesc::SchemaAttDef const&);
    Found missing_attribute(pugi::xml_node, ComplexTypeInfo&);
    Found content(pugi::xml_node, ComplexTypeInfo&);
    Found nothing(pugi::xml_node, std::string_view text);
    Found children(pugi::xml_node, ComplexTypeInfo&);
    Found misplaced(pugi::xml_node parent, pugi::xml_node child, ContentModel const&, std::span<ElementName const> before);
    Found value(pugi::xml_node, xercesc::DatatypeValidator&);

    Explanation at(pugi::xml_node element, std::string reason) const { return {std::move(reason), offset_of(element)}; }
    xercesc::SchemaGrammar* grammar(std::string_view name_space) const;
    ComplexTypeInfo* find_type(TypeName const&) const;
    std::vector<std::string> types_that_fit(ComplexTypeInfo const& base) const;

    struct Definition {
        ElementName name;
        xercesc::SchemaAttDef* definition = nullptr;
    };
    std::vector<Definition> const& definitions_of(ComplexTypeInfo&);
    ContentModel const& model_of(ComplexTypeInfo&);

    xercesc::XMLGrammarPool& pool_;
    std::map<ComplexTypeInfo*, std::vector<Definition>> definitions_;  // of the types met so far
    std::map<ComplexTypeInfo*, ContentModel> models_;
    std::set<std::string> ids_;
};

xercesc::SchemaGrammar* Explainer::grammar(std::string_view name_space) const {
    for (auto all = pool_.getGrammarEnumerator(); all.hasMoreElements();) {
        auto& each = static_cast<xercesc::SchemaGrammar&>(all.nextElement());
        if (from_xerces(each.getTargetNamespace()) == name_space) return &each;
    }
    return nullptr;
}

Explainer::Found Explainer::root(pugi::xml_node node, std::span<std::string_view const> roots) {
    auto const name = name_of(node);
    if (!roots.empty()) {
        std::vector<std::string> const names{roots.begin(), roots.end()};
        if (std::ranges::find(roots, name.local_name) == roots.end()) {
            return at(node, "unknown operation " + shown(node.name()) + ": expected " + listed(names));
        }
        if (name.name_space != message_namespace) {
            return at(node, "the operation " + shown(node.name()) + " must be in the namespace " + quoted(message_namespace) +
                                ", not in " + quoted(name.name_space));
        }
    }
    auto* const its_grammar = grammar(name.name_space);
    SchemaElementDecl* declaration = nullptr;
    if (its_grammar != nullptr) {
        auto const uri = pool_.getURIStringPool()->getId(to_xerces(name.name_space).c_str());
        declaration = static_cast<SchemaElementDecl*>(
            its_grammar->getElemDecl(uri, to_xerces(name.local_name).c_str(), nullptr, xercesc::Grammar::TOP_LEVEL_SCOPE));
    }
    if (declaration == nullptr) {
        return at(node, "unknown element " + shown(node.name()) + " in the namespace " + quoted(name.name_space));
    }
    return element(node, *declaration);
}

Explainer::Found Explainer::element(pugi::xml_node node, SchemaElementDecl& declaration) {
    if (xsi_attribute(node, "nil")) return at(node, "'xsi:nil' is not allowed on " + shown(node.name()));
    auto* type = declaration.getComplexTypeInfo();
    if (auto const wanted = xsi_type(node); wanted && type != nullptr) {
        auto* const actual = find_type(*wanted);
        auto const* base = actual;
        while (base != nullptr && base != type) base = base->getBaseComplexTypeInfo();
        if (base == nullptr || actual->getAbstract()) {
            return at(node, "'xsi:type' of " + shown(node.name()) + " is " + quoted(xsi_attribute(node, "type").value()) +
                                ": expected " + listed(types_that_fit(*type)));
        }
        type = actual;
    } else if (type != nullptr && type->getAbstract()) {
        return at(node, "'xsi:type' is missing in " + shown(node.name()) + ": expected " + listed(types_that_fit(*type)));
    }
    if (auto found = attributes(node, type)) return found;
    if (type != nullptr) return content(node, *type);
    auto* const simple = declaration.getDatatypeValidator();
    return simple == nullptr ? std::nullopt : value(node, *simple);
}

// --- Attributes ---

Explainer::Found Explainer::attributes(pugi::xml_node node, ComplexTypeInfo* type) {
    for (auto const each : node.attributes()) {
        if (declares_namespace(each.name())) continue;
        if (auto found = attribute(node, each, type)) return found;
    }
    return type == nullptr ? std::nullopt : missing_attribute(node, *type);
}

Explainer::Found Explainer::attribute(pugi::xml_node node, pugi::xml_attribute attribute, ComplexTypeInfo* type) {
    auto const name = name_of(node, attribute);
    if (name.name_space == xsi_namespace && std::ranges::find(attributes_of_xsi, name.local_name) != attributes_of_xsi.end()) {
        return std::nullopt;
    }
    static std::vector<Definition> const none;
    std::vector<std::string> known;
    for (auto const& [defined, definition] : type == nullptr ? none : definitions_of(*type)) {
        if (defined == name) return attribute_value(node, attribute, *definition);
        if (defined.local_name == name.local_name && !name.name_space.empty() && !defined.name_space.empty())
            return at(node, "attribute " + shown(attribute.name()) + " of " + shown(node.name()) + " must be in the namespace " +
                                quoted(defined.name_space) + ", not in " + quoted(name.name_space));
        known.push_back(to_text(defined));
    }
    return at(node, "unknown attribute " + shown(attribute.name()) + " of " + shown(node.name()) + ": expected " + listed(known));
}

Explainer::Found Explainer::attribute_value(pugi::xml_node node, pugi::xml_attribute attribute,
                                            xercesc::SchemaAttDef const& definition) {
    auto* const type = definition.getDatatypeValidator();
    if (type == nullptr) return std::nullopt;
    if (check(*type, attribute.value()) == Value::bad) {
        return at(node, "attribute " + shown(attribute.name()) + " of " + shown(node.name()) + " has the value " +
                            quoted(attribute.value()) + ": expected " + description_of(*type));
    }
    if (type->getType() == xercesc::DatatypeValidator::ID && !ids_.emplace(trimmed(attribute.value())).second) {
        return at(node, "the id " + quoted(attribute.value()) + " is used twice");
    }
    return std::nullopt;
}

Explainer::Found Explainer::missing_attribute(pugi::xml_node node, ComplexTypeInfo& type) {
    for (auto const& [wanted, definition] : definitions_of(type)) {
        auto const use = definition->getDefaultType();
        if (use != xercesc::XMLAttDef::Required && use != xercesc::XMLAttDef::Required_And_Fixed) continue;
        auto const written = node.find_attribute([&](pugi::xml_attribute each) {
            return local_part(each.name()) == wanted.local_name && !declares_namespace(each.name()) &&
                   name_of(node, each) == wanted;
        });
        if (!written) return at(node, "attribute " + quoted(to_text(wanted)) + " is missing in " + shown(node.name()));
    }
    return std::nullopt;
}

std::vector<Explainer::Definition> const& Explainer::definitions_of(ComplexTypeInfo& type) {
    auto const [place, is_new] = definitions_.try_emplace(&type);
    auto& definitions = place->second;
    if (!is_new || !type.hasAttDefs()) return definitions;
    auto& list = type.getAttDefList();
    for (XMLSize_t i = 0; i < list.getAttDefCount(); ++i) {
        auto& definition = static_cast<xercesc::SchemaAttDef&>(list.getAttDef(i));
        if (definition.getDefaultType() == xercesc::XMLAttDef::Prohibited) continue;
        auto const* const name = definition.getAttName();
        definitions.push_back(
            {{from_xerces(pool_.getURIStringPool()->getValueForId(name->getURI())), from_xerces(name->getLocalPart())},
             &definition});
    }
    std::ranges::sort(definitions, {}, [](auto const& each) { return to_text(each.name); });
    return definitions;
}

ContentModel const& Explainer::model_of(ComplexTypeInfo& type) { return models_.try_emplace(&type, pool_, type).first->second; }

// --- Types ---

ComplexTypeInfo* Explainer::find_type(TypeName const& name) const {
    auto* const its_grammar = grammar(name.name_space);
    if (its_grammar == nullptr || its_grammar->getComplexTypeRegistry() == nullptr) return nullptr;
    auto const key = std::string{name.name_space} + "," + std::string{name.local_name};
    return its_grammar->getComplexTypeRegistry()->get(to_xerces(key).c_str());
}

std::vector<std::string> Explainer::types_that_fit(ComplexTypeInfo const& base) const {
    std::vector<std::string> names;
    for (auto all = pool_.getGrammarEnumerator(); all.hasMoreElements();) {
        auto* const types = static_cast<xercesc::SchemaGrammar&>(all.nextElement()).getComplexTypeRegistry();
        if (types == nullptr) continue;
        xercesc::RefHashTableOfEnumerator<ComplexTypeInfo> each{types};
        while (each.hasMoreElements()) {
            auto const& type = each.nextElement();
            auto const* ancestor = &type;
            while (ancestor != nullptr && ancestor != &base) ancestor = ancestor->getBaseComplexTypeInfo();
            if (ancestor == nullptr || type.getAbstract() || type.getAnonymous()) continue;
            names.push_back(to_text(ElementName{from_xerces(type.getTypeUri()), from_xerces(type.getTypeLocalName())}));
        }
    }
    std::ranges::sort(names);
    return names;
}

// --- Content ---

Explainer::Found Explainer::content(pugi::xml_node node, ComplexTypeInfo& type) {
    auto const text = text_of(node);
    switch (static_cast<SchemaElementDecl::ModelTypes>(type.getContentType())) {
        case SchemaElementDecl::Any:
            return std::nullopt;
        case SchemaElementDecl::Empty:
        case SchemaElementDecl::ElementOnlyEmpty:
            return nothing(node, text);
        case SchemaElementDecl::Simple:
            return type.getDatatypeValidator() == nullptr ? std::nullopt : value(node, *type.getDatatypeValidator());
        case SchemaElementDecl::Children:
            if (!trimmed(text).empty()) {
                return at(node, "text " + quoted(trimmed(text)) + " inside " + shown(node.name()) +
                                    ", which may contain only elements");
            }
            break;
        default:
            break;
    }
    return children(node, type);
}

Explainer::Found Explainer::nothing(pugi::xml_node node, std::string_view text) {
    if (auto const child = first_element(node)) {
        return at(child, "unknown element " + shown(child.name()) + ": " + shown(node.name()) + " must be empty");
    }
    return text.empty() ? std::nullopt : Found{at(node, shown(node.name()) + " must be empty, but has the text " + quoted(text))};
}

Explainer::Found Explainer::children(pugi::xml_node node, ComplexTypeInfo& type) {
    std::vector<pugi::xml_node> elements;
    std::vector<ElementName> names;
    for (auto const child : node.children()) {
        if (child.type() != pugi::node_element) continue;
        elements.push_back(child);
        names.push_back(name_of(child));
    }
    auto const& model = model_of(type);
    auto const failing = model.failing(names);
    for (std::size_t i = 0; i < elements.size() && i != failing; ++i) {
        auto* const declaration = model.find(names[i]);
        if (declaration == nullptr) continue;
        if (auto found = element(elements[i], *declaration)) return found;
    }
    if (!failing) return std::nullopt;
    std::span const before{names.data(), std::min(*failing, names.size())};
    if (*failing < elements.size()) return misplaced(node, elements[*failing], model, before);
    auto const missing = texts_of(model.missing_after(before));
    return at(node, (missing.size() == 1 ? "element " : "") + listed(missing) + " is missing in " + shown(node.name()));
}

Explainer::Found Explainer::misplaced(pugi::xml_node parent, pugi::xml_node child, ContentModel const& model,
                                      std::span<ElementName const> before) {
    auto const expected = model.expected_after(before);
    auto const name = name_of(child);
    auto const inside = shown(child.name()) + " inside " + shown(parent.name());
    for (auto const& each : expected) {
        if (each.local_name == name.local_name) {
            return at(child, "element " + inside + " must be in the namespace " + quoted(each.name_space) + ", not in " +
                                 quoted(name.name_space));
        }
    }
    auto const wanted = expected.empty() ? std::string{"no more elements"} : listed(texts_of(expected));
    auto const known = model.find(name) != nullptr;
    return at(child,
              (known ? "element " + inside + " is not allowed here" : "unknown element " + inside) + ": expected " + wanted);
}

Explainer::Found Explainer::value(pugi::xml_node node, xercesc::DatatypeValidator& type) {
    if (auto const child = first_element(node)) {
        return at(child, "element " + shown(child.name()) + " inside " + shown(node.name()) + ", which may contain only text");
    }
    auto const text = text_of(node);
    if (check(type, text) == Value::good) return std::nullopt;
    return at(node, shown(node.name()) + " has the value " + quoted(text) + ": expected " + description_of(type));
}

}  // namespace

std::optional<Explanation> explain(Schemas const& schemas, pugi::xml_node root, std::span<std::string_view const> roots) {
    return Explainer{schemas}.root(root, roots);
}

}  // namespace rois::xml
