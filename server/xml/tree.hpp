// A thin cursor over pugixml's tree. Names are local names wherever the schemas leave no doubt about the namespace.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace rois::xml {

// How a document's bytes must be parsed to mean what they mean to xerces-c: white space kept, CDATA as text, references resolved,
// line ends and white space in attributes normalised.
inline constexpr unsigned int as_xerces_reads =
    pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata | pugi::parse_wconv_attribute;

std::string_view local_name(pugi::xml_node);

// Null when there is none. Attributes of xsi and declarations of namespaces are not looked at.
pugi::xml_node child(pugi::xml_node, std::string_view local_name);
pugi::xml_attribute attribute(pugi::xml_node, std::string_view local_name);
std::string attribute_text(pugi::xml_node, std::string_view local_name);  // empty when there is none

// All character data directly inside, as it stands.
std::string text_of(pugi::xml_node);

// The namespace to which a prefix is bound here; "" when it is not.
std::string_view namespace_of(pugi::xml_node, std::string_view prefix);

// The offset of an element's `<` in the bytes that it was parsed from.
std::size_t offset_of(pugi::xml_node element);

struct TypeName {
    std::string_view name_space;
    std::string_view local_name;
};

// Whether an attribute of this element is xsi's: says a type, or where a schema is.
bool is_of_xsi(pugi::xml_node, std::string_view prefix, std::string_view local_name);
bool is_of_xsi(pugi::xml_node, pugi::xml_attribute);
// The attribute of that name in the namespace xsi.
pugi::xml_attribute xsi_attribute(pugi::xml_node, std::string_view local_name);
// Its xsi:type, resolved.
std::optional<TypeName> xsi_type(pugi::xml_node);

}  // namespace rois::xml
