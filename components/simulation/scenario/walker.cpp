#include "simulation/scenario/walker.hpp"

#include <algorithm>
#include <array>

namespace rois::simulation {
namespace {

constexpr Metres at_place = 0.08;
constexpr Metres at_corner = 0.2;

}  // namespace

void Walker::go(Point const& goal) {
    if (goal_ && distance(*goal_, goal) < 0.01) return;
    goal_ = goal;
    way_.clear();
    blocked_ = 0;
    detour_ = 0;
}

void Walker::stop() {
    goal_.reset();
    way_.clear();
}

Walker::Step Walker::step(Person& person, MetresPerSecond speed, std::span<Disc const> obstacles, Random& random, Seconds dt) {
    person.velocity = Point::Zero();
    if (!goal_) return Step::arrived;
    if (distance(person.pose.position, *goal_) < at_place) {
        stop();
        return Step::arrived;
    }
    if (detour_ > 0) {
        detour_ -= dt;
        if (detour_ <= 0) way_.clear();
    }
    if (way_.empty() && !plan_way(person.pose, {})) return Step::no_way;
    while (way_.size() > 1 && distance(person.pose.position, way_.front()) < at_corner) way_.erase(way_.begin());
    if (try_steps(person, way_.front(), speed, obstacles, dt)) {
        blocked_ = std::max(0.0, blocked_ - dt / 2);
        return Step::walking;
    }
    wait_for_room(person, obstacles, random, dt);
    return Step::waiting;
}

bool Walker::plan_way(Pose const& from, std::span<Disc const> obstacles) {
    auto way = planner_->way(from, *goal_, RoutingPolicy::distance, obstacles);
    if (!way) return false;
    way_ = std::move(*way);
    return true;
}

// Tries to step ahead, then aside, first to the right.
bool Walker::try_steps(Person& person, Point const& corner, MetresPerSecond speed, std::span<Disc const> obstacles, Seconds dt) {
    constexpr std::array<Radians, 9> aside{0, -0.35, 0.35, -0.7, 0.7, -1.05, 1.05, -1.4, 1.4};
    Point const from = person.pose.position;
    Radians const ahead = direction(from, corner);
    Metres const stride = std::min(speed * dt, distance(from, corner));
    for (Radians turn : aside) {
        Point const step = stride * (turn == 0 ? 1.0 : 0.7) * unit(ahead + turn);
        if (collides(*plan_, {from, person_radius}, from + step, obstacles, touch_gap)) continue;
        person.pose.position = from + step;
        person.velocity = step / dt;
        return true;
    }
    return false;
}

// Plans another path after a while. If there is none, steps aside at random so that the others can pass.
void Walker::wait_for_room(Person const& person, std::span<Disc const> obstacles, Random& random, Seconds dt) {
    Seconds const before = blocked_;
    blocked_ += dt;
    if (before < 1.0 && blocked_ >= 1.0) plan_way(person.pose, obstacles);
    if (blocked_ < 3.0) return;
    blocked_ = 0;
    if (plan_way(person.pose, obstacles)) return;
    Point const aside = person.pose.position + random.uniform(0.4, 1.2) * unit(random.uniform(0, 2 * std::numbers::pi));
    if (!plan_->can_go_straight(person.pose.position, aside, person_radius)) return;
    way_ = {aside};
    detour_ = 1.5;
}

}  // namespace rois::simulation
