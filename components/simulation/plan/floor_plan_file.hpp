// Reads a floor plan document (schemas/hall.xsd, element floor_plan).
#pragma once

#include <memory>
#include <string>

#include "simulation/plan/floor_plan.hpp"
#include "xml/profiles/document.hpp"

namespace rois::simulation {

// Throws xml::BadDocument, "name:line:column: reason", if the document is not well-formed, not valid or has a flaw().
FloorPlan read_floor_plan(std::shared_ptr<xml::Schemas const>, std::string name, std::string text);

}  // namespace rois::simulation
