#include "conformance/driver.hpp"

#include <algorithm>
#include <cmath>

namespace rois::conformance {

namespace {

constexpr milliseconds pause{300};

Client& with_bound(Client& client, Component const& component) {
    client.bind_or_skip(component);
    return client;
}

}  // namespace

Driver::Driver(Context& where, Component const& component)
    : context{where},
      mover{component},
      client{where},
      observer{with_bound(client, component), component},
      home{observer.observe()} {
    constexpr double margin = 1.4;
    auto const needed = margin * tolerance(home, context.room());
    if (needed > context.room())
        throw NotObservable{"the reported position of the robot of " + mover.ref + " has a standard deviation of " +
                            std::to_string(home.sigma) + " mm: a motion is observable with --room above " +
                            std::to_string(std::lround(needed))};
}

// Stops the robot. Returns it to its starting point if the engine has a navigation component.
Driver::~Driver() {
    try {
        client.run(command(mover, "stop"));
        if (distance(observer.observe().at, home.at) <= tolerance(home, 0)) return;
        for (auto const& component : context.catalogue().components) {
            if (component.basic() != "navigation" || component.engine != mover.engine) continue;
            if (component.ref != mover.ref) client.bind_or_skip(component);
            Command const back{.component = component.ref,
                               .arguments = {argument(component, "target_position", {text_of(home.at)})}};
            observe_command(context, client, observer, client.execute_one(back));
            return;
        }
    } catch (std::exception const&) {
        // The robot stays: the check has reported the error, or another application has bound the navigation.
    }
}

Trip Driver::run(std::vector<Argument> arguments, std::function<bool(RobotPosition const&)> const& is_enough) {
    last_command = client.execute_one({.component = mover.ref, .arguments = std::move(arguments)});
    auto trip = observe_command(context, client, observer, last_command, is_enough);
    if (trip.status == "OUT_OF_RESOURCES") throw Skipped{"another application uses a resource that " + mover.ref + " needs"};
    return trip;
}

Trip Driver::start_moving(std::vector<Argument> arguments) {
    constexpr double least = 30;
    auto const from = observer.observe();
    return run(std::move(arguments), [=](RobotPosition const& observed) {
        return distance(from.at, observed.at) > std::max(least, 3 * observed.sigma);
    });
}

std::vector<Point> Driver::destinations() const {
    std::vector<double> directions{30, 150, 210, 330};
    std::ranges::sort(directions, {}, [&](double way) { return std::abs(turn(home.at.heading.value_or(0), way)); });
    std::vector<Point> points;
    for (auto const way : directions) points.push_back(ahead(home.at, context.room(), way));
    return points;
}

void Driver::require_at(Point const& place) const {
    auto const is_there = [&](RobotPosition const& observed) {
        return distance(observed.at, place) <= tolerance(observed, context.room()) &&
               (!place.heading || !observed.at.heading ||
                std::abs(turn(*place.heading, *observed.at.heading)) <= heading_tolerance(observed));
    };
    auto const observed = observer.observe_until(is_there);
    require(is_there(observed), "expected the robot at " + text_of(place) + ", reported at " + text_of(observed));
    wait(pause);
    auto const later = observer.observe();
    require(is_there(later),
            "the robot moved from " + text_of(observed) + " to " + text_of(later) + " after the command had completed");
    require(later.timestamp != home.timestamp,
            "robot_position: expected a new timestamp after the motion, got " + home.timestamp + " as before");
}

void Driver::require_rest(std::string const& when) const {
    constexpr milliseconds long_enough{1'000};  // even a robot that has just started moves visibly in this time
    wait(pause);
    auto const before = observer.observe();
    wait(long_enough);
    auto const after = observer.observe();
    require(distance(before.at, after.at) <= noise(after),
            "the robot still moves " + when + ": from " + text_of(before) + " to " + text_of(after));
}

std::string text_of(RobotPosition const& observed) {
    return text_of(observed.at) + " (standard deviation " + std::to_string(std::lround(observed.sigma)) + " mm)";
}

}  // namespace rois::conformance
