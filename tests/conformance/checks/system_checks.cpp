// Several engines and robots, expired details, and failed components (tables 2, 5 to 8, 33, 34; decisions 16, 18, 21, 24 and 32).
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

// Returns the engines of the components, without the main engine. Throws NotObservable if there is only the main engine.
std::set<std::string> sub_engines(Context const& context) {
    std::set<std::string> engines;
    for (auto const& component : context.catalogue().components)
        if (!component.engine.empty() && component.engine != context.catalogue().engine) engines.insert(component.engine);
    if (engines.empty()) throw NotObservable{"the gateway has only one engine"};
    return engines;
}

std::vector<std::string> components_of(Context const& context, std::string const& engine) {
    std::vector<std::string> refs;
    for (auto const& component : context.catalogue().components)
        if (component.engine == engine) refs.push_back(component.ref);
    return refs;
}

// Requires the components of an engine, with or without those of its sub engines. Members of logical components, which are only
// seen by those who ask for engines, may be among them.
void require_chosen(Context const& context, std::string const& engine, std::string const& what, std::vector<std::string> found) {
    std::ranges::sort(found);
    std::erase_if(found, [&](std::string const& ref) {
        return context.catalogue().find(ref) == nullptr && context.catalogue().find(ref.substr(ref.rfind('.') + 1)) != nullptr;
    });
    auto const expected = components_of(context, engine);
    auto const whole = context.catalogue().refs_by_engine.find(engine);
    bool const is_whole = whole != context.catalogue().refs_by_engine.end() && std::ranges::equal(whole->second, found);
    require(found == expected || is_whole,
            what + " with engine = " + engine + ": expected " + list(expected) + ", got " + list(found));
}

void engine_selects_components(Context& context) {
    Client client{context};
    for (auto const& engine : sub_engines(context)) {
        require_chosen(context, engine, "search", client.search(where(equal("engine", engine))));
    }
}

void engine_selects_profiles(Context& context) {
    Client client{context};
    for (auto const& engine : sub_engines(context)) {
        auto const chosen = Catalogue::read(require_ok(client.ask("get_profile", where(equal("engine", engine)))));
        std::vector<std::string> refs;
        for (auto const& component : chosen.components) refs.push_back(component.ref);
        require_chosen(context, engine, "get_profile", refs);
    }
}

void engine_selects_the_robot(Context& context) {
    Client client{context};
    std::map<std::string, std::string> robots;  // by engine
    for (auto const& engine : sub_engines(context)) {
        for (auto const& component : context.catalogue().components) {
            if (component.engine != engine || !component.query("robot_position")) continue;
            auto const answer = client.query("robot_position", where(equal("engine", engine)));
            auto const* const reporter = context.catalogue().find(require_ok(answer).ref());
            require(reporter && reporter->engine == engine,
                    "robot_position with engine = " + engine + ": expected a component of this engine, got " + answer.ref());
            auto const results = answer.values();
            if (auto const refs = results.find("robot_ref"); refs != results.end())
                robots.try_emplace(engine, list(refs->second));
        }
    }
    if (robots.size() < 2) throw NotObservable{"fewer than two engines have robot_position"};
    std::set<std::string> names;
    for (auto const& [engine, robot] : robots)
        require(names.insert(robot).second,
                "robot_position with engine = " + engine + " returned the robot of another engine: " + robot);
}

// Moves the robots of two engines, one after the other.
void robots_move_independently(Context& context) {
    for (std::string const kind : {"navigation", "move"}) {
        std::vector<Component const*> movers;
        for (auto const& component : context.catalogue().components) {
            bool const is_another =
                std::ranges::none_of(movers, [&](auto const* one) { return one->engine == component.engine; });
            if (component.basic() == kind && is_another) movers.push_back(&component);
        }
        if (movers.size() < 2) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            Driver driver{context, *movers[i]};
            Client other{context};
            PositionObserver const other_observer{other, *movers[1 - i]};
            auto const before = other_observer.observe();
            require(before.robot.empty() || before.robot != driver.home.robot, "expected different robots, got " + before.robot +
                                                                                   " for the engines " + movers[0]->engine +
                                                                                   " and " + movers[1]->engine);
            for (auto const& target : driver.destinations()) {
                auto const trip = driver.run({kind == "move" ? straight_line(driver.mover, std::lround(context.room()))
                                                             : argument(driver.mover, "target_position", {text_of(target)})});
                if (trip.status == "ERROR") continue;
                require_equal("the status of start of " + movers[i]->ref, "OK", trip.status);
                auto const end = driver.observer.observe();
                require(distance(end.at, driver.home.at) > noise(end),
                        "expected start of " + movers[i]->ref + " to move its robot");
                auto const after = other_observer.observe();
                require(distance(after.at, before.at) <= noise(after),
                        "start of " + movers[i]->ref + " moved the robot of " + movers[1 - i]->ref);
                break;
            }
        }
        return;
    }
    throw NotObservable{"fewer than two engines have a robot that moves"};
}

