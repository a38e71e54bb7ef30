// Functions to walk pugixml's tree by local names: in a valid document the schemas determine the namespace.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace rois::xml {

// Parse options with which pugixml reads a document as xerces-c does: keep white space, read CDATA as text, resolve references,
// normalise line ends and white space in attributes.
inline constexpr unsigned int as_xerces_reads =
    pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata | pugi::parse_wconv_attribute;

std::string_view local_name(pugi::xml_node);

// The functions below return null, or an empty text, if there is no such node. Ignore attributes of xsi and namespace
// declarations.
pugi::xml_node child(pugi::xml_node, std::string_view local_name);
pugi::xml_attribute attribute(pugi::xml_node, std::string_view local_name);
std::string attribute_text(pugi::xml_node, std::string_view local_name);

// Returns all character data directly inside the element, untrimmed.
std::string text_of(pugi::xml_node);

// Returns the namespace to which a prefix is bound at this node; "" if it is unbound.
std::string_view namespace_of(pugi::xml_node, std::string_view prefix);

// Returns the offset of an element's `<` in the parsed bytes.
std::size_t offset_of(pugi::xml_node element);

struct TypeName {
    std::string_view name_space;
    std::string_view local_name;
};

// Returns whether an attribute of this element is one of the namespace xsi: type, nil, or a schema location.
bool is_of_xsi(pugi::xml_node, std::string_view prefix, std::string_view local_name);
bool is_of_xsi(pugi::xml_node, pugi::xml_attribute);
// Returns the attribute of this name in the namespace xsi, or null.
pugi::xml_attribute xsi_attribute(pugi::xml_node, std::string_view local_name);
// Returns the element's xsi:type with its prefix resolved.
std::optional<TypeName> xsi_type(pugi::xml_node);

}  // namespace rois::xml
