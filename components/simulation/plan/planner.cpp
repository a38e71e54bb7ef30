#include "simulation/plan/planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "simulation/plan/legs.hpp"

namespace rois::simulation {
namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr Metres cell_size = 0.125;
constexpr Metres wall_room = 0.04;    // distance kept to walls if there is room
constexpr Metres bend_room = 0.06;    // distance kept to wall ends and desk corners, where paths bend
constexpr Metres start_search = 0.8;  // maximum distance of a free cell from a blocked start or end

struct Direction {
    int column;
    int row;
    double length;  // in cells
};
constexpr double diagonal = std::numbers::sqrt2;
constexpr std::array<Direction, 8> directions{
    {{1, 0, 1}, {1, 1, diagonal}, {0, 1, 1}, {-1, 1, diagonal}, {-1, 0, 1}, {-1, -1, diagonal}, {0, -1, 1}, {1, -1, diagonal}}};

constexpr int points_around = 8;  // of an edge or obstacle
constexpr Radians step_around = 2 * std::numbers::pi / points_around;
constexpr Metres wide_room = 0.35;          // farther out than the nearest points
constexpr std::size_t most_passages = 240;  // the ones with the shortest detours

}  // namespace

// One A* search over the cells for the shortest path.
class Planner::Search {
public:
    Search(Planner const& planner, Blocked const& blocked)
        : planner_(planner),
          blocked_(blocked),
          cost_(blocked.size(), std::numeric_limits<float>::infinity()),
          parent_(blocked.size(), none) {}

    // Returns the cells after `from` up to `to`; empty if there is no path or the cells are equal.
    std::vector<Cell> run(Cell from, Cell to) {
        offer(from, 0, none, to);
        while (!open_.empty()) {
            Entry const entry = open_.top();
            open_.pop();
            if (entry.cost > cost_[entry.cell]) continue;  // a better entry was expanded before
            if (entry.cell == planner_.index(to)) return back_from(entry.cell);
            expand(entry, to);
        }
        return {};
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Entry {
        float estimate;
        float cost;
        std::uint32_t cell;
        bool operator<(Entry const& other) const {  // makes the smallest the top of the queue
            return estimate != other.estimate ? estimate > other.estimate : cell > other.cell;
        }
    };

    Cell cell_of(std::uint32_t index) const {
        auto const cell = static_cast<int>(index);
        return {cell % planner_.columns_, cell / planner_.columns_};
    }

    static float estimate(Cell from, Cell to) {
        int const columns = std::abs(from.column - to.column), rows = std::abs(from.row - to.row);
        return static_cast<float>(std::max(columns, rows) + (diagonal - 1) * std::min(columns, rows));
    }

    bool can_step(Cell from, Direction const& d) const {
        auto free = [&](int column, int row) {
            Cell const cell{column, row};
            return planner_.inside(cell) && blocked_[planner_.index(cell)] == 0;
        };
        if (!free(from.column + d.column, from.row + d.row)) return false;
        return d.length == 1 || (free(from.column + d.column, from.row) && free(from.column, from.row + d.row));
    }

    void offer(Cell cell, float cost, std::uint32_t parent, Cell to) {
        auto const at = static_cast<std::uint32_t>(planner_.index(cell));
        if (cost >= cost_[at]) return;
        cost_[at] = cost;
        parent_[at] = parent;
        open_.push({cost + estimate(cell, to), cost, at});
    }

    void expand(Entry const& entry, Cell to) {
        Cell const cell = cell_of(entry.cell);
        for (Direction const& d : directions) {
            if (!can_step(cell, d)) continue;
            offer({cell.column + d.column, cell.row + d.row}, entry.cost + static_cast<float>(d.length), entry.cell, to);
        }
    }

    std::vector<Cell> back_from(std::uint32_t at) const {
        std::vector<Cell> cells;
        for (; parent_[at] != none; at = parent_[at]) cells.push_back(cell_of(at));
        std::ranges::reverse(cells);
        return cells;
    }

    Planner const& planner_;
    Blocked const& blocked_;
    std::vector<float> cost_;
    std::vector<std::uint32_t> parent_;
    std::priority_queue<Entry> open_;
};

Planner::Planner(FloorPlan const& plan, Metres radius, Agility const& agility) : plan_(plan), radius_(radius), agility_(agility) {
    Point const size = plan.bounds.high - plan.bounds.low;
    columns_ = std::max(1, static_cast<int>(std::floor(size.x() / cell_size)));
    rows_ = std::max(1, static_cast<int>(std::floor(size.y() / cell_size)));
    blocked_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            Cell const cell{column, row};
            blocked_[index(cell)] = plan_.clearance(centre(cell)) < radius_ + wall_room;
        }
    }
    auto const pass = [&](Point const& edge) {
        Disc const off{edge, radius_ + bend_room};
        add_passages(off, {}, passages_);
        add_wide_passages(off, {}, wide_passages_);
    };
    for (Segment const& wall : plan_.walls) {
        pass(wall.from);
        pass(wall.to);
    }
    for (Box const& desk : plan_.desks) {
        for (auto corner : {Box2::BottomLeft, Box2::BottomRight, Box2::TopLeft, Box2::TopRight})
            pass(Box2{desk.low, desk.high}.corner(corner));
    }
}

