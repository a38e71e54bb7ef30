// The courses that follow paths of the planner: GoTo and KeepDistance.
#include <algorithm>
#include <cmath>

#include "simulation/robot/course.hpp"
#include "simulation/world/person.hpp"

namespace rois::simulation {
namespace {

constexpr Metres at_place = 0.04;
constexpr Radians at_heading = from_degrees(1.5);
constexpr Radians too_far_aside = 1.0;  // beyond it, the robot stops and turns on the spot

// Drives along the corners of a path.
class Corners {
public:
    bool given() const { return !points_.empty(); }
    void set(Point const& from, std::vector<Point> points) {
        before_ = from;
        points_ = std::move(points);
    }
    void clear() { points_.clear(); }

    // Returns nothing when the last point is reached.
    std::optional<Twist> steer(DriveState const& state) {
        while (points_.size() > 1 && passed(state.pose.position)) {
            if (std::abs(turn_at(0, before_)) >= sharpest_bend) turning_ = true;
            before_ = points_.front();
            points_.erase(points_.begin());
        }
        Metres const left = distance(state.pose.position, points_.front());
        if (points_.size() == 1 && left < at_place) return std::nullopt;
        Radians const aside = bearing(state.pose, points_.front());
        if (std::abs(aside) > too_far_aside || (state.stand() && std::abs(aside) > 0.08)) turning_ = true;
        if (std::abs(aside) < turned_enough) turning_ = false;
        if (turning_) return std::abs(state.twist.linear) > slow_enough ? Twist{} : Twist{0, state.rate_to_stop_in(aside)};
        RadiansPerSecond const fastest = std::abs(state.rate_to_stop_in(aside));
        return Twist{speed(state) * std::cos(aside), std::clamp(3.0 * aside, -fastest, fastest)};
    }

private:
    // Whether the next corner is near, or already behind the robot.
    bool passed(Point const& at) const {
        Point const left = points_.front() - at;
        return left.norm() < near_corner || left.dot(unit(direction(before_, points_.front()))) < 0;
    }

    Radians turn_at(std::size_t i, Point const& from) const {
        return wrapped(direction(points_[i], points_[i + 1]) - direction(from, points_[i]));
    }

    // The highest speed that allows the remaining corners and a stop at the last one.
    MetresPerSecond speed(DriveState const& state) const {
        MetresPerSecond most = state.plan.max_speed;
        Metres left = 0;
        Point from = state.pose.position;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            left += distance(from, points_[i]);
            MetresPerSecond at_end = 0;
            if (i + 1 < points_.size()) at_end = corner_speed(turn_at(i, from), state.plan.agility());
            MetresPerSecond const stopping = std::max(state.speed_to_stop_in(left), 0.04);
            most = std::min(most, std::hypot(at_end, stopping));
            from = points_[i];
        }
        return most;
    }

    Point before_ = Point::Zero();  // start of the current leg
    std::vector<Point> points_;
    bool turning_ = false;
};

// Simulates how long it takes to drive a path and to turn to `heading`, without obstacles.
Seconds rehearsed(DriveState const& state, std::vector<Point> const& way, std::optional<Radians> heading) {
    constexpr Seconds longest = 600;
    Pose pose = state.pose;
    Twist twist = state.twist;
    DriveState const now{state.robot, state.plan, state.planner, pose, twist, state.around, state.dt};
    Corners corners;
    corners.set(pose.position, way);
    for (Seconds time = 0; time < longest; time += state.dt) {
        auto const wanted = corners.steer(now);
        if (!wanted) return time + (heading ? turn_duration(wrapped(*heading - pose.heading), state.plan.agility()) : 0);
        twist = now.next(*wanted, driving(now.plan));
        pose = moved(pose, twist, state.dt);
    }
    return longest;
}

// Turns to a heading. Returns nothing when the robot stands at that heading.
std::optional<Twist> turn_to(DriveState const& state, Radians heading) {
    Radians const left = wrapped(heading - state.pose.heading);
    if (std::abs(left) < at_heading && state.stand()) return std::nullopt;
    return Twist{0, state.rate_to_stop_in(left)};
}

// Drives to goals that may move, around obstacles that stand still. Plans a new path if the robot is blocked for a while.
class Approach {
public:
    enum class Step : std::uint8_t { driving, waiting, there, no_way };

