// Conditions and command sequences in XML files: as parts of a request, or whole requests that have them.
#pragma once

#include <memory>
#include <string>

#include "types/command_units.hpp"
#include "types/condition.hpp"
#include "xml/schemas.hpp"

namespace rois::command {

// A `condition`, a `fes:Filter`, a `unr:SearchCondition`, or a request with a condition. Throws Trouble, "name:line:column:
// reason", for what the schemas do not allow.
QueryExpression read_condition_file(std::shared_ptr<xml::Schemas const> const&, std::string const& name, std::string const& text);

// A `rois:CommandUnitSequence`, or an `execute`. Throws Trouble.
CommandUnitSequence read_sequence_file(std::shared_ptr<xml::Schemas const> const&, std::string const& name,
                                       std::string const& text);

}  // namespace rois::command
