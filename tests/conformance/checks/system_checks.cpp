// Several engines and robots, details that expire, and components that have failed (tables 2, 5 to 8, 33, 34; decisions 16, 18,
// 21, 24 and 32).
#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "conformance/driver.hpp"

namespace rois::conformance {

namespace {

using kit::equal;
using kit::where;

// The engines that components name, without the one that contains all others.
std::set<std::string> sub_engines(Stage const& stage) {
    std::set<std::string> engines;
    for (auto const& component : stage.catalogue().components)
        if (!component.engine.empty() && component.engine != stage.catalogue().engine) engines.insert(component.engine);
    if (engines.empty()) throw NotObservable{"there is one engine alone"};
    return engines;
}

std::vector<std::string> components_of(Stage const& stage, std::string const& engine) {
    std::vector<std::string> refs;
    for (auto const& component : stage.catalogue().components)
        if (component.engine == engine) refs.push_back(component.ref);
    return refs;
}

// An engine's components, with or without those of its sub engines.
void require_chosen(Stage const& stage, std::string const& engine, std::string const& what, std::vector<std::string> found) {
    std::ranges::sort(found);
    auto const due = components_of(stage, engine);
    auto const whole = stage.catalogue().whole.find(engine);
    bool const is_whole = whole != stage.catalogue().whole.end() && std::ranges::equal(whole->second, found);
    require(found == due || is_whole, what + engine + " should be " + list(due) + ", and is " + list(found));
}

void engine_chooses_components(Stage& stage) {
    Guest guest{stage};
    for (auto const& engine : sub_engines(stage)) {
        require_chosen(stage, engine, "the components found by engine = ", guest.search(where(equal("engine", engine))));
    }
}

void engine_chooses_profiles(Stage& stage) {
    Guest guest{stage};
    for (auto const& engine : sub_engines(stage)) {
        auto const chosen = Catalogue::read(ok(guest.ask("get_profile", where(equal("engine", engine)))));
        std::vector<std::string> refs;
        for (auto const& component : chosen.components) refs.push_back(component.ref);
        require_chosen(stage, engine, "the profiles found by engine = ", refs);
    }
}

void engine_chooses_the_robot(Stage& stage) {
    Guest guest{stage};
    std::map<std::string, std::string> robots;  // by engine
    for (auto const& engine : sub_engines(stage)) {
        for (auto const& component : stage.catalogue().components) {
            if (component.engine != engine || !component.query("robot_position")) continue;
            auto const answer = guest.query("robot_position", where(equal("engine", engine)));
            auto const* const teller = stage.catalogue().find(ok(answer).ref());
            require(teller && teller->engine == engine,
                    "robot_position of engine = " + engine + " is answered by " + answer.ref() + ", which is not of it");
            auto const results = answer.values();
            if (auto const refs = results.find("robot_ref"); refs != results.end())
                robots.try_emplace(engine, list(refs->second));
        }
    }
    if (robots.size() < 2) throw NotObservable{"there are no two engines with a robot_position"};
    std::set<std::string> names;
    for (auto const& [engine, robot] : robots)
        require(names.insert(robot).second, "robot_position of engine = " + engine + " is that of another engine: " + robot);
}

// Two components that move robots, of two engines.
void each_robot_moves_by_itself(Stage& stage) {
    for (std::string const kind : {"navigation", "move"}) {
        std::vector<Component const*> wheels;
        for (auto const& component : stage.catalogue().components) {
            bool const is_another =
                std::ranges::none_of(wheels, [&](auto const* one) { return one->engine == component.engine; });
            if (component.basic() == kind && is_another) wheels.push_back(&component);
        }
        if (wheels.size() < 2) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            Driver driver{stage, *wheels[i]};
            Guest other{stage};
            Eye const others_eye{other, *wheels[1 - i]};
            auto const before = others_eye.look();
            require(before.robot.empty() || before.robot != driver.home.robot,
                    "two engines have the robot " + before.robot + ": " + wheels[0]->engine + " and " + wheels[1]->engine);
            for (auto const& target : driver.destinations()) {
                auto const trip = driver.go({kind == "move" ? straight_on(driver.wheels, std::lround(stage.room()))
                                                            : argument(driver.wheels, "target_position", {text_of(target)})});
                if (trip.status == "ERROR") continue;
                same("the status of start of " + wheels[i]->ref, "OK", trip.status);
                auto const end = driver.eye.look();
                require(distance(end.at, driver.home.at) > noise(end), "the robot of " + wheels[i]->ref + " has not moved");
                auto const after = others_eye.look();
                require(distance(after.at, before.at) <= noise(after),
                        "start of " + wheels[i]->ref + " has moved the robot of " + wheels[1 - i]->ref);
                break;
            }
        }
        return;
    }
    throw NotObservable{"there are no two engines with a robot that moves"};
}

// Of "2026-11-20T12:00:00.123Z": seconds, for differences.
double seconds_in(std::string const& text) {
    std::tm time{};
    std::istringstream stream{text};
    stream >> std::get_time(&time, "%Y-%m-%dT%H:%M:%S");
    double fraction = 0;
    if (stream.peek() == '.') stream >> fraction;
    return static_cast<double>(timegm(&time)) + fraction;
}

void details_expire(Stage& stage) {
    auto const& detector = stage.detector();
    Guest guest{stage};
    guest.take(detector);
    ok(guest.subscribe(detector.detection(), only(detector), true));
    auto const event = guest.start_until(detector, detector.detection());
    auto const id = event.text("event_id");
    ok(guest.get_event_detail(id));
    auto const kept = seconds_in(event.text("expire")) - seconds_in(value_of(event.values(), "timestamp"));
    auto const patience = std::chrono::duration<double>(stage.patience()).count();
    if (kept > patience)
        throw NotObservable{"details are kept for " + std::to_string(std::lround(kept)) + " s, longer than the patience of " +
                            std::to_string(std::lround(patience)) + " s"};
    constexpr milliseconds margin{1'000};
    wait(milliseconds{std::lround(std::max(kept, 0.0) * 1'000)} + margin);
    refused(guest.get_event_detail(id), "BAD_PARAMETER");
}

void timestamps_go_on(Stage& stage) {
    auto const& detector = stage.detector();
    Guest guest{stage};
    guest.take(detector);
    ok(guest.subscribe(detector.detection(), only(detector), true));
    std::string last;
    for (int i = 0; i < 2; ++i) {
        auto const time = value_of(guest.start_until(detector, detector.detection()).values(), "timestamp");
        require(i == 0 || seconds_in(time) > seconds_in(last),
                "an event has the timestamp " + time + ", and one that was measured before it has " + last);
        last = time;
        same("the status of stop", "OK", guest.ending(command(detector, "stop")));
        wait(milliseconds{200});
    }
}

// Whether this is an error of this component, which receive_error may leave to the details.
bool is_error_of(Guest& guest, Document const& heard, Component const& component) {
    if (heard.name() != "receive_error") return false;
    if (auto const named = heard.ref(); !named.empty()) return named == component.ref;
    auto const details = guest.ask("get_error_detail", kit::text_element("error_id", heard.text("error_id"))).values();
    auto const ref = details.find("component_ref");
    return ref != details.end() && ref->second == std::vector{component.ref};
}

// The receive_error of this component; waits for it.
Document error_of(Guest& guest, Component const& component) {
    for (std::size_t i = 0;; ++i) {
        if (i == guest.history().size()) guest.hear();
        if (auto const heard = guest.history()[i]; is_error_of(guest, heard, component)) return heard;
    }
}

// Functions are started; nothing in the world changes by that.
void status_and_errors_agree_with_what_happens(Stage& stage) {
    bool observed = false;
    for (auto const& component : stage.catalogue().components) {
        if (!component.is_function()) continue;
        Guest guest{stage};
        if (guest.bind(component.ref).return_code() != "OK") continue;
        auto const asked = guest.query("component_status", only(component));
        auto const status = asked.return_code() == "OK" ? value_of(asked.values(), "status") : "";
        auto const ended = guest.ending(command(component, "start"));
        observed = observed || ended != "OK" || status != "READY";
        if (ended == "OK") {
            require(status == "READY" || status == "WARNING",
                    "start of " + component.ref + " ends with OK, and its status is " + (status.empty() ? "none" : status));
            guest.ending(command(component, "stop"));
            continue;
        }
        require(status == "" || status != "READY" || ended == "TIMEOUT",
                "start of " + component.ref + " ends with " + ended + ", and its status is READY");
        std::string type;
        try {
            type = error_of(guest, component).text("error_type");
        } catch (kit::LineEnded const&) {
            throw Broken{"start of " + component.ref + " ends with " + ended + ", and no receive_error names it"};
        }
        auto const due = ended == "TIMEOUT" ? "COMPONENT_NOT_RESPONDING" : "COMPONENT_INTERNAL_ERROR";
        require(type == due || type == "USER_DEFINED_ERROR",
                "start of " + component.ref + " ends with " + ended + "; the error should be " + due + ", and is " + type);
    }
    if (!observed) throw NotObservable{"all components are READY and start"};
}

}  // namespace

Clause system_clause() {
    return {"Effects: engines, time and failures",
            {{"engine_chooses_components", "figure 4; table 3; decisions 18, 32", engine_chooses_components},
             {"engine_chooses_profiles", "figure 4; table 2; decision 32", engine_chooses_profiles, Way::http},
             {"engine_chooses_the_robot", "figure 4; tables 4, 34; decisions 18, 32", engine_chooses_the_robot},
             {"each_robot_moves_by_itself", "figures 3, 4; table 34; decision 32", each_robot_moves_by_itself},
             {"details_expire", "tables 5, 6; decision 21", details_expire},
             {"timestamps_go_on", "tables 35 to 40; decision 28", timestamps_go_on},
             {"status_and_errors_agree_with_what_happens", "tables 7, 8, 33; decisions 7, 16, 24",
              status_and_errors_agree_with_what_happens}}};
}

}  // namespace rois::conformance