bool Planner::goes_on(Cell before, Cell at, Cell after) {
    return at.column - before.column == after.column - at.column && at.row - before.row == after.row - at.row;
}

Planner::Cell Planner::cell_at(Point const& p) const {
    Point const at = (p - plan_.bounds.low) / cell_size;
    return {std::clamp(static_cast<int>(std::floor(at.x())), 0, columns_ - 1),
            std::clamp(static_cast<int>(std::floor(at.y())), 0, rows_ - 1)};
}

Point Planner::centre(Cell cell) const { return plan_.bounds.low + cell_size * Point{cell.column + 0.5, cell.row + 0.5}; }

bool Planner::inside(Cell cell) const { return cell.column >= 0 && cell.column < columns_ && cell.row >= 0 && cell.row < rows_; }

std::size_t Planner::index(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(cell.column);
}

// The discs that the body's centre must not enter.
std::vector<Disc> Planner::kept_clear(std::span<Disc const> in_the_way) const {
    std::vector<Disc> kept{in_the_way.begin(), in_the_way.end()};
    for (Disc& disc : kept) disc.radius += radius_ + elbow_room;
    return kept;
}

Planner::Blocked Planner::blocked_with(std::span<Disc const> kept_clear) const {
    Blocked blocked = blocked_;
    for (Disc const& disc : kept_clear) {
        Cell const low = cell_at(disc.centre - Point::Constant(std::max(0.0, disc.radius)));
        Cell const high = cell_at(disc.centre + Point::Constant(std::max(0.0, disc.radius)));
        for (int row = low.row; row <= high.row; ++row) {
            for (int column = low.column; column <= high.column; ++column) {
                Cell const cell{column, row};
                if (distance(centre(cell), disc.centre) < disc.radius) blocked[index(cell)] = 1;
            }
        }
    }
    return blocked;
}

std::optional<Planner::Cell> Planner::free_cell_near(Point const& p, Blocked const& blocked) const {
    Cell const at = cell_at(p);
    if (blocked[index(at)] == 0) return at;
    int const reach = static_cast<int>(start_search / cell_size);
    std::optional<Cell> nearest;
    for (int row = at.row - reach; row <= at.row + reach; ++row) {
        for (int column = at.column - reach; column <= at.column + reach; ++column) {
            Cell const cell{column, row};
            if (!inside(cell) || blocked[index(cell)] != 0 || !plan_.can_go_straight(p, centre(cell), 0.05)) continue;
            if (!nearest || distance(p, centre(cell)) < distance(p, centre(*nearest))) nearest = cell;
        }
    }
    return nearest;
}

bool Planner::cramped(Point const& p, std::span<Disc const> kept_clear) const {
    return plan_.clearance(p) < radius_ + wall_room / 2 ||
           std::ranges::any_of(kept_clear, [&](Disc const& disc) { return distance(p, disc.centre) < disc.radius; });
}

bool Planner::straight(Point const& from, Point const& to, std::span<Disc const> kept_clear) const {
    Metres const room = std::min(plan_.clearance(from), plan_.clearance(to)) - 0.001;
    if (!plan_.can_go_straight(from, to, std::min(radius_ + wall_room / 2, room))) return false;
    return std::ranges::none_of(kept_clear, [&](Disc const& disc) {
        return distance(Segment{from, to}, disc.centre) < disc.radius;
    });
}

bool Planner::fits(Point const& p, std::span<Disc const> in_the_way) const {
    if (plan_.clearance(p) < radius_ + 0.01) return false;
    return std::ranges::none_of(in_the_way,
                                [&](Disc const& disc) { return distance(p, disc.centre) < disc.radius + radius_ + elbow_room; });
}

std::optional<Point> Planner::beside(Point const& centre, Metres away, Point const& from,
                                     std::span<Disc const> in_the_way) const {
    constexpr int candidates = 24;
    Radians const towards = direction(centre, from);
    for (int k = 0; k < candidates; ++k) {  // 0, +15, -15, +30, ... degrees from the side of `from`
        int const step = (k + 1) / 2 * (k % 2 == 1 ? 1 : -1);
        Point p = centre + away * unit(towards + step * 2 * std::numbers::pi / candidates);
        if (fits(p, in_the_way) && plan_.can_go_straight(centre, p, 0.02)) return p;
    }
    return std::nullopt;
}