// Returns the seconds since 1970 of a time like "2026-11-20T12:00:00.123Z".
double seconds_in(std::string const& text) {
    std::tm time{};
    std::istringstream stream{text};
    stream >> std::get_time(&time, "%Y-%m-%dT%H:%M:%S");
    double fraction = 0;
    if (stream.peek() == '.') stream >> fraction;
    return static_cast<double>(timegm(&time)) + fraction;
}

void details_of_an_event_expire(Context& context) {
    auto const& detector = context.detector();
    Client client{context};
    client.bind_or_skip(detector);
    require_ok(client.subscribe(detector.detection_event(), only(detector), true));
    auto const event = client.start_and_receive(detector, detector.detection_event());
    auto const id = event.text("event_id");
    require_ok(client.get_event_detail(id));
    auto const kept = seconds_in(event.text("expire")) - seconds_in(value_of(event.values(), "timestamp"));
    auto const patience = std::chrono::duration<double>(context.patience()).count();
    if (kept > patience)
        throw NotObservable{"details are kept for " + std::to_string(std::lround(kept)) + " s, longer than --patience " +
                            std::to_string(std::lround(patience))};
    constexpr milliseconds margin{1'000};
    wait(milliseconds{std::lround(std::max(kept, 0.0) * 1'000)} + margin);
    require_refusal(client.get_event_detail(id), "BAD_PARAMETER");
}

void timestamps_increase(Context& context) {
    auto const& detector = context.detector();
    Client client{context};
    client.bind_or_skip(detector);
    require_ok(client.subscribe(detector.detection_event(), only(detector), true));
    std::string last;
    for (int i = 0; i < 2; ++i) {
        auto const time = value_of(client.start_and_receive(detector, detector.detection_event()).values(), "timestamp");
        require(i == 0 || seconds_in(time) > seconds_in(last),
                "expected a timestamp after " + last + " in the next event, got " + time);
        last = time;
        require_equal("the status of stop", "OK", client.run(command(detector, "stop")));
        wait(milliseconds{200});
    }
}

// Returns whether this is a receive_error of this component. If it has no component_ref, reads the details.
bool is_error_of(Client& client, Document const& received, Component const& component) {
    if (received.name() != "receive_error") return false;
    if (auto const named = received.ref(); !named.empty()) return named == component.ref;
    auto const details = client.ask("get_error_detail", kit::text_element("error_id", received.text("error_id"))).values();
    auto const ref = details.find("component_ref");
    return ref != details.end() && ref->second == std::vector{component.ref};
}

// Waits for a receive_error of this component, and returns it.
Document error_of(Client& client, Component const& component) {
    for (std::size_t i = 0;; ++i) {
        if (i == client.history().size()) client.receive();
        if (auto const received = client.history()[i]; is_error_of(client, received, component)) return received;
    }
}

// Starts only functions: they have no effect on the robot or on people.
void status_and_errors_match_the_result_of_start(Context& context) {
    bool observed = false;
    for (auto const& component : context.catalogue().components) {
        if (!component.is_function()) continue;
        Client client{context};
        if (client.bind(component.ref).return_code() != "OK") continue;
        auto const answer = client.query("component_status", only(component));
        auto const status = answer.return_code() == "OK" ? value_of(answer.values(), "status") : "";
        auto const ended = client.run(command(component, "start"));
        observed = observed || ended != "OK" || status != "READY";
        if (ended == "OK") {
            require(status == "READY" || status == "WARNING",
                    "start of " + component.ref + " completed with OK: expected component_status READY or WARNING, got " +
                        (status.empty() ? "none" : status));
            client.run(command(component, "stop"));
            continue;
        }
        require(status == "" || status != "READY" || ended == "TIMEOUT",
                "start of " + component.ref + " completed with " + ended + ": expected another component_status than READY");
        std::string type;
        try {
            type = error_of(client, component).text("error_type");
        } catch (kit::LineEnded const&) {
            throw Broken{"start of " + component.ref + " completed with " + ended +
                         ": expected a receive_error of this component, got none"};
        }
        auto const expected = ended == "TIMEOUT" ? "COMPONENT_NOT_RESPONDING" : "COMPONENT_INTERNAL_ERROR";
        require(type == expected || type == "USER_DEFINED_ERROR",
                "start of " + component.ref + " completed with " + ended + ": expected error_type " + expected + ", got " + type);
    }
    if (!observed) throw NotObservable{"all functions are READY, and start completes with OK"};
}

}  // namespace

Clause system_clause() {
    return {"Effects: engines, time and failures",
            {{"engine_selects_components", "figure 4; table 3; decisions 18, 32", engine_selects_components},
             {"engine_selects_profiles", "figure 4; table 2; decision 32", engine_selects_profiles, Transport::http},
             {"engine_selects_the_robot", "figure 4; tables 4, 34; decisions 18, 32", engine_selects_the_robot},
             {"robots_move_independently", "figures 3, 4; table 34; decision 32", robots_move_independently},
             {"details_of_an_event_expire", "tables 5, 6; decision 21", details_of_an_event_expire},
             {"timestamps_increase", "tables 35 to 40; decision 28", timestamps_increase},
             {"status_and_errors_match_the_result_of_start", "tables 7, 8, 33; decisions 7, 16, 24",
              status_and_errors_match_the_result_of_start}}};
}

}  // namespace rois::conformance
