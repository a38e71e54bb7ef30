// The simple types of XML Schema that the tables know, and what facets make of them.
#pragma once

#include <string_view>
#include <xercesc/framework/psvi/XSSimpleTypeDefinition.hpp>

#include "xml/value_type.hpp"

namespace rois::xml {

// A type of XML Schema's own, by its local name; of unknown kind when the tables do not have it.
ValueType built_in(std::string_view name);

// The base type with the facets of a type derived from it by restriction; of unknown kind when one of them is not understood.
ValueType with_facets(ValueType base, xercesc::XSSimpleTypeDefinition& derived);

}  // namespace rois::xml
