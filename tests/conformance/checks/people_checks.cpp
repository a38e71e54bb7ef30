// Localization of people, also from a moving robot, and Follow (tables 34, 36 and 47; decisions 8, 9, 27). These checks need a
// person in front of the robot.
#include <algorithm>
#include <cmath>
#include <set>

#include "conformance/driver.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto localized = "person_localized";
constexpr double nearest = 1'000;  // the least distance between the robot and a person, in mm

struct Person {
    std::string ref;
    Point at;
    double sigma = 50;  // mm
};

// Returns the people in an event or in its details.
std::vector<Person> people_in(Document const& event) {
    auto const results = event.values();
    auto const refs = results.find("person_ref"), positions = results.find("position_data");
    if (refs == results.end() || positions == results.end()) return {};
    require(refs->second.size() == positions->second.size(),
            "expected a position for each person_ref " + list(refs->second) + ", got " + list(positions->second));
    std::vector<Person> people;
    for (std::size_t i = 0; i < refs->second.size(); ++i) {
        auto const at = point_in(positions->second[i]);
        if (!at) throw NotObservable{"'" + positions->second[i] + "' is not a position: expected \"x, y, th\""};
        people.push_back({refs->second[i], *at});
    }
    for (auto const located : event.root().child("results").children("located")) {
        auto const found = std::ranges::find(people, std::string{located.attribute("ref").value()}, &Person::ref);
        auto const deviations = deviations_in(located.child("covariance").text().get());
        if (found != people.end() && deviations) found->sigma = deviations->first;
    }
    return people;
}

Component const& localization_beside(Context const& context, Component const* other) {
    for (auto const& component : context.catalogue().components)
        if (component.basic() == "personlocalization" && (!other || component.engine == other->engine)) return component;
    throw Skipped{"the gateway has no person localization" + (other ? " for the robot of " + other->ref : "")};
}

// Localizes people.
class PeopleObserver {
public:
    PeopleObserver(Context& context, Client& client, Component const* beside = nullptr)
        : localization{localization_beside(context, beside)}, context_{context}, client_{client} {
        client_.bind_or_skip(localization);
        require_a_person();
        require_ok(client_.subscribe(localized, only(localization), true));
    }

    void start() { client_.require_success(client_.execute_one(command(localization, "start")), localization); }
    void end(std::string const& type) {
        require_equal("the status of " + type + " of " + localization.ref, "OK", client_.run(command(localization, type)));
    }

    // Returns the people of the first measurement after `start`, the one nearest to `from` first. Throws NotObservable if no
    // person is localized.
    std::vector<Person> people(Point const& from) {
        end("stop");
        discard_received();
        auto const before = client_.history().size();
        start();
        auto event = client_.first_event_after(before, localized);
        if (!event) event = next(context_.patience());
        end("stop");
        if (!event) throw NotObservable{"no person is localized"};
        auto found = people_in(*event);
        if (found.empty()) throw NotObservable{"no person is localized"};
        std::ranges::sort(found, {}, [&](Person const& person) { return distance(from, person.at); });
        return found;
    }

    // Returns the next event, or nothing if none arrives in this time.
    std::optional<Document> next(milliseconds time) {
        for (auto const end = Clock::now() + time; Clock::now() < end; wait(milliseconds{10})) {
            for (auto received = receive_now(); received; received = receive_now())
                if (received->text("event_type") == localized) return received;
        }
        return {};
    }

    // Returns the number of events that arrive in this time.
    std::size_t count(milliseconds time) {
        auto const end = Clock::now() + time;
        std::size_t events = 0;
        while (Clock::now() < end)
            if (next(std::chrono::duration_cast<milliseconds>(end - Clock::now()))) ++events;
        return events;
    }

