#include "xml/codec/tree.hpp"

#include <algorithm>
#include <array>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

constexpr std::array<std::string_view, 4> xsi_attributes{"type", "nil", "schemaLocation", "noNamespaceSchemaLocation"};

}  // namespace

std::string_view local_name(pugi::xml_node node) { return local_part(node.name()); }

pugi::xml_node child(pugi::xml_node node, std::string_view name) {
    for (auto candidate = node.first_child(); candidate; candidate = candidate.next_sibling()) {
        if (local_name(candidate) == name) return candidate;
    }
    return {};
}

pugi::xml_attribute attribute(pugi::xml_node node, std::string_view name) {
    for (auto candidate = node.first_attribute(); candidate; candidate = candidate.next_attribute()) {
        std::string_view const full = candidate.name();
        if (!full.ends_with(name) || local_part(full) != name || declares_namespace(full)) continue;
        if (!is_of_xsi(node, candidate)) return candidate;
    }
    return {};
}

std::string attribute_text(pugi::xml_node node, std::string_view name) { return attribute(node, name).value(); }

std::string text_of(pugi::xml_node node) {
    std::string text;
    for (auto part = node.first_child(); part; part = part.next_sibling()) {
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) text += part.value();
    }
    return text;
}

std::string_view namespace_of(pugi::xml_node node, std::string_view prefix) {
    if (prefix == "xml") return xml_namespace;
    for (; node; node = node.parent()) {
        for (auto declaration = node.first_attribute(); declaration; declaration = declaration.next_attribute()) {
            std::string_view const name = declaration.name();
            if (declares_namespace(name) && (prefix.empty() ? name == "xmlns" : local_part(name) == prefix && name != "xmlns")) {
                return declaration.value();
            }
        }
    }
    return {};
}

std::size_t offset_of(pugi::xml_node element) { return static_cast<std::size_t>(element.offset_debug()) - 1; }

bool is_of_xsi(pugi::xml_node node, std::string_view prefix, std::string_view name) {
    bool const perhaps = !prefix.empty() && std::ranges::find(xsi_attributes, name) != xsi_attributes.end();
    return perhaps && namespace_of(node, prefix) == xsi_namespace;
}

bool is_of_xsi(pugi::xml_node node, pugi::xml_attribute attribute) {
    return is_of_xsi(node, prefix_of(attribute.name()), local_part(attribute.name()));
}

pugi::xml_attribute xsi_attribute(pugi::xml_node node, std::string_view name) {
    for (auto candidate = node.first_attribute(); candidate; candidate = candidate.next_attribute()) {
        std::string_view const full = candidate.name();
        if (local_part(full) == name && is_of_xsi(node, candidate)) return candidate;
    }
    return {};
}

std::optional<TypeName> xsi_type(pugi::xml_node node) {
    auto const type = xsi_attribute(node, "type");
    if (!type) return std::nullopt;
    auto const name = trimmed(type.value());
    return TypeName{namespace_of(node, prefix_of(name)), local_part(name)};
}

}  // namespace rois::xml
