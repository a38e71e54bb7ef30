// The units and poses of components/basic, for the simulation. Poses are in the hall's frame: x points to the right of the floor
// plan, y up, and heading 0 along x.
#pragma once

#include "basic/body/pose.hpp"
#include "basic/body/wire_units.hpp"

namespace rois::simulation {

using basic::bearing;
using basic::Covariance;
using basic::direction;
using basic::distance;
using basic::frame;
using basic::from_degrees;
using basic::in_seconds;
using basic::Metres;
using basic::MetresPerSecond;
using basic::Point;
using basic::Pose;
using basic::Radians;
using basic::RadiansPerSecond;
using basic::Seconds;
using basic::Target;
using basic::to_degrees;
using basic::Twist;
using basic::unit;
using basic::world_time;
using basic::WorldTime;
using basic::wrapped;

}  // namespace rois::simulation