    Step towards(Target const& goal, RoutingPolicy policy, DriveState const& state, Twist& twist) {
        until_next_try_ -= state.dt;
        if (!goal_ || distance(goal_->position, goal.position) > 0.05) {
            goal_ = goal;
            corners_.clear();
            until_next_try_ = 0;
        }
        if (waits_too_long(state)) {
            corners_.clear();
            avoid_ = Avoid::all;
        }
        if (!corners_.given()) {
            Step const planned = plan(policy, state);
            if (planned != Step::driving) return planned;
        }
        auto const wanted = corners_.steer(state);
        stall_.update(state, wanted.has_value());
        if (!stall_.is_stalled()) avoid_ = Avoid::standing;
        twist = wanted.value_or(Twist{});
        if (!wanted) return Step::there;
        return stall_.is_stalled() ? Step::waiting : Step::driving;
    }

    void forget() {
        goal_.reset();
        corners_.clear();
        stall_.reset();
    }

private:
    enum class Avoid : std::uint8_t { standing, all };

    // Robots with a higher id wait longer: if two robots meet, one stands while the other drives around it.
    bool waits_too_long(DriveState const& state) {
        Seconds const limit = 1.0 + 3.0 * std::min(3.0, static_cast<double>(state.robot));
        if (!corners_.given() || stall_.waited() < limit) return false;
        stall_.reset();
        until_next_try_ = 0;
        return true;
    }

    Step plan(RoutingPolicy policy, DriveState const& state) {
        if (until_next_try_ > 0) return Step::waiting;
        until_next_try_ = 1.0;
        auto const obstacles = avoid_ == Avoid::all ? state.around.obstacles_with_stopping_room(state.robot)
                                                    : state.around.standing_obstacles(state.robot);
        auto way = state.planner.way(state.pose, goal_->position, policy, obstacles);
        if (!way) return state.planner.way(state.pose, goal_->position, policy) ? Step::waiting : Step::no_way;
        if (policy == RoutingPolicy::time) take_shortest_if_faster(*way, state, obstacles);
        corners_.set(state.pose.position, std::move(*way));
        return Step::driving;
    }

    // The planner only estimates durations. Therefore simulates both its path and the shortest path, and takes the faster one.
    void take_shortest_if_faster(std::vector<Point>& way, DriveState const& state, std::vector<Disc> const& obstacles) const {
        if (way.size() < 2) return;
        auto shortest = state.planner.way(state.pose, goal_->position, RoutingPolicy::distance, obstacles);
        if (!shortest || *shortest == way) return;
        if (rehearsed(state, *shortest, goal_->heading) < rehearsed(state, way, goal_->heading)) way = std::move(*shortest);
    }

    Corners corners_;
    StallDetector stall_;
    std::optional<Target> goal_;
    Avoid avoid_ = Avoid::standing;
    Seconds until_next_try_ = 0;
};

class GoToCourse : public Course {
public:
    explicit GoToCourse(GoTo motion) : motion_(std::move(motion)) {}

    Twist steer(DriveState const& state, Progress& progress) override {
        if (progress.targets_reached == motion_.targets.size()) {
            if (state.stand()) progress.state = MotionState::arrived;
            return {};
        }
        until_next_aim_ -= state.dt;
        Target const& target = motion_.targets[progress.targets_reached];
        if (!aim_ || (until_next_aim_ <= 0 && !in_place_)) aim(target, state);
        if (in_place_) return turn(progress, state);
        Twist twist;
        switch (approach_.towards(*aim_, motion_.policy, state, twist)) {
            case Approach::Step::driving:
                progress.state = MotionState::moving;
                break;
            case Approach::Step::waiting:
                progress.state = MotionState::obstructed;
                break;
            case Approach::Step::no_way:
                progress.state = MotionState::unreachable;
                break;
            case Approach::Step::there:
                in_place_ = true;
                break;
        }
        return twist;
    }

private:
    // At the position: turns to the target's heading, then begins the next target.
    Twist turn(Progress& progress, DriveState const& state) {
        progress.state = MotionState::moving;
        auto const twist = aim_->heading ? turn_to(state, *aim_->heading) : std::optional<Twist>{};
        if (twist || !state.stand()) return twist.value_or(Twist{});
        ++progress.targets_reached;
        in_place_ = false;
        aim_.reset();
        approach_.forget();
        return {};
    }

