#include "xml/tree.hpp"

#include "types/texts.hpp"
#include "xml/names.hpp"

namespace rois::xml {

std::string_view local_name(pugi::xml_node node) { return local_part(node.name()); }

pugi::xml_node child(pugi::xml_node node, std::string_view name) {
    for (auto const candidate : node.children()) {
        if (local_name(candidate) == name) return candidate;
    }
    return {};
}

pugi::xml_attribute attribute(pugi::xml_node node, std::string_view name) {
    for (auto const candidate : node.attributes()) {
        std::string_view const full = candidate.name();
        if (local_part(full) != name || declares_namespace(full)) continue;
        if (full.size() == name.size() || namespace_of(node, prefix_of(full)) != xsi_namespace) return candidate;
    }
    return {};
}

std::string attribute_text(pugi::xml_node node, std::string_view name) { return attribute(node, name).value(); }

std::string text_of(pugi::xml_node node) {
    std::string text;
    for (auto const part : node.children()) {
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) text += part.value();
    }
    return text;
}

std::string_view namespace_of(pugi::xml_node node, std::string_view prefix) {
    if (prefix == "xml") return xml_namespace;
    for (; node; node = node.parent()) {
        for (auto const declaration : node.attributes()) {
            std::string_view const name = declaration.name();
            if (declares_namespace(name) && (prefix.empty() ? name == "xmlns" : local_part(name) == prefix && name != "xmlns")) {
                return declaration.value();
            }
        }
    }
    return {};
}

pugi::xml_attribute xsi_attribute(pugi::xml_node node, std::string_view name) {
    for (auto const candidate : node.attributes()) {
        std::string_view const full = candidate.name();
        auto const prefix = prefix_of(full);
        if (!prefix.empty() && local_part(full) == name && namespace_of(node, prefix) == xsi_namespace) return candidate;
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
