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

// Four standard deviations of the difference between two measurements.
constexpr double four_sigma = 4 * std::numbers::sqrt2;

void read_certainty(Sighting& sighting, pugi::xml_node results) {
    for (auto const located : results.children("located")) {
        if (located.attribute("of").value() != std::string{"position_data"}) continue;
        auto const deviations = deviations_in(located.child("covariance").text().get());
        if (!deviations) continue;
        std::tie(sighting.sigma, sighting.heading_sigma) = *deviations;
    }
}

}  // namespace

double noise(double sigma) { return four_sigma * sigma + 10; }
double noise(Sighting const& sighting) { return noise(sighting.sigma); }
double heading_noise(Sighting const& sighting) { return four_sigma * sighting.heading_sigma + 2; }

double tolerance(Sighting const& sighting, double distance) {
    constexpr double of_the_way = 0.1;
    return noise(sighting) + 10 + of_the_way * distance;
}

double heading_tolerance(Sighting const& sighting) { return heading_noise(sighting) + 8; }

std::optional<std::pair<double, double>> deviations_in(std::string const& covariance) {
    std::vector<double> cells;
    std::istringstream text{covariance};
    for (double cell = 0; text >> cell;) cells.push_back(cell);
    auto const rows = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(cells.size()))));
    if (rows < 2 || rows * rows != cells.size()) return {};
    auto const heading = rows > 2 ? std::sqrt(std::abs(cells.back())) : 0;
    return std::pair{std::sqrt(std::max(std::abs(cells[0]), std::abs(cells[rows + 1]))), heading};
}

// Another engine's robot_position would be of another robot (decision 18).
Eye::Eye(Guest& guest, Component const& of) : guest_{guest}, of_{of.ref}, teller_{guest.teller_of(of)} {
    if (!teller_) throw NotObservable{"no single component of the engine of " + of_ + " reports robot_position"};
}

Sighting Eye::look() const {
    auto const answer = guest_.query("robot_position", only(*teller_));
    if (answer.return_code() != "OK") throw NotObservable{"robot_position of " + teller_->ref + ": " + answer.reason()};
    auto const results = answer.values();
    auto const positions = results.find("position_data"), robots = results.find("robot_ref"), times = results.find("timestamp");
    if (positions == results.end() || positions->second.size() != 1)
        throw NotObservable{"robot_position of " + teller_->ref + " does not report one position"};
    auto const at = point_in(positions->second.front());
    if (!at) throw NotObservable{"a position of " + teller_->ref + " is not in coordinates: " + positions->second.front()};
    Sighting sighting;
    sighting.at = *at;
    if (robots != results.end() && robots->second.size() == 1) sighting.robot = robots->second.front();
    if (times != results.end() && times->second.size() == 1) sighting.timestamp = times->second.front();
    read_certainty(sighting, answer.root().child("results"));
    return sighting;
}

Sighting Eye::look_until(std::function<bool(Sighting const&)> const& holds) const {
    auto const begin = Clock::now();
    auto seen = look();
    while (!holds(seen) && since(begin) < longest_lag) {
        wait(between_looks);
        seen = look();
    }
    return seen;
}

Trip watch(Stage& stage, Guest& guest, Eye const& eye, std::string const& command_id,
           std::function<bool(Sighting const&)> const& enough) {
    Trip trip;
    auto const begin = Clock::now();
    auto last_motion = begin;
    auto resting = eye.look().at;
    while (true) {
        while (guest.hear_now()) {
        }
        auto const endings = guest.endings(command_id);
        trip.end = eye.look();
        trip.way.push_back(trip.end);
        trip.took = since(begin);
        if (!endings.empty()) {
            trip.status = endings.front();
            return trip;
        }
        if (enough(trip.end)) return trip;
        auto const& now = trip.end.at;
        bool const has_turned =
            now.heading && resting.heading && std::abs(turn(*resting.heading, *now.heading)) > heading_noise(trip.end);
        if (has_turned || distance(resting, now) > noise(trip.end)) {
            resting = now;
            last_motion = Clock::now();
        }
        require(since(last_motion) < stage.patience(), "nothing came of the command " + command_id + " within " +
                                                           std::to_string(stage.patience().count()) +
                                                           " ms, while the robot stood at " + text_of(now));
        wait(between_looks);
    }
}

void require_end(Guest& guest, std::string const& command_id, Component const& component) {
    while (true) {
        while (guest.hear_now()) {
        }
        if (!guest.endings(command_id).empty()) break;
        auto const state = guest.state_of(command_id);
        if (state != "RUNNING" && state != "WAITING") break;
        wait(milliseconds{5});
    }
    guest.require_success(command_id, component);
}

milliseconds duration_of(Guest& guest, Command const& command, Component const& component) {
    auto const begin = Clock::now();
    require_end(guest, guest.order(command), component);
    return since(begin);
}

milliseconds shortest_duration(Guest& guest, Component const& component) {
    auto shortest = milliseconds::max();
    for (int i = 0; i < 3; ++i) shortest = std::min(shortest, duration_of(guest, command(component, "stop"), component));
    return shortest;
}

void wait(milliseconds time) { std::this_thread::sleep_for(time); }

}  // namespace rois::conformance
