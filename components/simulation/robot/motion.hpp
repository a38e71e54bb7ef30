// The motions of a robot's drive and their progress.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "simulation/plan/planner.hpp"
#include "simulation/world/entity.hpp"
#include "simulation/world/wire_units.hpp"

namespace rois::simulation {

// Drives to these targets in order, on paths of the planner, and turns to a target's heading if it has one. If a target is
// occupied, the robot stops at polite_distance from the occupant, facing them; the target then counts as reached.
struct GoTo {
    std::vector<Target> targets;
    RoutingPolicy policy = RoutingPolicy::time;
};

inline constexpr Metres polite_distance = 1.0;  // between centres

// Approaches `whom`, and stays at `distance` (centre to centre, without touching), facing them. Never drives backwards. Never
// ends by itself.
struct KeepDistance {
    Entity whom;
    Metres distance = polite_distance;
};

// Turns on the spot by `turn` (positive: to the left), then drives `distance` straight (negative: backwards).
struct Line {
    Metres distance = 0;
    Radians turn = 0;
    std::optional<Seconds> duration = std::nullopt;  // of the whole motion, within the robot's limits
};

// Drives along a circle until the heading has changed by `turn` (positive: to the left).
//   radius > 0: forwards; the centre is to the left if `turn` is positive, to the right if negative
//   radius < 0: backwards; the sides are swapped
//   radius = 0: turns on the spot
struct Curve {
    Metres radius = 0;
    Radians turn = 0;
    std::optional<Seconds> duration = std::nullopt;  // as in Line
};

// Stands still and occupies the drive. Never ends by itself.
struct Stay {};

using Motion = std::variant<GoTo, KeepDistance, Line, Curve, Stay>;

// Names one motion of one robot.
enum class MotionId : std::uint64_t {};

enum class MotionState : std::uint8_t {
    moving,       // driving, or keeping its distance
    obstructed,   // waits for a person or robot in the way; continues by itself
    held,         // by hold()
    arrived,      // over: completed; the robot stands still
    unreachable,  // over: walls block all paths to the next target
    lost,         // over: KeepDistance::whom has left the hall
    ended         // over: by stop() or by another motion of the same owner; the robot brakes
};

constexpr bool over(MotionState s) { return s >= MotionState::arrived; }

struct Progress {
    MotionState state = MotionState::ended;
    std::size_t targets_reached = 0;  // of a GoTo
};

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
