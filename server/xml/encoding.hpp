// The parts that requests, replies, notifications and profile documents have in common. The writer stands where the prefix `rois`
// is bound.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "types/messages.hpp"
#include "xml/writer.hpp"

namespace rois::xml {

void write_identifier(Writer&, std::string_view element, Identifier const&);
void write_parameters(Writer&, std::string_view list, std::string_view element, ParameterList const&);
void write_results(Writer&, Results const&);

// Needs the prefix `xsi`, too.
void write_sequence(Writer&, CommandUnitSequence const&);

// Inside `condition`; nothing when it restricts nothing. Needs the prefixes `fes` and `gml`, and `unr` for what `needs_unr`.
// Throws std::invalid_argument for what XML cannot say.
void write_condition(Writer&, QueryExpression const&);
bool is_empty(QueryExpression const&);
bool needs_unr(QueryExpression const&);

// Need `gml` and `xsi`, too. Ids of sub profiles are `engine.<name>`.
void write_profile(Writer&, EngineProfile const&, std::string_view gml_id);
void write_profile(Writer&, ComponentProfile const&, std::string_view gml_id);

// The prefixes that the above need, declared in the start tag that is open.
void declare_rois(Writer&);
void declare_xsi(Writer&);
void declare_gml(Writer&);
void declare_fes(Writer&);
void declare_unr(Writer&);

std::string numbers_text(std::span<double const>);

// Whether gml:id takes it as it is: an NCName of XML 1.0, fourth edition.
bool is_nc_name(std::string_view);

// An id as gml:id takes it: each byte (UTF-8) of a character that a name must not have is written as `_x3A_`, and so is a `_`
// before x and two of 0 to 9 and A to F. No two ids become the same name.
std::string nc_name(std::string_view);

}  // namespace rois::xml