    // Computes where to stand for this target: at the target, or beside its occupant.
    void aim(Target const& target, DriveState const& state) {
        until_next_aim_ = 0.5;
        auto const obstacles = state.around.standing_obstacles(state.robot);
        auto const there = std::ranges::find_if(obstacles, [&](Disc const& other) {
            return distance(other.centre, target.position) < other.radius + state.plan.radius + Planner::elbow_room;
        });
        Target wanted = target;
        if (there != obstacles.end()) wanted = beside(*there, obstacles, target, state);
        // Ignores small movements of the occupant.
        if (aim_ && distance(aim_->position, wanted.position) < 0.05) wanted.position = aim_->position;
        aim_ = wanted;
    }

    static Target beside(Disc const& body, std::vector<Disc> const& obstacles, Target const& target, DriveState const& state) {
        bool const near = distance(state.pose.position, body.centre) < polite_distance + 0.15 &&
                          state.around.plan().in_sight(state.pose.position, body.centre);
        auto const place = near ? std::optional<Point>{state.pose.position}
                                : state.planner.beside(body.centre, polite_distance, state.pose.position, obstacles);
        if (!place) return target;
        return {*place, direction(*place, body.centre)};
    }

    GoTo motion_;
    Approach approach_;
    std::optional<Target> aim_;
    bool in_place_ = false;
    Seconds until_next_aim_ = 0;
};

class KeepDistanceCourse : public Course {
public:
    explicit KeepDistanceCourse(KeepDistance motion) : motion_(motion) {}

    Twist steer(DriveState const& state, Progress& progress) override {
        auto const whom = state.around.pose_of(entity(motion_.whom));
        if (!whom) {
            progress.state = MotionState::lost;
            return {};
        }
        progress.state = MotionState::moving;
        Metres const wanted = std::max(motion_.distance, state.plan.radius + person_radius + 0.2);
        Metres const apart = distance(state.pose.position, whom->position);
        bool const seen = state.around.plan().in_sight(state.pose.position, whom->position);
        if (near_ && (apart > wanted + 0.25 || !seen)) near_ = false;
        if (!near_ && apart <= wanted + 0.02 && seen) near_ = true;
        if (!near_) return come(whom->position, wanted, state, progress);
        approach_.forget();
        aim_.reset();
        Radians const aside = bearing(state.pose, whom->position);
        return {0, std::abs(aside) < from_degrees(4) ? 0 : state.rate_to_stop_in(aside)};
    }

private:
    // Chooses a new place to stand when the followed person or robot has moved.
    Twist come(Point const& whom, Metres wanted, DriveState const& state, Progress& progress) {
        until_next_aim_ -= state.dt;
        if (!aim_ || (distance(whom, aimed_at_) > 0.3 && until_next_aim_ <= 0)) {
            until_next_aim_ = 0.4;
            aimed_at_ = whom;
            aim_ = state.planner.beside(whom, wanted, state.pose.position);
        }
        Twist twist;
        Approach::Step const step =
            aim_ ? approach_.towards({*aim_, {}}, RoutingPolicy::time, state, twist) : Approach::Step::no_way;
        if (step == Approach::Step::waiting || step == Approach::Step::no_way) progress.state = MotionState::obstructed;
        if (step != Approach::Step::driving && distance(whom, aimed_at_) > 0.1) aim_.reset();
        return twist;
    }

    KeepDistance motion_;
    Approach approach_;
    std::optional<Point> aim_;
    Point aimed_at_ = Point::Zero();
    bool near_ = false;
    Seconds until_next_aim_ = 0;
};

}  // namespace

std::unique_ptr<Course> course_of(GoTo motion) { return std::make_unique<GoToCourse>(std::move(motion)); }
std::unique_ptr<Course> course_of(KeepDistance motion) { return std::make_unique<KeepDistanceCourse>(motion); }

}  // namespace rois::simulation
