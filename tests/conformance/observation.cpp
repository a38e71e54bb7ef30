#include "conformance/observation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <thread>

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

constexpr milliseconds between_looks{20};
constexpr milliseconds longest_lag{500};

milliseconds since(Clock::time_point begin) { return std::chrono::duration_cast<milliseconds>(Clock::now() - begin); }

// Multiplied by the standard deviation of one measurement: four standard deviations of the difference of two measurements.
constexpr double four_sigma = 4 * std::numbers::sqrt2;

void read_certainty(RobotPosition& observed, pugi::xml_node results) {
    for (auto const located : results.children("located")) {
        if (located.attribute("of").value() != std::string{"position_data"}) continue;
        auto const deviations = deviations_in(located.child("covariance").text().get());
        if (!deviations) continue;
        std::tie(observed.sigma, observed.heading_sigma) = *deviations;
    }
}

}  // namespace

double noise(double sigma) { return four_sigma * sigma + 10; }
double noise(RobotPosition const& observed) { return noise(observed.sigma); }
double heading_noise(RobotPosition const& observed) { return four_sigma * observed.heading_sigma + 2; }

double tolerance(RobotPosition const& observed, double distance) {
    constexpr double of_the_way = 0.1;
    return noise(observed) + 10 + of_the_way * distance;
}

double heading_tolerance(RobotPosition const& observed) { return heading_noise(observed) + 8; }

std::optional<std::pair<double, double>> deviations_in(std::string const& covariance) {
    std::vector<double> cells;
    std::istringstream text{covariance};
    for (double cell = 0; text >> cell;) cells.push_back(cell);
    auto const rows = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(cells.size()))));
    if (rows < 2 || rows * rows != cells.size()) return {};
    auto const heading = rows > 2 ? std::sqrt(std::abs(cells.back())) : 0;
    return std::pair{std::sqrt(std::max(std::abs(cells[0]), std::abs(cells[rows + 1]))), heading};
}

// robot_position of another engine reports another robot (decision 18).
PositionObserver::PositionObserver(Client& client, Component const& of)
    : client_{client}, of_{of.ref}, reporter_{client.position_reporter_of(of)} {
    if (!reporter_) throw NotObservable{"expected exactly one component with robot_position in the engine of " + of_};
}

RobotPosition PositionObserver::observe() const {
    auto const answer = client_.query("robot_position", only(*reporter_));
    if (answer.return_code() != "OK") throw NotObservable{"robot_position of " + reporter_->ref + ": " + answer.reason()};
    auto const results = answer.values();
    auto const positions = results.find("position_data"), robots = results.find("robot_ref"), times = results.find("timestamp");
    if (positions == results.end() || positions->second.size() != 1)
        throw NotObservable{"robot_position of " + reporter_->ref + ": expected one position_data"};
    auto const at = point_in(positions->second.front());
    if (!at)
        throw NotObservable{"robot_position of " + reporter_->ref + ": '" + positions->second.front() +
                            "' is not a position: expected \"x, y, th\""};
    RobotPosition observed;
    observed.at = *at;
    if (robots != results.end() && robots->second.size() == 1) observed.robot = robots->second.front();
    if (times != results.end() && times->second.size() == 1) observed.timestamp = times->second.front();
    read_certainty(observed, answer.root().child("results"));
    return observed;
}

RobotPosition PositionObserver::observe_until(std::function<bool(RobotPosition const&)> const& holds) const {
    auto const begin = Clock::now();
    auto observed = observe();
    while (!holds(observed) && since(begin) < longest_lag) {
        wait(between_looks);
        observed = observe();
    }
    return observed;
}

Trip observe_command(Context& context, Client& client, PositionObserver const& observer, std::string const& command_id,
                     std::function<bool(RobotPosition const&)> const& is_enough) {
    Trip trip;
    auto const begin = Clock::now();
    auto last_motion = begin;
    auto resting = observer.observe().at;
    while (true) {
        while (client.receive_now()) {
        }
        auto const completion_statuses = client.completion_statuses(command_id);
        trip.end = observer.observe();
        trip.path.push_back(trip.end);
        trip.duration = since(begin);
        if (!completion_statuses.empty()) {
            trip.status = completion_statuses.front();
            return trip;
        }
        if (is_enough(trip.end)) return trip;
        auto const& now = trip.end.at;
        bool const has_turned =
            now.heading && resting.heading && std::abs(turn(*resting.heading, *now.heading)) > heading_noise(trip.end);
        if (has_turned || distance(resting, now) > noise(trip.end)) {
            resting = now;
            last_motion = Clock::now();
        }
        require(since(last_motion) < context.patience(), "command " + command_id + " did not complete within " +
                                                             std::to_string(context.patience().count()) +
                                                             " ms after the robot stopped at " + text_of(now));
        wait(between_looks);
    }
}

void await_success(Client& client, std::string const& command_id, Component const& component) {
    while (true) {
        while (client.receive_now()) {
        }
        if (!client.completion_statuses(command_id).empty()) break;
        auto const state = client.command_state(command_id);
        if (state != "RUNNING" && state != "WAITING") break;
        wait(milliseconds{5});
    }
    client.require_success(command_id, component);
}

milliseconds duration_of(Client& client, Command const& command, Component const& component) {
    auto const begin = Clock::now();
    await_success(client, client.execute_one(command), component);
    return since(begin);
}

milliseconds shortest_duration(Client& client, Command const& command, Component const& component) {
    auto shortest = milliseconds::max();
    for (int i = 0; i < 3; ++i) shortest = std::min(shortest, duration_of(client, command, component));
    return shortest;
}

void wait(milliseconds time) { std::this_thread::sleep_for(time); }

}  // namespace rois::conformance
