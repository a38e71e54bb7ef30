// The effects of navigation and move on the robot, as robot_position reports them (tables 32, 34 and 46; 7.6.15; decisions 8, 9
// and 27).
#include <algorithm>
#include <cmath>

#include "conformance/driver.hpp"

namespace rois::conformance {

namespace {

Component const& navigation_of(Stage& stage) { return stage.one_of({"navigation"}); }
Component const& move_of(Stage& stage) { return stage.one_of({"move"}); }

Argument to(Driver const& driver, std::vector<Point> const& places) {
    std::vector<std::string> texts;
    for (auto const& place : places) texts.push_back(text_of(place));
    return argument(driver.wheels, "target_position", texts);
}

// Plays with each destination until the robot finds a way to one. `play` returns false when it found none.
template <typename Play>
void with_a_destination(Driver& driver, Play const& play) {
    for (auto const& destination : driver.destinations())
        if (play(destination)) return;
    throw NotObservable{"navigation finds no way of " + std::to_string(std::lround(driver.stage.room())) +
                        " mm in any of four directions"};
}

void navigation_reaches_its_target(Stage& stage) {
    constexpr double turned = 60;  // degrees
    Driver driver{stage, navigation_of(stage)};
    with_a_destination(driver, [&](Point target) {
        if (target.heading) *target.heading += turned;
        auto const trip = driver.go({to(driver, {target})});
        if (trip.status == "ERROR") return false;
        same("the status of a way of " + text_of(driver.home.at) + " to " + text_of(target), "OK", trip.status);
        driver.require_at(target);
        return true;
    });
}

void targets_are_visited_in_order(Stage& stage) {
    Driver driver{stage, navigation_of(stage)};
    with_a_destination(driver, [&](Point const& target) {
        auto const trip = driver.go({to(driver, {target, driver.home.at})});
        if (trip.status == "ERROR") return false;
        same("the status of a way of two targets", "OK", trip.status);
        require(std::ranges::any_of(
                    trip.way, [&](Sighting const& seen) { return distance(seen.at, target) <= tolerance(seen, stage.room()); }),
                "the robot was never seen at the first of two targets, " + text_of(target));
        driver.require_at(driver.home.at);
        return true;
    });
}

void require_target(Document const& event, Point const& due, bool is_last) {
    auto const text = value_of(event.values(), "target");
    auto const told = point_in(text);
    require(!told || distance(*told, due) < 1, "the target that was reached is " + text_of(due) + ", and is reported as " + text);
    auto const is_final = value_of(event.values(), "is_final_target");
    require(is_last == (is_final == "true" || is_final == "1"), "is_final_target of " + text + " is " + is_final);
}

void each_reached_target_is_reported(Stage& stage) {
    std::string const event = "reached_target";
    auto const& navigation = navigation_of(stage);
    if (!navigation.event(event)) throw NotObservable{navigation.ref + " has no event " + event};
    Driver driver{stage, navigation};
    ok(driver.guest.subscribe(event, only(navigation), true));
    with_a_destination(driver, [&](Point const& target) {
        std::vector<Point> const targets{target, driver.home.at};
        auto const before = driver.guest.history().size();
        if (driver.go({to(driver, targets)}).status != "OK") return false;
        std::vector<Document> told;  // before the command completed
        for (auto at = before; driver.guest.history()[at].text("command_id") != driver.ordered; ++at)
            if (driver.guest.history()[at].text("event_type") == event) told.push_back(driver.guest.history()[at]);
        require(told.size() == targets.size(),
                "two targets should be reported by two events before the command completes, but are by " +
                    std::to_string(told.size()));
        for (std::size_t i = 0; i < told.size(); ++i) require_target(told[i], targets[i], i + 1 == told.size());
        return true;
    });
}

void navigation_gives_up_at_its_time_limit(Stage& stage) {
    auto const& navigation = navigation_of(stage);
    auto const limit = argument(navigation, "time_limit", {"1"});
    Driver driver{stage, navigation};
    with_a_destination(driver, [&](Point const& target) {
        auto const trip = driver.go({to(driver, {target}), limit});
        if (trip.status == "ERROR") return false;
        same("the status of a way of " + std::to_string(std::lround(stage.room())) + " mm with a time_limit of 1 ms", "TIMEOUT",
             trip.status);
        driver.require_rest("after its time_limit");
        require(distance(driver.eye.look().at, target) > noise(trip.end), "the robot went on to its target after its time_limit");
        return true;
    });
}

// Whether the robot is on its way to `target` now; false when there is no way.
bool is_on_its_way(Driver& driver, Point const& target) {
    auto const trip = driver.set_off({to(driver, {target})});
    if (trip.status == "ERROR") return false;
    if (!trip.status.empty()) throw NotObservable{"the robot arrived before it was seen on its way"};
    return true;
}

// By `stop` or `suspend`. After it, a robot may roll on for a part of its way. Returns where it was seen right after that.
Sighting halt(Driver& driver, std::string const& type, Point const& target) {
    constexpr double braking = 0.4;
    auto const status = driver.guest.ending(command(driver.wheels, type));
    if (driver.guest.endings(driver.ordered) == std::vector<std::string>{"OK"})
        throw NotObservable{"the robot arrived before it could be halted"};
    same("the status of " + type, "OK", status);
    auto const seen = driver.eye.look();
    if (distance(seen.at, target) <= noise(seen) + braking * driver.stage.room())
        throw NotObservable{"the robot was almost at its target before it could be halted"};
    return seen;
}

// For a robot that rests at its target though it was halted at `at_halt`. It needs no longer way to brake than it has had to get
// up to speed.
void blame_for_arrival(Driver const& driver, Point const& target, Sighting const& at_halt) {
    constexpr double margin = 1.2;
    if (distance(at_halt.at, target) <= distance(driver.home.at, at_halt.at) + margin * noise(driver.home))
        throw NotObservable{"the robot was halted so late that it may have rolled on to its target"};
    throw Broken{"the robot went on to its target after stop"};
}

// Reports lag behind, so that a robot may be nearer to its target than it seems when it is halted. It is halted again then.
void stop_halts_the_robot(Stage& stage) {
    constexpr int attempts = 3;
    Driver driver{stage, navigation_of(stage)};
    with_a_destination(driver, [&](Point const& target) {
        for (int attempt = 1;; ++attempt) {
            if (!is_on_its_way(driver, target)) return false;
            auto const at_halt = halt(driver, "stop", target);
            driver.guest.settle(driver.wheels);
            auto const endings = driver.guest.endings(driver.ordered);
            require(endings == std::vector<std::string>{"ABORT"},
                    "start should complete with ABORT, and did with " + list(endings));
            driver.require_rest("after stop");
            if (distance(driver.eye.look().at, target) > noise(driver.home)) return true;
            if (attempt == attempts) blame_for_arrival(driver, target, at_halt);
            driver.go({to(driver, {driver.home.at})});
        }
    });
}

void suspend_halts_the_robot_and_resume_drives_on(Stage& stage) {
    Driver driver{stage, navigation_of(stage)};
    with_a_destination(driver, [&](Point const& target) {
        if (!is_on_its_way(driver, target)) return false;
        halt(driver, "suspend", target);
        driver.require_rest("after suspend");
        same("the state of a suspended command", "RUNNING", driver.guest.state_of(driver.ordered));
        if (distance(driver.eye.look().at, target) <= noise(driver.home))
            throw NotObservable{"the robot was suspended too near its target"};
        same("the status of resume", "OK", driver.guest.ending(command(driver.wheels, "resume")));
        same("the status of the way after resume", "OK", watch(stage, driver.guest, driver.eye, driver.ordered).status);
        driver.require_at(target);
        return true;
    });
}

// --- Move ---

int rounded(double number) { return static_cast<int>(std::lround(number)); }

Argument numbers(Driver const& driver, std::string const& name, int first, int second) {
    return argument(driver.wheels, name, {std::to_string(first) + " " + std::to_string(second)});
}

// Drives ahead, or backwards when something is in the way ahead. `play` gets 1 or -1, and returns false when something is in the
// way.
template <typename Play>
void ahead_or_back(Play const& play) {
    for (int const sign : {1, -1})
        if (play(sign)) return;
    throw NotObservable{"move finds no room ahead or behind"};
}

double heading_of(Driver const& driver) {
    if (!driver.home.at.heading) throw NotObservable{"no heading of the robot is reported"};
    return *driver.home.at.heading;
}

void move_drives_its_line(Stage& stage) {
    Driver driver{stage, move_of(stage)};
    ahead_or_back([&](int sign) {
        auto const trip = driver.go({numbers(driver, "line", rounded(sign * stage.room()), 0)});
        if (trip.status == "ERROR") return false;
        same("the status of a line", "OK", trip.status);
        driver.require_at(ahead(driver.home.at, sign * stage.room(), heading_of(driver)));
        return true;
    });
}

// Along the line and then to the left, or to the left along the line: tables leave both open.
void move_minds_its_direction(Stage& stage) {
    constexpr int left = 90;
    Driver driver{stage, move_of(stage)};
    auto const begin = heading_of(driver);
    ahead_or_back([&](int sign) {
        auto const trip = driver.go({numbers(driver, "line", rounded(sign * stage.room()), left)});
        if (trip.status == "ERROR") return false;
        same("the status of a line", "OK", trip.status);
        auto const is_done = [&](Sighting const& seen) {
            bool const has_turned = std::abs(turn(begin + left, seen.at.heading.value_or(begin))) <= heading_tolerance(seen);
            auto const aside = ahead(driver.home.at, sign * stage.room(), begin + left);
            auto const along = ahead(driver.home.at, sign * stage.room(), begin);
            auto const most = tolerance(seen, stage.room());
            return distance(seen.at, aside) <= most || (has_turned && distance(seen.at, along) <= most);
        };
        auto const seen = driver.eye.look_until(is_done);
        require(is_done(seen), "a line of " + std::to_string(rounded(sign * stage.room())) +
                                   " mm and 90 degrees to the left led from " + shown(driver.home) + " to " + shown(seen));
        return true;
    });
}

void move_drives_its_curve(Stage& stage) {
    constexpr int left = 90;
    constexpr double of_room = 0.7;  // the robot ends 1.4 radii from where it began
    Driver driver{stage, move_of(stage)};
    auto const begin = heading_of(driver);
    auto const radius = rounded(of_room * stage.room());
    ahead_or_back([&](int sign) {
        auto const trip = driver.go({numbers(driver, "curve", sign * radius, left)});
        if (trip.status == "ERROR") return false;
        same("the status of a curve", "OK", trip.status);
        // A circle to the left, or backwards along the circle on the other side: the heading turns to the left in both.
        auto end = ahead(ahead(driver.home.at, sign * radius, begin), sign * radius, begin + left);
        end.heading = begin + left;
        driver.require_at(end);
        return true;
    });
}

void move_takes_its_time(Stage& stage) {
    auto const& move = move_of(stage);
    argument(move, "time", {"0"});  // NotPlayed when there is none
    Driver driver{stage, move};
    int sign = 1;
    auto const drive = [&](int time) {
        auto arguments = std::vector{numbers(driver, "line", rounded(sign * stage.room()), 0)};
        sign = -sign;
        if (time > 0) arguments.push_back(argument(move, "time", {std::to_string(time)}));
        auto const trip = driver.go(std::move(arguments));
        if (trip.status != "OK") throw NotObservable{"move has no room: a line ended with " + trip.status};
        return trip.took;
    };
    auto const once = drive(0);
    auto const usual = std::min(once, drive(0));
    constexpr double clearly = 1.5;
    constexpr int longest = 32'000;
    for (int time = 2'000; time <= longest; time *= 2)
        if (drive(time) > clearly * usual) return;
    throw Broken{"a line takes " + std::to_string(usual.count()) + " ms without `time`, and hardly longer with a time of " +
                 std::to_string(longest) + " ms"};
}

}  // namespace

Clause motion_clause() {
    return {"Effects: motion",
            {{"navigation_reaches_its_target", "tables 34, 46; decisions 8, 27", navigation_reaches_its_target},
             {"targets_are_visited_in_order", "tables 34, 46", targets_are_visited_in_order},
             {"each_reached_target_is_reported", "table 46; decision 8", each_reached_target_is_reported},
             {"navigation_gives_up_at_its_time_limit", "tables 8, 46; decisions 8, 16", navigation_gives_up_at_its_time_limit},
             {"stop_halts_the_robot", "tables 8, 32, 34; decision 9", stop_halts_the_robot},
             {"suspend_halts_the_robot_and_resume_drives_on", "tables 32, 34; decision 9",
              suspend_halts_the_robot_and_resume_drives_on},
             {"move_drives_its_line", "7.6.15; table 34; decision 27", move_drives_its_line},
             {"move_minds_its_direction", "7.6.15; table 34; decision 27", move_minds_its_direction},
             {"move_drives_its_curve", "7.6.15; table 34; decision 27", move_drives_its_curve},
             {"move_takes_its_time", "7.6.15", move_takes_its_time}}};
}

}  // namespace rois::conformance
