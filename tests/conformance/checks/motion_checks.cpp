// The effects of navigation and move on the robot, as robot_position reports them (tables 32, 34 and 46; 7.6.15; decisions 8, 9
// and 27).
#include <algorithm>
#include <cmath>

#include "conformance/driver.hpp"

namespace rois::conformance {

namespace {

Component const& navigation_of(Context& context) { return context.component_of_kind({"navigation"}); }
Component const& move_of(Context& context) { return context.component_of_kind({"move"}); }

Argument to(Driver const& driver, std::vector<Point> const& places) {
    std::vector<std::string> texts;
    for (auto const& place : places) texts.push_back(text_of(place));
    return argument(driver.mover, "target_position", texts);
}

// Calls `run` with each destination until the robot finds a path to one. `run` returns false if the robot finds none.
template <typename Run>
void with_a_destination(Driver& driver, Run const& run) {
    for (auto const& destination : driver.destinations())
        if (run(destination)) return;
    throw NotObservable{"navigation finds no free path of " + std::to_string(std::lround(driver.context.room())) +
                        " mm in any of four directions"};
}

void navigation_reaches_its_target(Context& context) {
    constexpr double turned = 60;  // degrees
    Driver driver{context, navigation_of(context)};
    with_a_destination(driver, [&](Point target) {
        if (target.heading) *target.heading += turned;
        auto const trip = driver.run({to(driver, {target})});
        if (trip.status == "ERROR") return false;
        require_equal("the status of a navigation from " + text_of(driver.home.at) + " to " + text_of(target), "OK", trip.status);
        driver.require_at(target);
        return true;
    });
}

void targets_are_visited_in_order(Context& context) {
    Driver driver{context, navigation_of(context)};
    with_a_destination(driver, [&](Point const& target) {
        auto const trip = driver.run({to(driver, {target, driver.home.at})});
        if (trip.status == "ERROR") return false;
        require_equal("the status of a navigation to two targets", "OK", trip.status);
        require(std::ranges::any_of(trip.path,
                                    [&](RobotPosition const& observed) {
                                        return distance(observed.at, target) <= tolerance(observed, context.room());
                                    }),
                "expected the robot to pass the first of two targets, " + text_of(target));
        driver.require_at(driver.home.at);
        return true;
    });
}

void require_target(Document const& event, Point const& expected, bool is_last) {
    auto const text = value_of(event.values(), "target");
    auto const reported = point_in(text);
    require(!reported || distance(*reported, expected) < 1,
            "reached_target: expected the target " + text_of(expected) + ", got " + text);
    auto const is_final = value_of(event.values(), "is_final_target");
    require(is_last == (is_final == "true" || is_final == "1"), "reached_target: expected is_final_target " +
                                                                    std::string{is_last ? "true" : "false"} + " for " + text +
                                                                    ", got " + is_final);
}

void each_reached_target_is_reported(Context& context) {
    std::string const event = "reached_target";
    auto const& navigation = navigation_of(context);
    if (!navigation.event(event)) throw NotObservable{navigation.ref + " has no event " + event};
    Driver driver{context, navigation};
    require_ok(driver.client.subscribe(event, only(navigation), true));
    with_a_destination(driver, [&](Point const& target) {
        std::vector<Point> const targets{target, driver.home.at};
        auto const before = driver.client.history().size();
        if (driver.run({to(driver, targets)}).status != "OK") return false;
        std::vector<Document> reported;  // the events before the command completed
        for (auto at = before; driver.client.history()[at].text("command_id") != driver.last_command; ++at)
            if (driver.client.history()[at].text("event_type") == event) reported.push_back(driver.client.history()[at]);
        require(reported.size() == targets.size(),
                "expected two reached_target events before the command completes, got " + std::to_string(reported.size()));
        for (std::size_t i = 0; i < reported.size(); ++i) require_target(reported[i], targets[i], i + 1 == reported.size());
        return true;
    });
}

void navigation_stops_at_its_time_limit(Context& context) {
    auto const& navigation = navigation_of(context);
    auto const limit = argument(navigation, "time_limit", {"1"});
    Driver driver{context, navigation};
    with_a_destination(driver, [&](Point const& target) {
        auto const trip = driver.run({to(driver, {target}), limit});
        if (trip.status == "ERROR") return false;
        require_equal(
            "the status of a navigation of " + std::to_string(std::lround(context.room())) + " mm with a time_limit of 1 ms",
            "TIMEOUT", trip.status);
        driver.require_rest("after its time_limit");
        require(distance(driver.observer.observe().at, target) > noise(trip.end),
                "the robot drove to its target after the time_limit");
        return true;
    });
}

// Starts a navigation, and waits until the robot moves. Returns false if the robot finds no path.
bool is_moving_to(Driver& driver, Point const& target) {
    auto const trip = driver.start_moving({to(driver, {target})});
    if (trip.status == "ERROR") return false;
    if (!trip.status.empty()) throw NotObservable{"the robot arrived before its motion was observed"};
    return true;
}

// Halts the robot by `stop` or `suspend`, and returns its position right after that. The robot needs a braking distance. Throws
// NotObservable if the robot was too near its target.
RobotPosition halt(Driver& driver, std::string const& type, Point const& target) {
    constexpr double braking = 0.4;
    auto const status = driver.client.run(command(driver.mover, type));
    if (driver.client.completion_statuses(driver.last_command) == std::vector<std::string>{"OK"})
        throw NotObservable{"the robot arrived before " + type};
    require_equal("the status of " + type, "OK", status);
    auto const observed = driver.observer.observe();
    if (distance(observed.at, target) <= noise(observed) + braking * driver.context.room())
        throw NotObservable{"the robot was almost at its target before " + type};
    return observed;
}

// Reports a robot that is at its target though it was halted at `at_halt`. The braking distance is at most the distance of
// acceleration. Throws NotObservable if the robot may have braked at its target.
void report_arrival(Driver const& driver, Point const& target, RobotPosition const& at_halt) {
    constexpr double margin = 1.2;
    if (distance(at_halt.at, target) <= distance(driver.home.at, at_halt.at) + margin * noise(driver.home))
        throw NotObservable{"the robot was halted within its braking distance of the target"};
    throw Broken{"the robot drove to its target after stop"};
}

// Reports lag: the robot may be nearer to its target than reported. If it reaches the target after `stop`, the check halts it
// again.
void stop_halts_the_robot(Context& context) {
    constexpr int attempts = 3;
    Driver driver{context, navigation_of(context)};
    with_a_destination(driver, [&](Point const& target) {
        for (int attempt = 1;; ++attempt) {
            if (!is_moving_to(driver, target)) return false;
            auto const at_halt = halt(driver, "stop", target);
            driver.client.flush_notifications(driver.mover);
            auto const completion_statuses = driver.client.completion_statuses(driver.last_command);
            require(completion_statuses == std::vector<std::string>{"ABORT"},
                    "expected a stopped start to complete once with ABORT, got " + list(completion_statuses));
            driver.require_rest("after stop");
            if (distance(driver.observer.observe().at, target) > noise(driver.home)) return true;
            if (attempt == attempts) report_arrival(driver, target, at_halt);
            driver.run({to(driver, {driver.home.at})});
        }
    });
}

void suspend_halts_the_robot_and_resume_continues(Context& context) {
    Driver driver{context, navigation_of(context)};
    with_a_destination(driver, [&](Point const& target) {
        if (!is_moving_to(driver, target)) return false;
        halt(driver, "suspend", target);
        driver.require_rest("after suspend");
        require_equal("the state of a suspended command", "RUNNING", driver.client.command_state(driver.last_command));
        if (distance(driver.observer.observe().at, target) <= noise(driver.home))
            throw NotObservable{"the robot was too near its target when it was suspended"};
        require_equal("the status of resume", "OK", driver.client.run(command(driver.mover, "resume")));
        require_equal("the status of the navigation after resume", "OK",
                      observe_command(context, driver.client, driver.observer, driver.last_command).status);
        driver.require_at(target);
        return true;
    });
}

// --- Move ---

int rounded(double number) { return static_cast<int>(std::lround(number)); }

Argument numbers(Driver const& driver, std::string const& name, int first, int second) {
    return argument(driver.mover, name, {std::to_string(first) + " " + std::to_string(second)});
}

// Calls `run` with 1 (forwards), and with -1 (backwards) if `run` returns false because an obstacle blocks the robot.
template <typename Run>
void ahead_or_back(Run const& run) {
    for (int const sign : {1, -1})
        if (run(sign)) return;
    throw NotObservable{"move finds no free path forwards or backwards"};
}

double heading_of(Driver const& driver) {
    if (!driver.home.at.heading) throw NotObservable{"robot_position has no heading"};
    return *driver.home.at.heading;
}

void move_follows_its_line(Context& context) {
    Driver driver{context, move_of(context)};
    ahead_or_back([&](int sign) {
        auto const trip = driver.run({numbers(driver, "line", rounded(sign * context.room()), 0)});
        if (trip.status == "ERROR") return false;
        require_equal("the status of a line", "OK", trip.status);
        driver.require_at(ahead(driver.home.at, sign * context.room(), heading_of(driver)));
        return true;
    });
}

// The specification allows two meanings: drive the line and then turn, or drive in the turned direction. Accepts both.
void move_follows_its_direction(Context& context) {
    constexpr int left = 90;
    Driver driver{context, move_of(context)};
    auto const begin = heading_of(driver);
    ahead_or_back([&](int sign) {
        auto const trip = driver.run({numbers(driver, "line", rounded(sign * context.room()), left)});
        if (trip.status == "ERROR") return false;
        require_equal("the status of a line", "OK", trip.status);
        auto const is_done = [&](RobotPosition const& observed) {
            bool const has_turned =
                std::abs(turn(begin + left, observed.at.heading.value_or(begin))) <= heading_tolerance(observed);
            auto const aside = ahead(driver.home.at, sign * context.room(), begin + left);
            auto const along = ahead(driver.home.at, sign * context.room(), begin);
            auto const most = tolerance(observed, context.room());
            return distance(observed.at, aside) <= most || (has_turned && distance(observed.at, along) <= most);
        };
        auto const observed = driver.observer.observe_until(is_done);
        require(is_done(observed), "a line of " + std::to_string(rounded(sign * context.room())) +
                                       " mm and 90 degrees to the left: unexpected end " + text_of(observed) + " from " +
                                       text_of(driver.home));
        return true;
    });
}

void move_follows_its_curve(Context& context) {
    constexpr int left = 90;
    constexpr double of_room = 0.7;  // the end of the curve is 1.4 radii from its beginning
    Driver driver{context, move_of(context)};
    auto const begin = heading_of(driver);
    auto const radius = rounded(of_room * context.room());
    ahead_or_back([&](int sign) {
        auto const trip = driver.run({numbers(driver, "curve", sign * radius, left)});
        if (trip.status == "ERROR") return false;
        require_equal("the status of a curve", "OK", trip.status);
        // The heading turns to the left on a forward curve to the left, and on a backward curve with the centre on the other
        // side.
        auto end = ahead(ahead(driver.home.at, sign * radius, begin), sign * radius, begin + left);
        end.heading = begin + left;
        driver.require_at(end);
        return true;
    });
}

void move_is_slower_with_a_longer_time(Context& context) {
    auto const& move = move_of(context);
    argument(move, "time", {"0"});  // throws Skipped if move lacks it
    Driver driver{context, move};
    int sign = 1;
    auto const drive = [&](int time) {
        auto arguments = std::vector{numbers(driver, "line", rounded(sign * context.room()), 0)};
        sign = -sign;
        if (time > 0) arguments.push_back(argument(move, "time", {std::to_string(time)}));
        auto const trip = driver.run(std::move(arguments));
        if (trip.status != "OK") throw NotObservable{"move finds no free path: a line completed with " + trip.status};
        return trip.duration;
    };
    auto const once = drive(0);
    auto const usual = std::min(once, drive(0));
    constexpr double factor = 1.5;
    constexpr int longest = 32'000;
    for (int time = 2'000; time <= longest; time *= 2)
        if (drive(time) > factor * usual) return;
    throw Broken{"expected a line with `time` " + std::to_string(longest) +
                 " ms to take at least 1.5 times as long as without `time` (" + std::to_string(usual.count()) + " ms)"};
}

}  // namespace

Clause motion_clause() {
    return {"Effects: motion",
            {{"navigation_reaches_its_target", "tables 34, 46; decisions 8, 27", navigation_reaches_its_target},
             {"targets_are_visited_in_order", "tables 34, 46", targets_are_visited_in_order},
             {"each_reached_target_is_reported", "table 46; decision 8", each_reached_target_is_reported},
             {"navigation_stops_at_its_time_limit", "tables 8, 46; decisions 8, 16", navigation_stops_at_its_time_limit},
             {"stop_halts_the_robot", "tables 8, 32, 34; decision 9", stop_halts_the_robot},
             {"suspend_halts_the_robot_and_resume_continues", "tables 32, 34; decision 9",
              suspend_halts_the_robot_and_resume_continues},
             {"move_follows_its_line", "7.6.15; table 34; decision 27", move_follows_its_line},
             {"move_follows_its_direction", "7.6.15; table 34; decision 27", move_follows_its_direction},
             {"move_follows_its_curve", "7.6.15; table 34; decision 27", move_follows_its_curve},
             {"move_is_slower_with_a_longer_time", "7.6.15", move_is_slower_with_a_longer_time}}};
}

}  // namespace rois::conformance
