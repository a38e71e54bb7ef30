// Compiles a particle of a schema into a deterministic automaton over child elements.
#pragma once

#include <functional>
#include <optional>
#include <vector>
#include <xercesc/framework/psvi/XSElementDeclaration.hpp>
#include <xercesc/framework/psvi/XSParticle.hpp>

#include "xml/tables/tables.hpp"

namespace rois::xml {

using NameOf = std::function<Name(xercesc::XSElementDeclaration&)>;
using DeclarationOf = std::function<ElementDeclaration const*(xercesc::XSElementDeclaration&)>;

// Returns nothing if the particle contains a wildcard or xsd:all, has two declarations for one name, or is too large. Ignores
// substitution groups.
std::optional<std::vector<ContentState>> automaton_of(xercesc::XSParticle*, NameOf const&, DeclarationOf const&);

}  // namespace rois::xml
