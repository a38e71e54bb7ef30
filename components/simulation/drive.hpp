// The wheels of one robot, and the one motion that they carry out at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "simulation/course.hpp"
#include "simulation/motion.hpp"

namespace rois::simulation {

// A drive belongs to its Hall, which steps it. Speeds stay within the plan's limits at all times, accelerations unless the
// robot is to stand: then it brakes harder, so that it stands within RobotPlan::time_to_stop.
class Drive {
public:
    Drive(RobotId, RobotPlan const&, FloorPlan const&);
    ~Drive();
    Drive(Drive&&) noexcept;

    // Begins a motion for `owner` ("navigation", "follow", "move"). It takes the place of an earlier one of the same owner, which
    // is `ended`; nothing, when the wheels are another owner's: busy.
    std::optional<MotionId> begin(std::string_view owner, Motion);

    // Who has a motion that is not over; empty when nobody has.
    std::string_view owner() const;

    // How far a motion is. That of the last 16 motions is remembered; older ones are `ended`.
    Progress progress(MotionId) const;

    // How the last motion that is over ended; nothing before the first one.
    std::optional<MotionState> last_outcome() const { return last_outcome_; }

    // Makes last_outcome() `unreachable`, for a target that was rejected without a motion.
    void reject_target() { last_outcome_ = MotionState::unreachable; }

    // How far the motion under way is; nothing when there is none.
    std::optional<Progress> current() const;

    // End the motion, hold it, go on with it. The robot brakes to a stand when its motion is stopped or held; a motion that
    // begins meanwhile waits for that. Nothing happens to a motion that is over or is another.
    void stop(MotionId);
    void hold(MotionId);
    void go_on(MotionId);

    // Puts the brakes on or off. While they are on, the robot brakes to a stand and stays there. A motion, whoever owns it, waits
    // for them to be put off.
    void brake(bool on) { brakes_ = on; }
    bool brakes_are_on() const { return brakes_; }

    // Keeps all motions below this speed; nothing: up to that of the robot's plan, which is never exceeded.
    void limit_speed(std::optional<MetresPerSecond>);

    // Whether the robot neither drives nor turns.
    bool stands() const { return twist_.linear == 0 && twist_.angular == 0; }

    // Whether the robot still rolls after stop().
    bool is_stopping() const { return stopping_; }

    RobotId robot() const { return robot_; }
    Pose const& pose() const { return pose_; }
    Twist const& twist() const { return twist_; }
    RobotPlan const& plan() const { return plan_; }  // max_speed is the one that counts now

    // The floor that the robot takes up until it could stand still.
    Disc stopping_disc() const;

    // One step of the world, `dt` long.
    void step(Surroundings const&, Seconds dt);

private:
    struct Current {
        MotionId id{};
        std::string owner;
        Progress progress;
        std::unique_ptr<Course> course;
        bool held = false;
    };

    bool is_current(MotionId) const;
    void finish(MotionState);
    bool must_stand() const;
    void roll(Surroundings const&, Seconds dt);
    Wheels wheels(Surroundings const&, Seconds dt) const;
    Twist steer(Surroundings const&, Seconds dt);
    MetresPerSecond safe(MetresPerSecond wanted, Wheels const&) const;
    bool would_touch(Pose const&, Surroundings const&) const;

    RobotId robot_;
    RobotPlan plan_;
    MetresPerSecond fastest_;  // of the robot's plan
    Accelerations stopping_limits_;
    bool stopping_ = false;
    bool brakes_ = false;
    std::unique_ptr<Planner> planner_;
    Pose pose_;
    Twist twist_;
    std::optional<Current> current_;
    std::uint64_t last_id_ = 0;
    std::deque<std::pair<MotionId, Progress>> finished_;
    std::optional<MotionState> last_outcome_;
};

}  // namespace rois::simulation
