// How each kind of motion steers: from where the robot is to the twist that it wants next.
#pragma once

#include <memory>
#include <optional>

#include "simulation/motion.hpp"

namespace rois::simulation {

// How fast the wheels may change their speed and their turning.
struct Accelerations {
    double linear = 0;   // m/s^2
    double angular = 0;  // rad/s^2
};

// The limits on the way; and while the robot is stopped, held or braked: at least so much that it stands within time_to_stop.
Accelerations driving(RobotPlan const&);
Accelerations stopping(RobotPlan const&);

// The robot as a course sees it in a step, `dt` long.
struct Wheels {
    RobotId robot;
    RobotPlan const& plan;
    Planner const& planner;
    Pose const& pose;
    Twist const& twist;
    Surroundings const& around;
    Seconds dt;

    bool stand() const;
    MetresPerSecond speed_to_stop_in(Metres) const;   // the fastest from which they can stop in that distance
    RadiansPerSecond rate_to_stop_in(Radians) const;  // towards that angle, the fastest from which they can stop at it

    // What comes of a wanted twist within these limits in this step; on a circle of that signed radius, if any.
    Twist next(Twist const& wanted, Accelerations const&, std::optional<Metres> circle = std::nullopt) const;
};

// The exact motion of a unicycle with constant twist.
Pose moved(Pose const& from, Twist const&, Seconds);

// Whether a drive does not go on along `heading` because a wall or desk ahead is too near.
bool wall_is_too_near(FloorPlan const&, Point const& at, Radians heading, Metres radius);

// The course of one motion.
class Course {
public:
    virtual ~Course() = default;

    // The twist wanted, before the limits of acceleration and the bodies in the way. Keeps `progress` up to date.
    virtual Twist steer(Wheels const&, Progress& progress) = 0;

    // Signed radius of the circle on which the robot stays, also while it brakes; nothing when it may turn as it likes.
    virtual std::optional<Metres> circle() const { return std::nullopt; }
};

std::unique_ptr<Course> course_of(GoTo);
std::unique_ptr<Course> course_of(KeepDistance);
std::unique_ptr<Course> course_of(Line);
std::unique_ptr<Course> course_of(Curve);
std::unique_ptr<Course> course_of(Stay);

// Notices that the wheels stand although they are wanted to move.
class Patience {
public:
    void look(Wheels const&, bool wants_to_move);
    bool obstructed() const { return waited_ > 0.6; }
    Seconds waited() const { return waited_; }
    void forget() { waited_ = 0; }

private:
    Seconds waited_ = 0;
};

}  // namespace rois::simulation