    // Returns how many events in this time have the same people as the event before: only motion has caused them, not that
    // somebody came or left.
    std::size_t count_motions(milliseconds time) {
        auto const end = Clock::now() + time;
        std::size_t motions = 0;
        std::optional<std::vector<std::string>> before;
        while (Clock::now() < end) {
            auto const event = next(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
            if (!event) break;
            std::vector<std::string> refs;
            for (auto const& person : people_in(*event)) refs.push_back(person.ref);
            std::ranges::sort(refs);
            if (before == refs) ++motions;
            before = std::move(refs);
        }
        return motions;
    }

    // Returns the time until `some_events` events have arrived, at least 300 ms. Throws NotObservable if people do not move.
    milliseconds time_of_some_events() {
        auto const begin = Clock::now();
        for (int i = 0; i < some_events; ++i)
            if (!next(context_.patience())) throw NotObservable{"no localized person moves"};
        constexpr milliseconds least{300};
        return std::max(least, std::chrono::duration_cast<milliseconds>(Clock::now() - begin));
    }

    void discard_received() {
        while (receive_now()) {
        }
    }

    static constexpr int some_events = 4;

    Component const& localization;

private:
    // Over a WebSocket, the client reads notifications together with an answer: requests one.
    std::optional<Document> receive_now() {
        if (auto received = client_.receive_now()) return received;
        if (context_.transport() == Transport::websocket) client_.search(only(localization));
        return client_.receive_now();
    }

    // Throws NotObservable early if a person detection reports zero people. Without a detection, `people` waits until the
    // patience is over.
    void require_a_person() {
        for (auto const& detection : context_.catalogue().components) {
            if (detection.basic() != "persondetection" || detection.engine != localization.engine) continue;
            if (!detection.event(detection.detection_event()) || client_.bind(detection.ref).return_code() != "OK") continue;
            auto const id =
                require_ok(client_.subscribe(detection.detection_event(), only(detection), true)).text("subscribe_id");
            auto const number = value_of(client_.start_and_receive(detection, detection.detection_event()).values(), "number");
            client_.run(command(detection, "stop"));
            require_ok(client_.unsubscribe(id));
            require_ok(client_.release(detection.ref));
            if (number == "0") throw NotObservable{detection.ref + " detects no person"};
        }
    }

    Context& context_;
    Client& client_;
};

std::optional<Person> same_person(std::vector<Person> const& people, Person const& person) {
    auto const found = std::ranges::find(people, person.ref, &Person::ref);
    return found == people.end() ? std::nullopt : std::optional{*found};
}

// Returns the greatest distance between two measurements of a standing person, in mm.
double measurement_error(Person const& person) { return noise(person.sigma) + 50; }

// Returns the distance that the robot can approach a person, in mm. Throws NotObservable if the distance is too short to be
// observed.
double approach_distance(Driver const& driver, Person const& person) {
    auto const way = std::min(driver.context.room(), distance(driver.home.at, person.at) - nearest);
    auto const needed = 1.4 * (measurement_error(person) + tolerance(driver.home, way));
    if (way < needed)
        throw NotObservable{person.ref + " is " + std::to_string(std::lround(distance(driver.home.at, person.at))) +
                            " mm away: the approach is observable with --room " + std::to_string(std::lround(needed)) +
                            " or more, and a distance of " + std::to_string(std::lround(nearest + needed)) + " mm or more"};
    return way;
}

void people_who_stand_still_keep_ref_and_position(Context& context) {
    Client client{context};
    PeopleObserver people_observer{context, client};
    auto const first = people_observer.people({}), second = people_observer.people({}), third = people_observer.people({});
    for (auto const* const people : {&first, &second, &third}) {
        std::set<std::string> refs;
        for (auto const& person : *people) refs.insert(person.ref);
        require(refs.size() == people->size(), "two localized people have the same person_ref");
    }
    bool stands = false;
    for (auto const& person : first) {
        auto const is_near = [&](Person const& other) { return distance(person.at, other.at) <= measurement_error(person); };
        if (std::ranges::none_of(second, is_near) || std::ranges::none_of(third, is_near)) continue;  // the person has walked
        stands = true;
        auto const later = same_person(third, person);
        require(later && is_near(*later), "expected the same person_ref " + person.ref +
                                              " in each event for the person who stands at " + text_of(person.at));
    }
    if (!stands) throw NotObservable{"no person stands still"};
}

void a_condition_selects_entries_of_details(Context& context) {
    Client client{context};
    PeopleObserver people_observer{context, client};
    people_observer.start();
    std::optional<Document> event;
    for (auto const end = Clock::now() + context.patience(); !event || people_in(*event).size() < 2;) {
        if (Clock::now() >= end) throw NotObservable{"no event has two localized people"};
        event = people_observer.next(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
    }
    auto const people = people_in(*event);
    auto const& chosen = people.back();
    auto const answer =
        require_ok(client.get_event_detail(event->text("event_id"), kit::where(kit::equal("person_ref", chosen.ref))));
    auto const found = people_in(answer);
    require(found.size() == 1 && found.front().ref == chosen.ref && distance(found.front().at, chosen.at) < 1,
            "get_event_detail with person_ref = " + chosen.ref + ": expected only this person of " +
                std::to_string(people.size()) + ", at " + text_of(chosen.at) + ", got " + answer.whole());
    auto const results = answer.root().child("results").children("located");
    for (auto const located : results)
        require_equal("the attribute ref of an element `located`", chosen.ref, located.attribute("ref").value());
    require(answer.values().contains("timestamp"), "expected the timestamp, which is not a list, got " + answer.whole());
}

void positions_of_people_are_independent_of_the_robot(Context& context) {
    Driver driver{context, context.component_of_kind({"navigation"})};
    PeopleObserver people_observer{context, driver.client, &driver.mover};
    auto const person = people_observer.people(driver.home.at).front();
    auto const way = approach_distance(driver, person);
    auto target = ahead(driver.home.at, way, direction(driver.home.at, person.at));
    if (target.heading) target.heading = direction(driver.home.at, person.at);
    auto const drive = [&](Point const& place) {
        auto const status = driver.run({argument(driver.mover, "target_position", {text_of(place)})}).status;
        if (status != "OK") throw NotObservable{"the navigation to " + text_of(place) + " completed with " + status};
        driver.require_at(place);
    };
    drive(target);
    auto const from_there = same_person(people_observer.people(target), person);
    auto const stands_still = [&](std::optional<Person> const& observed) {
        return observed && distance(observed->at, person.at) <= measurement_error(person) + tolerance(driver.home, 0);
    };
    if (stands_still(from_there)) return;
    drive(driver.home.at);
    if (!stands_still(same_person(people_observer.people(driver.home.at), person)))
        throw NotObservable{person.ref + " does not stand still"};
    throw Broken{"expected " + person.ref + " at " + text_of(person.at) + " when the robot is at " + text_of(target) + ", got " +
                 (from_there ? text_of(from_there->at) : "no position")};
}

void follow_keeps_its_distance(Context& context) {
    Driver driver{context, context.component_of_kind({"follow"})};
    PeopleObserver people_observer{context, driver.client, &driver.mover};
    auto const person = people_observer.people(driver.home.at).front();
    auto const expected = std::lround(distance(driver.home.at, person.at) - approach_distance(driver, person));
    auto const trip = driver.start_moving({argument(driver.mover, "target_object_ref", {person.ref}),
                                           argument(driver.mover, "distance", {std::to_string(expected)})});
    if (trip.status == "ERROR")
        throw NotObservable{driver.mover.ref + " does not follow " + person.ref + ": start completed with ERROR"};
    require_equal("the status of a follow before stop", "", trip.status);
    auto resting = driver.observer.observe();
    constexpr milliseconds long_enough{700};
    for (auto last = Clock::now(); Clock::now() - last < long_enough; wait(milliseconds{20})) {
        auto const observed = driver.observer.observe();
        if (distance(observed.at, resting.at) <= noise(observed)) continue;
        resting = observed;
        last = Clock::now();
    }
    resting = driver.observer.observe();
    auto const kept = distance(resting.at, person.at);
    require_equal("the status of stop", "OK", driver.client.run(command(driver.mover, "stop")));
    auto const later = same_person(people_observer.people(resting.at), person);
    if (!later || distance(later->at, person.at) > measurement_error(person) + tolerance(resting, 0))
        throw NotObservable{person.ref + " does not stand still"};
    require(std::abs(kept - static_cast<double>(expected)) <= measurement_error(person) + tolerance(resting, 0),
            "expected the robot " + std::to_string(expected) + " mm from " + person.ref + " at " + text_of(person.at) + ", got " +
                std::to_string(std::lround(kept)) + " mm at " + text_of(resting));
}

void only_an_active_function_reports_events(Context& context) {
    Client client{context};
    PeopleObserver people_observer{context, client};
    people_observer.start();
    auto const window = people_observer.time_of_some_events();
    auto const silent = [&](std::string const& when) {
        people_observer.discard_received();
        require(people_observer.count(2 * window) == 0,
                "received events of " + people_observer.localization.ref + " after " + when);
    };
    people_observer.end("suspend");
    silent("suspend");
    people_observer.end("resume");
    bool const continues = people_observer.next(context.patience()).has_value();
    people_observer.end("stop");
    silent("stop");
    people_observer.start();
    people_observer.time_of_some_events();
    require(continues, "received no event of " + people_observer.localization.ref + " after resume, though people move");
    // An event may be under way while the component is released: it may be several engines away. `bind` waits until it is halted.
    require_ok(client.release(people_observer.localization.ref));
    require_ok(client.bind(people_observer.localization.ref));
    require_ok(client.release(people_observer.localization.ref));
    people_observer.discard_received();
    std::size_t received = client.count_events(localized);
    wait(2 * window);
    client.search(only(people_observer.localization));
    people_observer.discard_received();
    require(client.count_events(localized) == received,
            "received events of " + people_observer.localization.ref + " after release");
}

// Requires that this value of the parameter suppresses all events except the first measurement after `start`.
void require_suppression(Context& context, std::string const& parameter, int value) {
    Client client{context};
    PeopleObserver people_observer{context, client};
    auto const large = argument(people_observer.localization, parameter, {std::to_string(value)});
    people_observer.start();
    auto const window = people_observer.time_of_some_events();
    people_observer.end("stop");
    auto const set = client.set_parameter(people_observer.localization.ref, {large});
    if (set.return_code() == "BAD_PARAMETER")
        throw NotObservable{parameter + " = " + std::to_string(value) + " is refused: " + set.reason()};
    require_equal("the status of set_parameter", "OK", client.status_of(require_ok(set).text("command_id")));
    people_observer.discard_received();
    people_observer.start();
    auto const events = people_observer.count_motions(2 * window);
    people_observer.end("stop");
    require(events < PeopleObserver::some_events, "with " + parameter + " = " + std::to_string(value) + ": expected fewer than " +
                                                      std::to_string(PeopleObserver::some_events) +
                                                      " events with the same people within " +
                                                      std::to_string(2 * window.count()) + " ms, got " + std::to_string(events));
}

void minimum_interval_limits_events(Context& context) { require_suppression(context, "minimum_interval", 3'600'000); }

void detection_threshold_suppresses_small_motions(Context& context) {
    require_suppression(context, "detection_threshold", 1'000'000);
}

}  // namespace

Clause people_clause() {
    return {
        "Effects: people",
        {{"people_who_stand_still_keep_ref_and_position", "table 36; decision 27", people_who_stand_still_keep_ref_and_position},
         {"a_condition_selects_entries_of_details", "tables 5, 36; decision 19", a_condition_selects_entries_of_details},
         {"positions_of_people_are_independent_of_the_robot", "tables 34, 36, 46; decision 27",
          positions_of_people_are_independent_of_the_robot},
         {"follow_keeps_its_distance", "tables 34, 36, 47; decisions 8, 27", follow_keeps_its_distance},
         {"only_an_active_function_reports_events", "tables 32, 36; decisions 6, 8, 9", only_an_active_function_reports_events},
         {"minimum_interval_limits_events", "table 36", minimum_interval_limits_events},
         {"detection_threshold_suppresses_small_motions", "table 36", detection_threshold_suppresses_small_motions}}};
}

}  // namespace rois::conformance
