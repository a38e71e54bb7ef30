#include "choosing/simulator.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rois::choosing::stage {
namespace {

constexpr double dt = 0.02;             // seconds
constexpr double acceleration = 2.5;    // of walkers, in m/s^2
constexpr double least_distance = 0.5;  // between walkers, in metres
constexpr double beside = 0.7;          // metres between friends

}  // namespace

Simulator::Simulator(unsigned seed, double width, double depth) : random_{seed}, width_{width}, depth_{depth} {}

void Simulator::add_walkers(int count) {
    for (int i = 0; i < count; ++i) {
        Walker walker;
        walker.position = {uniform(0, width_), uniform(0, depth_)};
        walker.goal = walker.position;
        walkers.push_back(walker);
    }
}

void Simulator::add(SimulatedUnit unit) {
    unit.next = unit.delay;
    fusion.configure(unit.name, unit.settings);
    units.push_back(std::move(unit));
}

void Simulator::walk(Walker& walker, double) {
    if (walker.follows >= 0) {
        Walker const& friend_ = walkers[static_cast<std::size_t>(walker.follows)];
        Vector const along = friend_.velocity.norm() > 0.1 ? friend_.velocity.normalized() : Vector{1, 0};
        walker.goal = friend_.position + Vector{-along.y(), along.x()} * beside;
        walker.speed = 2;
        walker.pause = 0;
    }
    Vector const way = walker.goal - walker.position;
    Vector wanted = Vector::Zero();
    if (walker.pause > 0) {
        walker.pause -= dt;
    } else if (way.norm() < 0.05) {
        if (walker.follows < 0) {
            walker.pause = uniform(0, 6);
            walker.goal = {uniform(0, width_), uniform(0, depth_)};
            walker.speed = uniform(0.5, 2.0);
        }
    } else {
        double const brakes = std::sqrt(2 * acceleration * 0.7 * way.norm());
        wanted = way.normalized() * std::min(walker.speed, brakes);
    }
    Vector change = wanted - walker.velocity;
    if (change.norm() > acceleration * dt) change *= acceleration * dt / change.norm();
    walker.velocity += change;
    walker.position += walker.velocity * dt;
}

// Pushes overlapping walkers apart.
void Simulator::keep_apart() {
    for (Walker& a : walkers) {
        for (Walker& b : walkers) {
            Vector const difference = b.position - a.position;
            double const distance = difference.norm();
            if (&a == &b || distance >= least_distance || distance < 1e-6) continue;
            Vector const push = difference * (std::min(least_distance - distance, 0.01) / 2 / distance);
            a.position -= push;
            b.position += push;
        }
    }
}

void Simulator::sense(SimulatedUnit& unit) {
    std::map<int, Vector> seen;
    bool news = unit.reports_from <= 0;
    for (int i = 0; i < static_cast<int>(walkers.size()); ++i) {
        Vector const position = walkers[static_cast<std::size_t>(i)].position;
        if (!unit.sees(position)) {
            news |= unit.names.erase(i) > 0;
            continue;
        }
        if (uniform(0, 1) < unit.drops) continue;
        if (!unit.names.contains(i)) unit.names[i] = unit.prefix + std::to_string(++unit.named);
        Vector const arm = position - unit.place;
        Vector const measured = Eigen::Rotation2Dd{unit.turned} * arm + unit.place + unit.shifted + unit.bias +
                                Vector{gaussian(unit.noise), gaussian(unit.noise)};
        news |= !unit.measured.contains(i) || (measured - unit.measured[i]).norm() > unit.reports_from;
        seen[i] = measured;
    }
    if (!news) return;
    unit.measured = seen;
    unit.listed_at = time;
    std::vector<Sighting> list;
    list.reserve(seen.size());
    for (auto const& [i, measured] : seen)
        list.push_back({unit.names[i], measured, {}, Matrix{Matrix::Identity() * unit.claimed * unit.claimed}});
    fusion.sensed(unit.name, when(), list);
}

void Simulator::run(double seconds, std::function<void()> const& look) {
    int const steps = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < steps; ++i) {
        time += dt;
        for (Walker& walker : walkers) walk(walker, dt);
        keep_apart();
        for (SimulatedUnit& unit : units) {
            if (!unit.works || time + 1e-9 < unit.next) continue;
            unit.next += unit.period * uniform(1 - unit.jitter, 1 + unit.jitter);
            sense(unit);
        }
        fusion.advance(when());
        if (i % 5 == 4) look();
    }
}

std::optional<std::string> Simulator::name_of(int walker) const {
    for (SimulatedUnit const& unit : units) {
        auto const name = unit.names.find(walker);
        if (name == unit.names.end()) continue;
        if (auto own = fusion.own_name(unit.name, name->second)) return own;
    }
    return {};
}

std::map<std::string, FusedPerson> Simulator::fused() const {
    std::map<std::string, FusedPerson> all;
    for (FusedPerson const& person : fusion.persons(when())) all.emplace(person.name, person);
    return all;
}

}  // namespace rois::choosing::stage
