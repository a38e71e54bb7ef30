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
    std::optional<Twist> steer(Wheels const& wheels) {
        while (points_.size() > 1 && passed(wheels.pose.position)) {
            if (std::abs(turn_at(0, before_)) >= sharpest_bend) turning_ = true;
            before_ = points_.front();
            points_.erase(points_.begin());
        }
        Metres const left = distance(wheels.pose.position, points_.front());
        if (points_.size() == 1 && left < at_place) return std::nullopt;
        Radians const aside = bearing(wheels.pose, points_.front());
        if (std::abs(aside) > too_far_aside || (wheels.stand() && std::abs(aside) > 0.08)) turning_ = true;
        if (std::abs(aside) < turned_enough) turning_ = false;
        if (turning_) return std::abs(wheels.twist.linear) > slow_enough ? Twist{} : Twist{0, wheels.rate_to_stop_in(aside)};
        RadiansPerSecond const fastest = std::abs(wheels.rate_to_stop_in(aside));
        return Twist{speed(wheels) * std::cos(aside), std::clamp(3.0 * aside, -fastest, fastest)};
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
    MetresPerSecond speed(Wheels const& wheels) const {
        MetresPerSecond most = wheels.plan.max_speed;
        Metres left = 0;
        Point from = wheels.pose.position;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            left += distance(from, points_[i]);
            MetresPerSecond at_end = 0;
            if (i + 1 < points_.size()) at_end = corner_speed(turn_at(i, from), wheels.plan.agility());
            MetresPerSecond const stopping = std::max(wheels.speed_to_stop_in(left), 0.04);
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
Seconds rehearsed(Wheels const& wheels, std::vector<Point> const& way, std::optional<Radians> heading) {
    constexpr Seconds longest = 600;
    Pose pose = wheels.pose;
    Twist twist = wheels.twist;
    Wheels const now{wheels.robot, wheels.plan, wheels.planner, pose, twist, wheels.around, wheels.dt};
    Corners corners;
    corners.set(pose.position, way);
    for (Seconds time = 0; time < longest; time += wheels.dt) {
        auto const wanted = corners.steer(now);
        if (!wanted) return time + (heading ? turn_duration(wrapped(*heading - pose.heading), wheels.plan.agility()) : 0);
        twist = now.next(*wanted, driving(now.plan));
        pose = moved(pose, twist, wheels.dt);
    }
    return longest;
}

// Turns to a heading. Returns nothing when the robot stands at that heading.
std::optional<Twist> turn_to(Wheels const& wheels, Radians heading) {
    Radians const left = wrapped(heading - wheels.pose.heading);
    if (std::abs(left) < at_heading && wheels.stand()) return std::nullopt;
    return Twist{0, wheels.rate_to_stop_in(left)};
}

// Drives to goals that may move, around obstacles that stand still. Plans a new path if the robot is blocked for a while.
class Approach {
public:
    enum class Step : std::uint8_t { driving, waiting, there, no_way };

    Step towards(Target const& goal, RoutingPolicy policy, Wheels const& wheels, Twist& twist) {
        until_next_try_ -= wheels.dt;
        if (!goal_ || distance(goal_->position, goal.position) > 0.05) {
            goal_ = goal;
            corners_.clear();
            until_next_try_ = 0;
        }
        if (waits_too_long(wheels)) {
            corners_.clear();
            avoid_ = Avoid::all;
        }
        if (!corners_.given()) {
            Step const planned = plan(policy, wheels);
            if (planned != Step::driving) return planned;
        }
        auto const wanted = corners_.steer(wheels);
        stall_.update(wheels, wanted.has_value());
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
    bool waits_too_long(Wheels const& wheels) {
        Seconds const limit = 1.0 + 3.0 * std::min(3.0, static_cast<double>(wheels.robot));
        if (!corners_.given() || stall_.waited() < limit) return false;
        stall_.reset();
        until_next_try_ = 0;
        return true;
    }

    Step plan(RoutingPolicy policy, Wheels const& wheels) {
        if (until_next_try_ > 0) return Step::waiting;
        until_next_try_ = 1.0;
        auto const obstacles = avoid_ == Avoid::all ? wheels.around.obstacles_with_stopping_room(wheels.robot)
                                                    : wheels.around.standing_obstacles(wheels.robot);
        auto way = wheels.planner.way(wheels.pose, goal_->position, policy, obstacles);
        if (!way) return wheels.planner.way(wheels.pose, goal_->position, policy) ? Step::waiting : Step::no_way;
        if (policy == RoutingPolicy::time) take_shortest_if_faster(*way, wheels, obstacles);
        corners_.set(wheels.pose.position, std::move(*way));
        return Step::driving;
    }

    // The planner only estimates durations. Simulates the shortest path too, and takes it if it is faster.
    void take_shortest_if_faster(std::vector<Point>& way, Wheels const& wheels, std::vector<Disc> const& obstacles) const {
        if (way.size() < 2) return;
        auto shortest = wheels.planner.way(wheels.pose, goal_->position, RoutingPolicy::distance, obstacles);
        if (!shortest || *shortest == way) return;
        if (rehearsed(wheels, *shortest, goal_->heading) < rehearsed(wheels, way, goal_->heading)) way = std::move(*shortest);
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

    Twist steer(Wheels const& wheels, Progress& progress) override {
        if (progress.targets_reached == motion_.targets.size()) {
            if (wheels.stand()) progress.state = MotionState::arrived;
            return {};
        }
        until_next_aim_ -= wheels.dt;
        Target const& target = motion_.targets[progress.targets_reached];
        if (!aim_ || (until_next_aim_ <= 0 && !in_place_)) aim(target, wheels);
        if (in_place_) return turn(progress, wheels);
        Twist twist;
        switch (approach_.towards(*aim_, motion_.policy, wheels, twist)) {
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
    Twist turn(Progress& progress, Wheels const& wheels) {
        progress.state = MotionState::moving;
        auto const twist = aim_->heading ? turn_to(wheels, *aim_->heading) : std::optional<Twist>{};
        if (twist || !wheels.stand()) return twist.value_or(Twist{});
        ++progress.targets_reached;
        in_place_ = false;
        aim_.reset();
        approach_.forget();
        return {};
    }

    // Computes where to stand for this target: at it, or beside its occupant.
    void aim(Target const& target, Wheels const& wheels) {
        until_next_aim_ = 0.5;
        auto const obstacles = wheels.around.standing_obstacles(wheels.robot);
        auto const there = std::ranges::find_if(obstacles, [&](Disc const& other) {
            return distance(other.centre, target.position) < other.radius + wheels.plan.radius + Planner::elbow_room;
        });
        Target wanted = target;
        if (there != obstacles.end()) wanted = beside(*there, obstacles, target, wheels);
        // Ignores small movements of the occupant.
        if (aim_ && distance(aim_->position, wanted.position) < 0.05) wanted.position = aim_->position;
        aim_ = wanted;
    }

    static Target beside(Disc const& body, std::vector<Disc> const& obstacles, Target const& target, Wheels const& wheels) {
        bool const near = distance(wheels.pose.position, body.centre) < polite_distance + 0.15 &&
                          wheels.around.plan().in_sight(wheels.pose.position, body.centre);
        auto const place = near ? std::optional<Point>{wheels.pose.position}
                                : wheels.planner.beside(body.centre, polite_distance, wheels.pose.position, obstacles);
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

    Twist steer(Wheels const& wheels, Progress& progress) override {
        auto const whom = wheels.around.pose_of(motion_.whom);
        if (!whom) {
            progress.state = MotionState::lost;
            return {};
        }
        progress.state = MotionState::moving;
        Metres const wanted = std::max(motion_.distance, wheels.plan.radius + person_radius + 0.2);
        Metres const apart = distance(wheels.pose.position, whom->position);
        bool const seen = wheels.around.plan().in_sight(wheels.pose.position, whom->position);
        if (near_ && (apart > wanted + 0.25 || !seen)) near_ = false;
        if (!near_ && apart <= wanted + 0.02 && seen) near_ = true;
        if (!near_) return come(whom->position, wanted, wheels, progress);
        approach_.forget();
        aim_.reset();
        Radians const aside = bearing(wheels.pose, whom->position);
        return {0, std::abs(aside) < from_degrees(4) ? 0 : wheels.rate_to_stop_in(aside)};
    }

private:
    // Chooses a new place to stand when the other one has moved.
    Twist come(Point const& whom, Metres wanted, Wheels const& wheels, Progress& progress) {
        until_next_aim_ -= wheels.dt;
        if (!aim_ || (distance(whom, aimed_at_) > 0.3 && until_next_aim_ <= 0)) {
            until_next_aim_ = 0.4;
            aimed_at_ = whom;
            aim_ = wheels.planner.beside(whom, wanted, wheels.pose.position);
        }
        Twist twist;
        Approach::Step const step =
            aim_ ? approach_.towards({*aim_, {}}, RoutingPolicy::time, wheels, twist) : Approach::Step::no_way;
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
