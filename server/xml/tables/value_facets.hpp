// The built-in simple types of XML Schema that the tables support, and types restricted by facets.
#pragma once

#include <string_view>
#include <xercesc/framework/psvi/XSSimpleTypeDefinition.hpp>

#include "xml/tables/value_type.hpp"

namespace rois::xml {

// Returns a built-in type by its local name; Kind::unknown if it is not supported.
ValueType built_in(std::string_view name);

// Returns the base type restricted by the facets of `derived`; Kind::unknown if a facet is not supported.
ValueType with_facets(ValueType base, xercesc::XSSimpleTypeDefinition& derived);

}  // namespace rois::xml
