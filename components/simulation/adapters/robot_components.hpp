// Makes the simulation's components.
#pragma once

#include <memory>
#include <vector>

#include "engine/component.hpp"
#include "media/media.hpp"
#include "simulation/world/simulation.hpp"

namespace rois::simulation {

// Makes the 15 basic components (7.6) of every robot and, unless `media` is null, the two streaming components of RoIS 2.0. Each
// robot is a sub engine with its name. See component_ref() for the components' names. Finds their profiles by URN,
// urn:x-rois:def:component:OMG::Navigation, ignoring case; throws std::runtime_error if one is missing.
std::vector<std::unique_ptr<Component>> robot_components(std::shared_ptr<Simulation> const&, std::shared_ptr<media::Media> const&,
                                                         std::vector<ComponentProfile> const& profiles);

// Wraps the component if the scenario has faults for it, to test applications against a defective robot; else returns it
// unchanged.
std::unique_ptr<Component> with_faults(std::unique_ptr<Component>, std::shared_ptr<Simulation> const&);

}  // namespace rois::simulation
