// The legs of a person: walks to a goal on a way around walls, and around those who are in the way.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "simulation/person.hpp"
#include "simulation/planner.hpp"
#include "simulation/random.hpp"

namespace rois::simulation {

class Walker {
public:
    enum class Step : std::uint8_t { walking, waiting, arrived, no_way };

    // `planner` is for bodies of person_radius; both are kept by reference.
    Walker(FloorPlan const& plan, Planner const& planner) : plan_(&plan), planner_(&planner) {}

    void go(Point const& goal);
    void stop();
    std::optional<Point> const& goal() const { return goal_; }
    bool has_goal() const { return goal_.has_value(); }

    // Moves the person's position and velocity; the heading is theirs. Never into a wall, and never nearer to one of the
    // others than touch_gap.
    static constexpr Metres touch_gap = 0.05;
    Step step(Person&, MetresPerSecond speed, std::span<Disc const> others, Random&, Seconds dt);

private:
    bool plan_way(Pose const&, std::span<Disc const> others);
    bool try_steps(Person&, Point const& corner, MetresPerSecond speed, std::span<Disc const> others, Seconds dt);
    bool can_step(Point const& from, Point const& to, std::span<Disc const> others) const;
    void wait_for_room(Person const&, std::span<Disc const> others, Random&, Seconds dt);

    FloorPlan const* plan_;
    Planner const* planner_;
    std::optional<Point> goal_;
    std::vector<Point> way_;
    Seconds blocked_ = 0;
    Seconds detour_ = 0;  // left of a step aside
};

}  // namespace rois::simulation
