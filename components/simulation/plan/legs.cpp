#include "simulation/plan/legs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>

namespace rois::simulation {
namespace {

// A* over legs, not points: the cost of a corner depends on the legs before and after it.
class Search {
public:
    Search(Crossing const& crossing, CanGo const& can_go, RoutingPolicy policy, Agility const& agility, double bound)
        : can_go_(can_go),
          by_time_(policy == RoutingPolicy::time),
          agility_(agility),
          bound_(bound),
          heading_(crossing.from.heading),
          points_{crossing.from.position},
          slack_(by_time_ ? turn_duration(std::numbers::pi, agility) + agility.speed / agility.acceleration : 0) {
        points_.insert(points_.end(), crossing.over.begin(), crossing.over.end());
        points_.push_back(crossing.to);
        best_of_leg_.assign(points_.size() * points_.size(), std::numeric_limits<double>::infinity());
        best_of_point_.assign(points_.size(), std::numeric_limits<double>::infinity());
        passable_.assign(points_.size() * points_.size(), Passable::unknown);
    }

    std::vector<Point> run() {
        for (std::uint32_t point = 1; point < points_.size(); ++point) begin(point);
        while (!open_.empty()) {
            auto const [estimate, label] = open_.top();
            open_.pop();
            if (legs_[label].to == goal()) return back_from(label);
            if (legs_[label].cost <= best_of_leg_[index(legs_[label].from, legs_[label].to)]) expand(label);
        }
        return {};
    }

private:
    enum class Passable : std::uint8_t { unknown, yes, no };
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Leg {
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t before;   // the previous leg
        double cost;            // of all previous legs and of the turn into this one
        MetresPerSecond speed;  // at its start
    };
    struct Entry {
        double estimate;
        std::uint32_t leg;
        bool operator<(Entry const& other) const {  // makes the smallest the top of the queue
            return estimate != other.estimate ? estimate > other.estimate : leg > other.leg;
        }
    };

    std::uint32_t goal() const { return static_cast<std::uint32_t>(points_.size() - 1); }
    std::size_t index(std::uint32_t from, std::uint32_t to) const { return from * points_.size() + to; }

    double least(Metres way) const { return by_time_ ? way / agility_.speed : way; }

    double cost_of(Leg const& leg, MetresPerSecond at_end) const {
        Metres const way = distance(points_[leg.from], points_[leg.to]);
        return by_time_ ? leg_duration(way, leg.speed, at_end, agility_) : way;
    }

    bool passable(std::uint32_t from, std::uint32_t to) {
        Passable& known = passable_[index(from, to)];
        if (known == Passable::unknown) known = can_go_(from, to) ? Passable::yes : Passable::no;
        return known == Passable::yes;
    }

    void begin(std::uint32_t point) {
        Radians const turn = wrapped(direction(points_[0], points_[point]) - heading_);
        offer({0, point, none, by_time_ ? turn_duration(turn, agility_) : 0, 0});
    }

    void expand(std::uint32_t label) {
        Leg const leg = legs_[label];
        Radians const ahead = direction(points_[leg.from], points_[leg.to]);
        for (std::uint32_t next = 1; next < points_.size(); ++next) {
            if (next == leg.from || next == leg.to) continue;
            Radians const turn = by_time_ ? std::abs(wrapped(direction(points_[leg.to], points_[next]) - ahead)) : 0;
            MetresPerSecond const speed = by_time_ ? passing_speed(turn, agility_) : 0;
            offer({leg.to, next, label, leg.cost + cost_of(leg, speed) + corner_duration(turn, agility_), speed});
        }
    }

    // Adds a leg to the search, unless it cannot improve the result.
    void offer(Leg const& leg) {
        Metres const way = distance(points_[leg.from], points_[leg.to]);
        double const arrival = leg.cost + least(way);
        double const stopped = leg.cost + cost_of(leg, 0);
        double const estimate = leg.to == goal() ? stopped : arrival + least(distance(points_[leg.to], points_[goal()]));
        if (estimate >= bound_ || leg.cost >= best_of_leg_[index(leg.from, leg.to)]) return;
        if (arrival > best_of_point_[leg.to] + slack_ || !passable(leg.from, leg.to)) return;
        best_of_leg_[index(leg.from, leg.to)] = leg.cost;
        best_of_point_[leg.to] = std::min(best_of_point_[leg.to], stopped);
        if (leg.to == goal()) bound_ = estimate;
        open_.push({estimate, static_cast<std::uint32_t>(legs_.size())});
        legs_.push_back(leg);
    }

    std::vector<Point> back_from(std::uint32_t label) const {
        std::vector<Point> way;
        for (; label != none; label = legs_[label].before) way.push_back(points_[legs_[label].to]);
        std::ranges::reverse(way);
        return way;
    }

    CanGo const& can_go_;
    bool by_time_;
    Agility agility_;
    double bound_;
    Radians heading_;
    std::vector<Point> points_;
    double slack_;  // maximum extra cost of stopping at a point
    std::vector<double> best_of_leg_;
    std::vector<double> best_of_point_;  // with a stop there
    std::vector<Passable> passable_;
    std::vector<Leg> legs_;
    std::priority_queue<Entry> open_;
};

}  // namespace

std::vector<Point> best_legs(Crossing const& crossing, CanGo const& can_go, RoutingPolicy policy, Agility const& agility,
                             double bound) {
    return Search{crossing, can_go, policy, agility, bound}.run();
}

}  // namespace rois::simulation