std::optional<std::vector<Point>> Planner::way(Pose const& from, Point const& to, RoutingPolicy policy,
                                               std::span<Disc const> in_the_way) const {
    if (!fits(to)) return std::nullopt;
    std::vector<Disc> const kept = kept_clear(in_the_way);
    if (std::ranges::any_of(kept, [&](Disc const& disc) { return distance(to, disc.centre) < disc.radius; })) return std::nullopt;
    if (!cramped(from.position, kept) && straight(from.position, to, kept)) return std::vector<Point>{to};
    Blocked const blocked = blocked_with(kept);
    auto const first = free_cell_near(from.position, blocked);
    auto const last = free_cell_near(to, blocked);
    if (!first || !last) return std::nullopt;
    std::vector<Point> corners{centre(*first)};
    if (index(*first) != index(*last)) {
        std::vector<Cell> const cells = Search{*this, blocked}.run(*first, *last);
        if (cells.empty()) return std::nullopt;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i + 1 < cells.size() && i > 0 && goes_on(cells[i - 1], cells[i], cells[i + 1])) continue;
            corners.push_back(centre(cells[i]));
        }
    }
    corners.push_back(to);
    return improved(from, smoothed(from.position, corners, kept), policy, kept);
}

// Adds an octagon around a disc, just large enough that its sides do not touch the disc.
void Planner::add_passages(Disc const& off, std::span<Disc const> kept_clear, std::vector<Point>& passages) const {
    for (int k = 0; k < points_around; ++k) {
        Point const p = off.centre + (off.radius + 0.001) / std::cos(step_around / 2) * unit((k + 0.5) * step_around);
        if (!cramped(p, kept_clear)) passages.push_back(p);
    }
}

// Adds a larger octagon, for longer paths with gentler bends.
void Planner::add_wide_passages(Disc const& off, std::span<Disc const> kept_clear, std::vector<Point>& passages) const {
    for (int k = 0; k < points_around; ++k) {
        Point const p = off.centre + (off.radius + wide_room) * unit(k * step_around);
        if (!cramped(p, kept_clear)) passages.push_back(p);
    }
}

// The points through which a path may be better than one of length `longest`.
std::vector<Point> Planner::passages_near(Point const& from, Point const& to, Metres longest, RoutingPolicy policy,
                                          std::span<Disc const> kept_clear) const {
    std::vector<Point> near = passages_;
    for (Disc const& disc : kept_clear) add_passages(disc, kept_clear, near);
    if (policy == RoutingPolicy::time) {
        near.insert(near.end(), wide_passages_.begin(), wide_passages_.end());
        for (Disc const& disc : kept_clear) add_wide_passages(disc, kept_clear, near);
    }
    auto const detour = [&](Point const& p) { return distance(from, p) + distance(p, to); };
    std::erase_if(near, [&](Point const& p) { return detour(p) >= longest || cramped(p, kept_clear); });
    std::ranges::stable_sort(near, {}, detour);
    if (near.size() > most_passages) near.resize(most_passages);
    return near;
}

// Returns the best path by the policy over the corners of `way` and over points around edges and obstacles.
std::vector<Point> Planner::improved(Pose const& from, std::vector<Point> way, RoutingPolicy policy,
                                     std::span<Disc const> kept_clear) const {
    if (way.size() < 2) return way;
    bool const by_time = policy == RoutingPolicy::time;
    double const cost = by_time ? duration(from, way, agility_) : length(from.position, way);
    Crossing crossing{from, way.back(), {way.begin(), way.end() - 1}};
    std::size_t const known = way.size();
    auto const further = passages_near(from.position, way.back(), by_time ? cost * agility_.speed : cost, policy, kept_clear);
    crossing.over.insert(crossing.over.end(), further.begin(), further.end());
    bool const leads_away = cramped(from.position, kept_clear);
    auto const point = [&](std::size_t i) -> Point const& {
        return i == 0 ? from.position : i <= crossing.over.size() ? crossing.over[i - 1] : crossing.to;
    };
    auto const can_go = [&](std::size_t a, std::size_t b) {
        bool const next =
            b == a + 1 ? b < known : a + 1 == known && b > crossing.over.size();  // whether this is a leg of the original path
        if (next) return true;
        return (!leads_away || a != 0) && straight(point(a), point(b), kept_clear);
    };
    auto better = best_legs(crossing, can_go, policy, agility_, cost);
    return better.empty() ? way : better;
}

// Removes corners that a straight line can bypass.
std::vector<Point> Planner::smoothed(Point const& from, std::vector<Point> const& corners,
                                     std::span<Disc const> kept_clear) const {
    std::vector<Point> way;
    Point at = from;
    std::size_t next = 0;
    if (cramped(from, kept_clear)) {  // first away from the wall or obstacle
        at = corners[next++];
        way.push_back(at);
    }
    while (next < corners.size()) {
        std::size_t farthest = next;
        for (std::size_t far = corners.size() - 1; far > next; --far) {
            if (!straight(at, corners[far], kept_clear)) continue;
            farthest = far;
            break;
        }
        at = corners[farthest];
        way.push_back(at);
        next = farthest + 1;
    }
    return way;
}

}  // namespace rois::simulation
