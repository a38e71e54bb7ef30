// A small world for tests of the fusion: persons who walk in a hall, and units that sense them with errors. A seed gives one
// history.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "choosing/fusion/fusion.hpp"

namespace rois::choosing::stage {

constexpr Steady after(double seconds) {
    return Steady{std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>{seconds})};
}

// Walks between random places at up to 2 m/s, and stands in between.
struct Walker {
    Vector position = Vector::Zero();
    Vector velocity = Vector::Zero();
    Vector goal = Vector::Zero();
    double speed = 1;
    double pause = 0;  // seconds
    int follows = -1;  // walks beside this person; -1: alone
};

struct SimulatedUnit {
    std::string name;
    std::function<bool(Vector const&)> sees = [](Vector const&) { return true; };
    double period = 0.1;              // seconds
    double jitter = 0;                // of the period, as a part of it
    double noise = 0.05;              // metres; independent from list to list
    Vector bias = Vector::Zero();     // always the same error
    double claimed = 0.05;            // standard deviation that the unit gives, in metres
    Vector place = Vector::Zero();    // of the unit
    double turned = 0;                // wrong placement: radians around its place
    Vector shifted = Vector::Zero();  // wrong placement
    double reports_from = 0;          // metres; a list is sent only if somebody has moved so far; 0: always
    double delay = 0;                 // seconds until the first list
    std::string prefix = "person-";   // of its names
    double drops = 0;                 // probability that a person is missing for one list
    UnitSettings settings{};
    bool works = true;

    std::map<int, std::string> names{};  // of the persons whom it sees
    std::map<int, Vector> measured{};    // its last list
    double listed_at = -1;               // time of its last list
    int named = 0;
    double next = 0;
};

class Simulator {
public:
    explicit Simulator(unsigned seed, double width = 12, double depth = 10);

    void add_walkers(int count);
    void add(SimulatedUnit unit);

    // Runs for some seconds. Calls `look` ten times per second.
    void run(
        double seconds, std::function<void()> const& look = [] {});

    Steady when() const { return after(time); }
    std::optional<std::string> name_of(int walker) const;  // that any unit's name leads to
    std::map<std::string, FusedPerson> fused() const;

    double time = 0;
    std::vector<Walker> walkers;
    std::vector<SimulatedUnit> units;
    Fusion fusion;

private:
    double uniform(double from, double to) { return std::uniform_real_distribution<double>{from, to}(random_); }
    double gaussian(double sigma) { return sigma > 0 ? std::normal_distribution<double>{0, sigma}(random_) : 0; }
    void walk(Walker&, double dt);
    void keep_apart();
    void sense(SimulatedUnit&);

    std::mt19937 random_;
    double width_;
    double depth_;
};

}  // namespace rois::choosing::stage
