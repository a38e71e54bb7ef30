// The parts that replies, notifications and profile documents have in common. The writer stands where the prefix `rois` is bound.
#pragma once

#include <string_view>

#include "types/messages.hpp"
#include "xml/writer.hpp"

namespace rois::xml {

void write_identifier(Writer&, std::string_view element, Identifier const&);
void write_parameters(Writer&, std::string_view list, std::string_view element, ParameterList const&);
void write_results(Writer&, Results const&);

// Needs the prefix `xsi`, too.
void write_sequence(Writer&, CommandUnitSequence const&);

// Need `gml` and `xsi`, too. Ids of sub profiles are `engine.<name>`.
void write_profile(Writer&, EngineProfile const&, std::string_view gml_id);
void write_profile(Writer&, ComponentProfile const&, std::string_view gml_id);

// The prefixes that the above need, declared in the start tag that is open.
void declare_rois(Writer&);
void declare_xsi(Writer&);
void declare_gml(Writer&);

// An id as gml:id takes it: what a name must not have is written as `_x3A_`.
std::string nc_name(std::string_view);

}  // namespace rois::xml
