// What a robot's drive can be told to do, and how that goes.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "simulation/entity.hpp"
#include "simulation/planner.hpp"
#include "simulation/wire_units.hpp"

namespace rois::simulation {

// To these positions, one after the other, on ways that the planner finds; turns to a target's heading where it has one. A target
// where somebody stands counts as reached at polite_distance from them, facing them.
struct GoTo {
    std::vector<Target> targets;
    RoutingPolicy policy = RoutingPolicy::time;
};

inline constexpr Metres polite_distance = 1.0;  // between centres

// Comes up to somebody and stays `distance` away from them (centre to centre, but never so near as to touch), facing them. Never
// backs away, and is never done by itself.
struct KeepDistance {
    Entity whom;
    Metres distance = polite_distance;
};

// Turns on the spot by `turn`, relative to the heading before and to the left when positive. Then drives `distance` straight
// along the new heading, backwards when negative.
struct Line {
    Metres distance = 0;
    Radians turn = 0;
    std::optional<Seconds> duration =
        std::nullopt;  // of the whole motion: slower than usual, but never faster than the limits allow
};

// Drives along a circle until the heading has changed by `turn`, to the left when positive. A negative radius drives backwards; 0
// turns on the spot. The centre is `radius` to the left of the robot when `turn` is positive, to its right when negative; a
// negative radius swaps the sides.
struct Curve {
    Metres radius = 0;
    Radians turn = 0;
    std::optional<Seconds> duration = std::nullopt;  // as of a Line
};

// Stands, and keeps the wheels. Never done by itself.
struct Stay {};

using Motion = std::variant<GoTo, KeepDistance, Line, Curve, Stay>;

// Names one motion of one robot.
enum class MotionId : std::uint64_t {};

enum class MotionState : std::uint8_t {
    moving,       // under way, or keeping its distance
    obstructed,   // waits for somebody to get out of the way; goes on by itself
    held,         // by hold()
    arrived,      // over: carried out; the robot stands still
    unreachable,  // over: walls leave no way; the robot has not gone beyond the targets reached
    lost,         // over: the one whose distance was kept has left the hall
    ended         // over: stop() or another motion of the same owner; the robot brakes
};

constexpr bool over(MotionState s) { return s >= MotionState::arrived; }

struct Progress {
    MotionState state = MotionState::ended;
    std::size_t targets_reached = 0;  // of a GoTo
};

// What a drive needs to know of the world around it in a step.
class Surroundings {
public:
    virtual ~Surroundings() = default;
    virtual FloorPlan const& plan() const = 0;
    virtual std::optional<Pose> pose_of(Entity) const = 0;
    virtual std::vector<Disc> bodies(RobotId) const = 0;           // all but this robot's
    virtual std::vector<Disc> others(RobotId) const = 0;           // the same, with the floor that robots need to stop on
    virtual std::vector<Disc> others_standing(RobotId) const = 0;  // of the bodies those that do not move
};

}  // namespace rois::simulation
