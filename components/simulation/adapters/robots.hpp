// The robots of the hall, as bodies of the basic components.
#pragma once

#include <memory>

#include "basic/adapters/robots.hpp"
#include "simulation/world/simulation.hpp"

namespace rois::simulation {

// `media` is null without a media server. Components for which the scenario has faults are wrapped by with_faults().
basic::Robots robots(std::shared_ptr<Simulation> const&, std::shared_ptr<media::Media>);

// Wraps the component if the scenario has faults for it, to test applications against a defective robot; else returns it
// unchanged.
std::unique_ptr<Component> with_faults(std::unique_ptr<Component>, std::shared_ptr<Simulation> const&);

}  // namespace rois::simulation
