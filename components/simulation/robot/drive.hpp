// The drive of one robot. It carries out one motion at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "simulation/robot/course.hpp"
#include "simulation/robot/motion.hpp"

namespace rois::simulation {

// Owned and stepped by the Hall. Speed and acceleration stay within the plan's limits, except that stop(), hold() and brake()
// brake harder: the robot stands within RobotPlan::time_to_stop.
class Drive {
public:
    Drive(RobotId, RobotPlan const&, FloorPlan const&);
    ~Drive();
    Drive(Drive&&) noexcept;

    // Begins a motion for `owner` ("navigation", "follow", "move"). An earlier motion of the same owner becomes `ended`. Returns
    // nothing if the drive is busy with the motion of another owner.
    std::optional<MotionId> begin(std::string_view owner, Motion);

    // The owner of the current motion; empty if there is none.
    std::string_view owner() const;

    // Returns the progress of a motion. Motions older than the last 16 are reported as `ended`.
    Progress progress(MotionId) const;

    // The final state of the last finished motion; nothing before the first one.
    std::optional<MotionState> last_outcome() const { return last_outcome_; }

    // Sets last_outcome() to `unreachable`: a target was rejected before a motion began.
    void reject_target() { last_outcome_ = MotionState::unreachable; }

    // The progress of the current motion; nothing if there is none.
    std::optional<Progress> current() const;

    // End, suspend and resume the current motion; ignored for any other motion. The robot brakes to a stand after stop() and
    // hold(). A motion that begins meanwhile waits until the robot stands.
    void stop(MotionId);
    void hold(MotionId);
    void go_on(MotionId);

    // Applies or releases the brakes. While they are on, the robot brakes to a stand and motions of all owners wait.
    void brake(bool on) { brakes_ = on; }
    bool brakes_are_on() const { return brakes_; }

    // Limits the speed of all motions, at most to max_speed of the robot's plan. Without a value, removes the limit.
    void limit_speed(std::optional<MetresPerSecond>);

    // Whether the robot neither drives nor turns.
    bool stands() const { return twist_.linear == 0 && twist_.angular == 0; }

    // Whether the robot still moves after stop().
    bool is_stopping() const { return stopping_; }

    RobotId robot() const { return robot_; }
    Pose const& pose() const { return pose_; }
    Twist const& twist() const { return twist_; }
    RobotPlan const& plan() const { return plan_; }  // max_speed is the current limit

    Disc disc() const { return {pose_.position, plan_.radius}; }
    // The floor that the robot needs to stop.
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
    DriveState state(Surroundings const&, Seconds dt) const;
    Twist steer(Surroundings const&, Seconds dt);
    MetresPerSecond safe(MetresPerSecond wanted, DriveState const&) const;

    RobotId robot_;
    RobotPlan plan_;
    MetresPerSecond fastest_;  // max_speed of the robot's plan
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
