#include "conformance/driver.hpp"

#include <algorithm>
#include <cmath>

namespace rois::conformance {

namespace {

constexpr milliseconds a_moment{300};

Guest& taken(Guest& guest, Component const& component) {
    guest.take(component);
    return guest;
}

}  // namespace

Driver::Driver(Stage& where, Component const& component)
    : stage{where}, wheels{component}, guest{where}, eye{taken(guest, component), component}, home{eye.look()} {
    constexpr double clearly = 1.4;
    auto const needed = clearly * tolerance(home, stage.room());
    if (needed > stage.room())
        throw NotObservable{"the position of the robot of " + wheels.ref + " is known to " + std::to_string(home.sigma) +
                            " mm: to see it move, it needs more than --room " + std::to_string(std::lround(needed))};
}

// Stops it first, whatever it does, and goes home if there is a navigation.
Driver::~Driver() {
    try {
        guest.ending(command(wheels, "stop"));
        if (distance(eye.look().at, home.at) <= tolerance(home, 0)) return;
        for (auto const& component : stage.catalogue().components) {
            if (component.basic() != "navigation" || component.engine != wheels.engine) continue;
            if (component.ref != wheels.ref) guest.take(component);
            Command const back{.component = component.ref,
                               .arguments = {argument(component, "target_position", {text_of(home.at)})}};
            watch(stage, guest, eye, guest.order(back));
            return;
        }
    } catch (std::exception const&) {
        // The robot stays: the check has reported the error, or another application has bound the navigation.
    }
}

Trip Driver::go(std::vector<Argument> arguments, std::function<bool(Sighting const&)> const& enough) {
    ordered = guest.order({.component = wheels.ref, .arguments = std::move(arguments)});
    auto trip = watch(stage, guest, eye, ordered, enough);
    if (trip.status == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses what " + wheels.ref + " needs"};
    return trip;
}

Trip Driver::set_off(std::vector<Argument> arguments) {
    constexpr double least = 30;
    auto const from = eye.look();
    return go(std::move(arguments),
              [=](Sighting const& seen) { return distance(from.at, seen.at) > std::max(least, 3 * seen.sigma); });
}

std::vector<Point> Driver::destinations() const {
    std::vector<double> directions{30, 150, 210, 330};
    std::ranges::sort(directions, {}, [&](double way) { return std::abs(turn(home.at.heading.value_or(0), way)); });
    std::vector<Point> points;
    for (auto const way : directions) points.push_back(ahead(home.at, stage.room(), way));
    return points;
}

void Driver::require_at(Point const& place) const {
    auto const is_there = [&](Sighting const& seen) {
        return distance(seen.at, place) <= tolerance(seen, stage.room()) &&
               (!place.heading || !seen.at.heading ||
                std::abs(turn(*place.heading, *seen.at.heading)) <= heading_tolerance(seen));
    };
    auto const seen = eye.look_until(is_there);
    require(is_there(seen), "the robot should be at " + text_of(place) + ", and is reported at " + shown(seen));
    wait(a_moment);
    auto const later = eye.look();
    require(is_there(later),
            "the robot was at " + shown(seen) + " and has moved on to " + shown(later) + ", though the command had completed");
    require(later.timestamp != home.timestamp, "a later position has the timestamp of an earlier one, " + home.timestamp);
}

void Driver::require_rest(std::string const& when) const {
    constexpr milliseconds long_enough{1'000};  // for a robot that has just set off, too
    wait(a_moment);
    auto const before = eye.look();
    wait(long_enough);
    auto const after = eye.look();
    require(distance(before.at, after.at) <= noise(after),
            "the robot moves on " + when + ": from " + shown(before) + " to " + shown(after));
}

std::string shown(Sighting const& sighting) {
    return text_of(sighting.at) + " (standard deviation " + std::to_string(std::lround(sighting.sigma)) + " mm)";
}

}  // namespace rois::conformance
