// Reads a scenario document (schemas/hall.xsd, element scenario).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/scenario.hpp"
#include "xml/document.hpp"

namespace rois::simulation {

// `plan` is asked for the places and robots that the scenario names; `components` are the names, without the robot's, of those
// that the robots have beside the basic ones. Throws xml::BadDocument, "name:line:column: reason".
Scenario read_scenario(std::shared_ptr<xml::Schemas const>, std::string name, std::string text, FloorPlan const& plan,
                       std::vector<std::string> const& components = {});

}  // namespace rois::simulation
