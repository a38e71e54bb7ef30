// Reads a scenario document (schemas/hall.xsd, element scenario).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/plan/floor_plan.hpp"
#include "simulation/scenario/scenario.hpp"
#include "xml/profiles/document.hpp"

namespace rois::simulation {

// The places and robots that the scenario names must be in `plan`. `components` are the names, without the robot's name, of the
// robots' user-defined components. Throws xml::BadDocument, "name:line:column: reason".
Scenario read_scenario(std::shared_ptr<xml::Schemas const>, std::string name, std::string text, FloorPlan const& plan,
                       std::vector<std::string> const& components = {});

}  // namespace rois::simulation
