#include "kit/names.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace rois::kit {

namespace {

using Scope = std::map<std::string, std::string, std::less<>>;  // the namespace of each prefix

constexpr std::pair<std::string_view, std::string_view> known[] = {
    {"", "urn:x-rois:psm:xml:message:1"},         {"rois", "http://www.omg.org/spec/RoIS/20240801"},
    {"fes", "http://www.opengis.net/fes/2.0"},    {"gml", "http://www.opengis.net/gml/3.2"},
    {"unr", "http://www.irc.atr.jp/std/unr/0.1"}, {"xsi", "http://www.w3.org/2001/XMLSchema-instance"}};

std::string joined(std::string_view prefix, std::string_view name) {
    return prefix.empty() ? std::string{name} : std::string{prefix} + ":" + std::string{name};
}

// Returns a name like "r:name" with the known prefix of its namespace.
std::string known_name(std::string_view name, Scope const& scope) {
    auto const colon = name.find(':');
    auto const prefix = colon == name.npos ? std::string_view{} : name.substr(0, colon);
    auto const local = colon == name.npos ? name : name.substr(colon + 1);
    auto const declared = scope.find(prefix);
    if (declared == scope.end() || declared->second.empty()) return std::string{name};
    if (auto const found = std::ranges::find(known, declared->second, &std::pair<std::string_view, std::string_view>::second);
        found != std::end(known))
        return joined(found->first, local);
    bool const pretends =
        std::ranges::find(known, prefix, &std::pair<std::string_view, std::string_view>::first) != std::end(known);
    return pretends ? joined("other", local) : std::string{name};
}

Scope with_declarations_of(pugi::xml_node element, Scope scope) {
    for (auto const attribute : element.attributes()) {
        std::string_view const name = attribute.name();
        if (name == "xmlns") scope[""] = attribute.value();
        if (name.starts_with("xmlns:")) scope[std::string{name.substr(6)}] = attribute.value();
    }
    return scope;
}

void rename(pugi::xml_node element, Scope const& outer) {
    auto const scope = with_declarations_of(element, outer);
    element.set_name(known_name(element.name(), scope).c_str());
    for (auto attribute : element.attributes()) {
        std::string_view const name = attribute.name();
        if (name.find(':') == name.npos || name.starts_with("xmlns:")) continue;
        attribute.set_name(known_name(name, scope).c_str());
        if (std::string_view{attribute.name()} == "xsi:type") attribute.set_value(known_name(attribute.value(), scope).c_str());
    }
    for (auto const child : element.children())
        if (child.type() == pugi::node_element) rename(child, scope);
}

}  // namespace

void give_known_prefixes(pugi::xml_document& document) {
    if (document.document_element()) rename(document.document_element(), {});
}

}  // namespace rois::kit
