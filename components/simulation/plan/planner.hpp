// Finds paths through the hall: A* on a grid finds a path around walls, desks and obstacles. A search over its corners and over
// points around edges and obstacles then improves the path by the policy.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "simulation/plan/floor_plan.hpp"
#include "simulation/plan/routing.hpp"

namespace rois::simulation {

// Plans for bodies of one radius. Immutable after construction.
class Planner {
public:
    // The agility determines costs under the policy `time`.
    Planner(FloorPlan const&, Metres radius, Agility const&);

    // Returns the corners of the path, without `from`, with `to`; nothing if there is no path. The path keeps elbow_room to the
    // discs `in_the_way`. If one is too near to `from`, the path first leads away from it.
    std::optional<std::vector<Point>> way(Pose const& from, Point const& to, RoutingPolicy,
                                          std::span<Disc const> in_the_way = {}) const;

    // The distance that paths keep to obstacles.
    static constexpr Metres elbow_room = 0.1;

    // Whether a body can stand there without touching walls, desks and the discs in the way.
    bool fits(Point const&, std::span<Disc const> in_the_way = {}) const;

    // Returns the point nearest to `from` at distance `away` from `centre` where a body fits. No wall or desk lies between the
    // point and the centre.
    std::optional<Point> beside(Point const& centre, Metres away, Point const& from, std::span<Disc const> in_the_way = {}) const;

private:
    class Search;
    struct Cell {
        int column;
        int row;
    };
    using Blocked = std::vector<std::uint8_t>;  // one entry for each cell

    Cell cell_at(Point const&) const;
    Point centre(Cell) const;
    bool inside(Cell) const;
    static bool goes_on(Cell before, Cell at, Cell after);  // without a turn
    std::size_t index(Cell) const;
    std::vector<Disc> kept_clear(std::span<Disc const> in_the_way) const;
    Blocked blocked_with(std::span<Disc const> kept_clear) const;
    std::optional<Cell> free_cell_near(Point const&, Blocked const&) const;
    bool cramped(Point const&, std::span<Disc const> kept_clear) const;  // paths must lead away first
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
    Blocked blocked_;  // whether a cell's centre is too near to a wall or desk
};

}  // namespace rois::simulation
