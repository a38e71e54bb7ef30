// Ways through the hall: a way is found by A* on a grid around walls, desks and those who stand in the way; then the best one by
// the policy is looked for over its corners and points close around edges and bodies.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/routing.hpp"

namespace rois::simulation {

// For bodies of one radius. Immutable after construction.
class Planner {
public:
    // The agility says what ways cost under `time`.
    Planner(FloorPlan const&, Metres radius, Agility const&);

    // Corner points from `from` (not included) to `to` (included), or nothing when there is no way. `in_the_way` are the discs of
    // others, which are kept clear of; from one that is too near already the way first leads away.
    std::optional<std::vector<Point>> way(Pose const& from, Point const& to, RoutingPolicy,
                                          std::span<Disc const> in_the_way = {}) const;

    // Room that is left between a body and those in its way.
    static constexpr Metres elbow_room = 0.1;

    // Whether a body can stand there, walls and desks considered, and those in the way, if any.
    bool fits(Point const&, std::span<Disc const> in_the_way = {}) const;

    // Of the points at `away` from `centre` where a body fits with nothing between it and the centre, the nearest to `from`.
    std::optional<Point> beside(Point const& centre, Metres away, Point const& from, std::span<Disc const> in_the_way = {}) const;

private:
    class Search;
    struct Cell {
        int column;
        int row;
    };
    using Blocked = std::vector<std::uint8_t>;  // a cell each

    Cell cell_at(Point const&) const;
    Point centre(Cell) const;
    bool inside(Cell) const;
    static bool goes_on(Cell before, Cell at, Cell after);  // without a turn
    std::size_t index(Cell) const;
    std::vector<Disc> kept_clear(std::span<Disc const> in_the_way) const;
    Blocked blocked_with(std::span<Disc const> kept_clear) const;
    std::optional<Cell> free_cell_near(Point const&, Blocked const&) const;
    bool cramped(Point const&, std::span<Disc const> kept_clear) const;  // where ways have to lead away first
    bool straight(Point const& from, Point const& to, std::span<Disc const> kept_clear) const;
    std::vector<Point> smoothed(Point const& from, std::vector<Point> const& corners, std::span<Disc const> kept_clear) const;

    void add_passages(Disc const& off, std::span<Disc const> kept_clear, std::vector<Point>& passages) const;
    void add_wide_passages(Disc const& off, std::span<Disc const> kept_clear, std::vector<Point>& passages) const;
    std::vector<Point> passages_near(Point const& from, Point const& to, Metres longest, RoutingPolicy,
                                     std::span<Disc const> kept_clear) const;
    std::vector<Point> improved(Pose const& from, std::vector<Point> way, RoutingPolicy, std::span<Disc const> kept_clear) const;

    FloorPlan plan_;
    Metres radius_;
    Agility agility_;
    int columns_;
    int rows_;
    std::vector<Point> passages_;  // around the ends of walls and the corners of desks
    std::vector<Point> wide_passages_;
    Blocked blocked_;  // cells whose centre is too near to a wall or desk
};

}  // namespace rois::simulation
