// Courses steer a motion: from the robot's state they compute the twist that it wants next.
#pragma once

#include <memory>
#include <optional>

#include "simulation/robot/motion.hpp"

namespace rois::simulation {

// The limits for changes of speed and of turn rate.
struct Accelerations {
    double linear = 0;   // m/s^2
    double angular = 0;  // rad/s^2
};

// The limits while driving. The limits while the robot is stopped, held or braked let it stand within RobotPlan::time_to_stop.
Accelerations driving(RobotPlan const&);
Accelerations stopping(RobotPlan const&);

// The state of a robot's drive at the beginning of a step of length `dt`: the input of a course.
struct DriveState {
    RobotId robot;
    RobotPlan const& plan;
    Planner const& planner;
    Pose const& pose;
    Twist const& twist;
    Surroundings const& around;
    Seconds dt;

    bool stand() const;
    MetresPerSecond speed_to_stop_in(Metres) const;   // the highest speed that allows a stop within this distance
    RadiansPerSecond rate_to_stop_in(Radians) const;  // the highest turn rate that allows a stop at this angle

    // Returns the twist after this step: as near to the wanted twist as the limits allow. If `circle` is given, keeps the robot
    // on the circle with this signed radius.
    Twist next(Twist const& wanted, Accelerations const&, std::optional<Metres> circle = std::nullopt) const;
};

// Returns the pose after a motion with constant twist.
Pose moved(Pose const& from, Twist const&, Seconds);

// Whether a wall or desk is too near to continue along `heading`.
bool wall_is_too_near(FloorPlan const&, Point const& at, Radians heading, Metres radius);

// The course of one motion.
class Course {
public:
    virtual ~Course() = default;

    // Returns the wanted twist, without regard to acceleration limits and obstacles. Updates `progress`.
    virtual Twist steer(DriveState const&, Progress& progress) = 0;

    // The signed radius of the circle that the robot must keep, also while it brakes; nothing if it may turn freely.
    virtual std::optional<Metres> circle() const { return std::nullopt; }
};

std::unique_ptr<Course> course_of(GoTo);
std::unique_ptr<Course> course_of(KeepDistance);
std::unique_ptr<Course> course_of(Line);
std::unique_ptr<Course> course_of(Curve);
std::unique_ptr<Course> course_of(Stay);

// Detects a robot that stands although its course wants it to move.
class StallDetector {
public:
    void update(DriveState const&, bool wants_to_move);
    bool is_stalled() const { return waited_ > 0.6; }
    Seconds waited() const { return waited_; }
    void reset() { waited_ = 0; }

private:
    Seconds waited_ = 0;
};

}  // namespace rois::simulation
