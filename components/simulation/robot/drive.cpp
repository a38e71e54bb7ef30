#include "simulation/robot/drive.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {
namespace {

// The minimum gaps do not apply where the robot is nearer already and moves past.
constexpr Metres wall_gap = 0.015;   // to walls and desks
constexpr Metres body_gap = 0.10;    // to people and other robots
constexpr Metres squeezing = 0.008;  // gap while the robot passes an obstacle that is too near
constexpr Metres look_ahead = 2.0;   // obstacles farther away are ignored; longer than any stopping distance
constexpr std::size_t remembered = 16;

// How far the robot can drive along `heading`, at most `most`, before a wall or desk is too near.
Metres free_of_walls(FloorPlan const& plan, Point const& from, Radians heading, Metres radius, Metres most = look_ahead) {
    Point const ahead = unit(heading);
    bool const passes_by = plan.clearance(from) - plan.clearance(from + 0.01 * ahead) < 0.005;
    Metres const gap = passes_by ? std::clamp(plan.clearance(from) - radius - 0.001, 0.003, wall_gap) : wall_gap;
    Metres gone = 0;
    while (gone < most) {
        Point const at = from + gone * ahead;
        Metres const free = plan.clearance(at) - radius - gap;
        if (free <= 0.0005 && plan.clearance(at + 0.01 * ahead) < plan.clearance(at)) return gone;
        gone += std::max(free, 0.005);
    }
    return most;
}

Metres free_of_bodies(std::vector<Disc> const& others, Point const& from, Radians heading, Metres radius) {
    Metres free = look_ahead;
    for (Disc const& other : others) {
        bool const passes_by = std::abs(wrapped(direction(from, other.centre) - heading)) > from_degrees(60);
        Metres const left = distance(from, other.centre) - radius - other.radius - 0.001;
        Metres const gap = passes_by ? std::clamp(left, 0.02, body_gap) : body_gap;
        free = std::min(free, free_way({from, radius + gap}, heading, other, look_ahead));
        if (passes_by && left < body_gap) free = std::min(free, squeezing);
    }
    return free;
}

}  // namespace

bool wall_is_too_near(FloorPlan const& plan, Point const& at, Radians heading, Metres radius) {
    constexpr Metres next_step = 0.001;
    return free_of_walls(plan, at, heading, radius, next_step) == 0;
}

Drive::Drive(RobotId robot, RobotPlan const& robot_plan, FloorPlan const& floor)
    : robot_(robot),
      plan_(robot_plan),
      fastest_(robot_plan.max_speed),
      stopping_limits_(stopping(robot_plan)),
      planner_(std::make_unique<Planner>(floor, robot_plan.radius, robot_plan.agility())),
      pose_(robot_plan.start) {}
Drive::~Drive() = default;
Drive::Drive(Drive&&) noexcept = default;

std::optional<MotionId> Drive::begin(std::string_view owner, Motion motion) {
    if (current_) {
        if (current_->owner != owner) return std::nullopt;
        finish(MotionState::ended);
    }
    MotionId const id{++last_id_};
    auto course = std::visit([](auto& kind) { return course_of(std::move(kind)); }, motion);
    current_ = Current{id, std::string{owner}, Progress{MotionState::moving, 0}, std::move(course), false};
    return id;
}

std::string_view Drive::owner() const { return current_ ? std::string_view{current_->owner} : std::string_view{}; }

bool Drive::is_current(MotionId id) const { return current_ && current_->id == id; }

std::optional<Progress> Drive::current() const {
    if (!current_) return std::nullopt;
    Progress now = current_->progress;
    if (current_->held) now.state = MotionState::held;
    return now;
}

Progress Drive::progress(MotionId id) const {
    if (is_current(id)) return *current();
    auto found = std::ranges::find(finished_, id, &std::pair<MotionId, Progress>::first);
    return found == finished_.end() ? Progress{} : found->second;
}

void Drive::finish(MotionState state) {
    current_->progress.state = state;
    last_outcome_ = state;
    finished_.emplace_back(current_->id, current_->progress);
    if (finished_.size() > remembered) finished_.pop_front();
    current_.reset();
}

void Drive::stop(MotionId id) {
    if (!is_current(id)) return;
    finish(MotionState::ended);
    stopping_ = !stands();
}

void Drive::hold(MotionId id) {
    if (is_current(id)) current_->held = true;
}

void Drive::go_on(MotionId id) {
    if (is_current(id)) current_->held = false;
}

void Drive::limit_speed(std::optional<MetresPerSecond> speed) { plan_.max_speed = std::min(fastest_, speed.value_or(fastest_)); }

Disc Drive::stopping_disc() const {
    Metres const braking = twist_.linear * std::abs(twist_.linear) / (2 * plan_.max_acceleration);
    return {pose_.position + braking / 2 * unit(pose_.heading), plan_.radius + std::abs(braking) / 2};
}

DriveState Drive::state(Surroundings const& around, Seconds dt) const {
    return {robot_, plan_, *planner_, pose_, twist_, around, dt};
}

void Drive::step(Surroundings const& around, Seconds dt) {
    roll(around, dt);
    if (stands()) stopping_ = false;
}

void Drive::roll(Surroundings const& around, Seconds dt) {
    std::optional<Metres> const circle = current_ ? current_->course->circle() : std::nullopt;
    Twist const wanted = steer(around, dt);
    auto const limits = must_stand() ? stopping_limits_ : driving(plan_);
    Twist const next = state(around, dt).next({safe(wanted.linear, state(around, dt)), wanted.angular}, limits, circle);
    Pose const there = moved(pose_, next, dt);
    // The bumper: prevents contact with obstacles that enter the stopping distance.
    if (collides(around.plan(), disc(), there.position, around.obstacles(robot_))) {
        twist_ = {};
        return;
    }
    twist_ = next;
    pose_ = there;
}

bool Drive::must_stand() const { return stopping_ || brakes_ || (current_ && current_->held); }

Twist Drive::steer(Surroundings const& around, Seconds dt) {
    if (!current_ || must_stand()) return {};
    Twist const wanted = current_->course->steer(state(around, dt), current_->progress);
    if (over(current_->progress.state)) finish(current_->progress.state);
    return wanted;
}

// Limits the speed so that the robot can stop before an obstacle.
MetresPerSecond Drive::safe(MetresPerSecond wanted, DriveState const& at) const {
    MetresPerSecond const going = wanted != 0 ? wanted : twist_.linear;
    if (going == 0) return 0;
    Radians const heading = going > 0 ? pose_.heading : wrapped(pose_.heading + std::numbers::pi);
    Metres const free =
        std::min(free_of_walls(at.around.plan(), pose_.position, heading, plan_.radius),
                 free_of_bodies(at.around.obstacles_with_stopping_room(robot_), pose_.position, heading, plan_.radius));
    MetresPerSecond const most = at.speed_to_stop_in(free);
    return std::clamp(wanted, -most, most);
}

}  // namespace rois::simulation
