// The mobile base of a body: its motions and their progress.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basic/body/entity.hpp"
#include "basic/body/wire_units.hpp"
#include "types/codes.hpp"

namespace rois::basic {

// RoIS's routing_policy (table 46). `time`: fewest seconds, with turns and braking; `distance`: shortest.
enum class RoutingPolicy : std::uint8_t { time, distance };

// Drives to these targets in order, on planned paths, and turns to a target's heading if it has one. If a target is occupied, the
// robot stops at polite_distance from the occupant, facing them; the target then counts as reached.
struct GoTo {
    std::vector<Target> targets;
    RoutingPolicy policy = RoutingPolicy::time;
};

inline constexpr Metres polite_distance = 1.0;  // between centres

// Approaches `whom`, and stays at `distance` (centre to centre, without touching), facing them. Never drives backwards. Never
// ends by itself.
struct KeepDistance {
    EntityId whom{};
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

// Stands still and occupies the base. Never ends by itself.
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
    lost,         // over: KeepDistance::whom has left
    ended         // over: by stop() or by another motion of the same owner; the robot brakes
};

constexpr bool over(MotionState s) { return s >= MotionState::arrived; }

struct Progress {
    MotionState state = MotionState::ended;
    std::size_t targets_reached = 0;  // of a GoTo
};

// Why a motion did not begin.
struct Rejection {
    CompletedStatus status = CompletedStatus::error;  // OUT_OF_RESOURCES if another component uses the base
    std::string reason;                               // for people: "the wheels are busy with move"
    std::optional<std::size_t> target{};  // the impossible target of a GoTo; `reason` continues a sentence: "is in a wall"
};

struct BaseStatus {
    std::optional<MotionState> motion;        // of the current motion; nothing if there is none
    std::optional<MotionState> last_outcome;  // of the last motion that ended; `unreachable` also after an impossible target
    bool brakes = false;                      // are applied
    bool stands = true;                       // neither drives nor turns
    bool stopping = false;                    // still moves after stop(), and will stand soon
};

// Carries out one motion at a time, for one component. Motions wait while the brakes are applied. The base avoids walls, people
// and other robots by itself.
class MobileBase {
public:
    virtual ~MobileBase() = default;

    // Begins a motion for the component `owner` ("navigation"), and ends an earlier motion of the same owner. Rejects the motion
    // if the base is busy for another owner, or if a target can never be reached because of its place.
    virtual std::variant<MotionId, Rejection> begin(std::string_view owner, Motion) = 0;

    // Returns the progress of a motion; `ended` for one that the base no longer knows.
    virtual Progress progress(MotionId) const = 0;

    // End, suspend and resume the current motion; ignored for any other motion. After stop() and hold() the robot brakes to a
    // stand. A motion that begins meanwhile waits until the robot stands.
    virtual void stop(MotionId) = 0;
    virtual void hold(MotionId) = 0;
    virtual void go_on(MotionId) = 0;

    // Applies or releases the brakes.
    virtual void brake(bool on) = 0;

    // Limits the speed of all motions. Without a value, only the robot's own limit applies.
    virtual void limit_speed(std::optional<MetresPerSecond>) = 0;

    virtual BaseStatus status() const = 0;
};

}  // namespace rois::basic
