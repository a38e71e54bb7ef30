// The door to the simulation's components.
#pragma once

#include <memory>
#include <vector>

#include "engine/component.hpp"
#include "media/media.hpp"
#include "simulation/simulation.hpp"

namespace rois::simulation {

// The 15 basic components (7.6) and, unless there are no media (null), the two of RoIS 2.0 for streaming, of every robot in the
// hall, working on this one world. Each robot is a sub engine of its name. The components of the first robot are named as in
// table 31 ("navigation"); the components of a further robot carry its name before that ("robot2.navigation"). `profiles` are
// found by their URN, urn:x-rois:def:component:OMG::Navigation and so on, in any case; throws std::runtime_error naming one that
// is not there. The components keep the simulation and the media alive.
std::vector<std::unique_ptr<Component>> robot_components(std::shared_ptr<Simulation> const&, std::shared_ptr<media::Media> const&,
                                                         std::vector<ComponentProfile> const& profiles);

}  // namespace rois::simulation
