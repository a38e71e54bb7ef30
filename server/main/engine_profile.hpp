// The engine's own part of its profile.
#pragma once

#include <string>

#include "main/settings.hpp"
#include "simulation/plan/floor_plan.hpp"
#include "types/profiles.hpp"

namespace rois {

// `instance` distinguishes this start of the engine from all others.
EngineProfile engine_profile(GatewaySettings const&, simulation::FloorPlan const&, std::string const& instance);

}  // namespace rois
