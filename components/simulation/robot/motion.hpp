// The motions of components/basic, as a robot's drive carries them out in the hall.
#pragma once

#include <optional>
#include <vector>

#include "basic/body/motion.hpp"
#include "simulation/plan/planner.hpp"
#include "simulation/world/entity.hpp"

namespace rois::simulation {

using basic::Curve;
using basic::GoTo;
using basic::KeepDistance;
using basic::Line;
using basic::Motion;
using basic::MotionId;
using basic::MotionState;
using basic::over;
using basic::polite_distance;
using basic::Progress;
using basic::Stay;

// The world around one robot, as its drive sees it in one step.
class Surroundings {
public:
    virtual ~Surroundings() = default;
    virtual FloorPlan const& plan() const = 0;
    virtual std::optional<Pose> pose_of(Entity) const = 0;
    // The obstacles of a robot are all people and the other robots. obstacles_with_stopping_room() adds the floor that the robots
    // need to stop; standing_obstacles() has only the obstacles that stand still.
    virtual std::vector<Disc> obstacles(RobotId) const = 0;
    virtual std::vector<Disc> obstacles_with_stopping_room(RobotId) const = 0;
    virtual std::vector<Disc> standing_obstacles(RobotId) const = 0;
};

}  // namespace rois::simulation
