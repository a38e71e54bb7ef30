// Encodes the parts that requests, replies, notifications and profile documents share. The caller has declared the prefix `rois`
// in the document.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "types/messages.hpp"
#include "xml/codec/writer.hpp"

namespace rois::xml {

void write_identifier(Writer&, std::string_view element, Identifier const&);
void write_parameters(Writer&, std::string_view list, std::string_view element, ParameterList const&);
void write_results(Writer&, Results const&);

// The document must also declare the prefix `xsi`.
void write_sequence(Writer&, CommandUnitSequence const&);

// Writes the content of `condition`; an empty condition has none. Needs the prefixes `fes` and `gml`, and `unr` if needs_unr().
// Throws std::invalid_argument for a condition that XML cannot express.
void write_condition(Writer&, QueryExpression const&);
bool is_empty(QueryExpression const&);
bool needs_unr(QueryExpression const&);

// Also need the prefixes `gml` and `xsi`. The ids of sub profiles are `engine.<name>`.
void write_profile(Writer&, EngineProfile const&, std::string_view gml_id);
void write_profile(Writer&, ComponentProfile const&, std::string_view gml_id);

// Declare a prefix in the open start tag.
void declare_rois(Writer&);
void declare_xsi(Writer&);
void declare_gml(Writer&);
void declare_fes(Writer&);
void declare_unr(Writer&);

std::string numbers_text(std::span<double const>);

// Returns whether the text is an NCName of XML 1.0, fourth edition, as gml:id requires.
bool is_nc_name(std::string_view);

// Escapes an id into an NCName: writes each UTF-8 byte of a character that is not allowed as `_x3A_`. Also escapes a `_` that is
// followed by x and two hexadecimal digits (0-9, A-F), so that no two ids give the same name.
std::string nc_name(std::string_view);

}  // namespace rois::xml
