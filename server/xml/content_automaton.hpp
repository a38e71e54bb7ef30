// Content models as automata: from a particle of a schema to the states that its children lead through.
#pragma once

#include <functional>
#include <optional>
#include <vector>
#include <xercesc/framework/psvi/XSElementDeclaration.hpp>
#include <xercesc/framework/psvi/XSParticle.hpp>

#include "xml/tables.hpp"

namespace rois::xml {

using NameOf = std::function<Name(xercesc::XSElementDeclaration&)>;
using DeclarationOf = std::function<ElementDeclaration const*(xercesc::XSElementDeclaration&)>;

// Nothing when the particle holds what the tables do not know (wildcards, xsd:all) or is too large. Elements stand for themselves
// alone, never for their substitutes.
std::optional<std::vector<ContentState>> automaton_of(xercesc::XSParticle*, NameOf const&, DeclarationOf const&);

}  // namespace rois::xml
