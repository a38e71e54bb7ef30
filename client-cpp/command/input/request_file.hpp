// Reads conditions and command sequences from XML files with a whole request or a part of one.
#pragma once

#include <memory>
#include <string>

#include "types/command_units.hpp"
#include "types/condition.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::command {

// Reads a `condition`, a `fes:Filter`, a `unr:SearchCondition`, or a request with a condition. Throws Trouble, "name:line:column:
// reason", if it is not valid by the schemas.
QueryExpression read_condition_file(std::shared_ptr<xml::Schemas const> const&, std::string const& name, std::string const& text);

// Reads a `rois:CommandUnitSequence`, or an `execute`. Throws Trouble.
CommandUnitSequence read_sequence_file(std::shared_ptr<xml::Schemas const> const&, std::string const& name,
                                       std::string const& text);

}  // namespace rois::command
