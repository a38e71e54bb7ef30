// Walks a person to a goal, around walls and obstacles.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "simulation/plan/planner.hpp"
#include "simulation/world/person.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {

class Walker {
public:
    enum class Step : std::uint8_t { walking, waiting, arrived, no_way };

    // `planner` must be for bodies of person_radius. Both arguments must outlive the walker.
    Walker(FloorPlan const& plan, Planner const& planner) : plan_(&plan), planner_(&planner) {}

    void go(Point const& goal);
    void stop();
    std::optional<Point> const& goal() const { return goal_; }
    bool has_goal() const { return goal_.has_value(); }

    // Updates the person's position and velocity, not the heading. Never steps into a wall, or nearer than touch_gap to an
    // obstacle.
    static constexpr Metres touch_gap = 0.05;
    Step step(Person&, MetresPerSecond speed, std::span<Disc const> obstacles, Random&, Seconds dt);

private:
    bool plan_way(Pose const&, std::span<Disc const> obstacles);
    bool try_steps(Person&, Point const& corner, MetresPerSecond speed, std::span<Disc const> obstacles, Seconds dt);
    void wait_for_room(Person const&, std::span<Disc const> obstacles, Random&, Seconds dt);

    FloorPlan const* plan_;
    Planner const* planner_;
    std::optional<Point> goal_;
    std::vector<Point> way_;
    Seconds blocked_ = 0;
    Seconds detour_ = 0;  // remaining time of a step aside
};

}  // namespace rois::simulation
