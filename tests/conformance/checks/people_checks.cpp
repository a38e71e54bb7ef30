// People who are localized, seen from a moving robot, and followed (tables 34, 36 and 47; decisions 8, 9, 27). A person
// has to be in front of the robot.
#include <algorithm>
#include <cmath>
#include <set>

#include "conformance/driver.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto localized = "person_localized";
constexpr double nearest = 1'000;  // mm between the robot and somebody

struct Person {
    std::string ref;
    Point at;
    double sigma = 50;  // mm
};

// The people of one event, or of its details.
std::vector<Person> people_in(Document const& event) {
    auto const results = event.values();
    auto const refs = results.find("person_ref"), positions = results.find("position_data");
    if (refs == results.end() || positions == results.end()) return {};
    require(refs->second.size() == positions->second.size(),
            "there should be a position for each of " + list(refs->second) + ", and there are " + list(positions->second));
    std::vector<Person> people;
    for (std::size_t i = 0; i < refs->second.size(); ++i) {
        auto const at = point_in(positions->second[i]);
        if (!at) throw NotObservable{"a position is not in coordinates: " + positions->second[i]};
        people.push_back({refs->second[i], *at});
    }
    for (auto const located : event.root().child("results").children("located")) {
        auto const found = std::ranges::find(people, std::string{located.attribute("ref").value()}, &Person::ref);
        auto const deviations = deviations_in(located.child("covariance").text().get());
        if (found != people.end() && deviations) found->sigma = deviations->first;
    }
    return people;
}

Component const& localization_beside(Stage const& stage, Component const* other) {
    for (auto const& component : stage.catalogue().components)
        if (component.basic() == "personlocalization" && (!other || component.engine == other->engine)) return component;
    throw NotPlayed{"there is no person localization" + (other ? " of the robot of " + other->ref : "")};
}

// Localizes people.
class Lookout {
public:
    Lookout(Stage& stage, Guest& guest, Component const* beside = nullptr)
        : localization{localization_beside(stage, beside)}, stage_{stage}, guest_{guest} {
        guest_.take(localization);
        require_somebody();
        ok(guest_.subscribe(localized, only(localization), true));
    }

    void start() { guest_.require_success(guest_.order(command(localization, "start")), localization); }
    void end(std::string const& type) {
        same("the status of " + type + " of " + localization.ref, "OK", guest_.ending(command(localization, type)));
    }

    // Returns the people of the first measurement after a start, by their distance to `from`. Throws NotObservable without
    // people.
    std::vector<Person> people(Point const& from) {
        end("stop");
        catch_up();
        auto const before = guest_.history().size();
        start();
        auto event = guest_.heard_since(before, localized);
        if (!event) event = next(stage_.patience());
        end("stop");
        if (!event) throw NotObservable{"no person is localized"};
        auto found = people_in(*event);
        if (found.empty()) throw NotObservable{"no person is localized"};
        std::ranges::sort(found, {}, [&](Person const& person) { return distance(from, person.at); });
        return found;
    }

    // The next event, if one comes in time.
    std::optional<Document> next(milliseconds time) {
        for (auto const end = Clock::now() + time; Clock::now() < end; wait(milliseconds{10})) {
            for (auto heard = hear_now(); heard; heard = hear_now())
                if (heard->text("event_type") == localized) return heard;
        }
        return {};
    }

    // How many come in this time.
    std::size_t count(milliseconds time) {
        auto const end = Clock::now() + time;
        std::size_t events = 0;
        while (Clock::now() < end)
            if (next(std::chrono::duration_cast<milliseconds>(end - Clock::now()))) ++events;
        return events;
    }

    // The time in which some events came after a start. NotObservable when people do not move.
    milliseconds time_of_some_events() {
        auto const begin = Clock::now();
        for (int i = 0; i < some_events; ++i)
            if (!next(stage_.patience())) throw NotObservable{"no localized person moves"};
        constexpr milliseconds least{300};
        return std::max(least, std::chrono::duration_cast<milliseconds>(Clock::now() - begin));
    }

    void catch_up() {
        while (hear_now()) {
        }
    }

    static constexpr int some_events = 4;

    Component const& localization;

private:
    // Over a WebSocket, received notifications are read with an answer.
    std::optional<Document> hear_now() {
        if (auto heard = guest_.hear_now()) return heard;
        if (stage_.way() == Way::websocket) guest_.search(only(localization));
        return guest_.hear_now();
    }

    // A parallel detection reports zero people with its first measurement; without it, this waits until the timeout.
    void require_somebody() {
        for (auto const& detection : stage_.catalogue().components) {
            if (detection.basic() != "persondetection" || detection.engine != localization.engine) continue;
            if (!detection.event(detection.detection()) || guest_.bind(detection.ref).return_code() != "OK") continue;
            auto const id = ok(guest_.subscribe(detection.detection(), only(detection), true)).text("subscribe_id");
            auto const number = value_of(guest_.start_until(detection, detection.detection()).values(), "number");
            guest_.ending(command(detection, "stop"));
            ok(guest_.unsubscribe(id));
            ok(guest_.release(detection.ref));
            if (number == "0") throw NotObservable{detection.ref + " detects no person"};
        }
    }

    Stage& stage_;
    Guest& guest_;
};

std::optional<Person> same_person(std::vector<Person> const& people, Person const& person) {
    auto const found = std::ranges::find(people, person.ref, &Person::ref);
    return found == people.end() ? std::nullopt : std::optional{*found};
}

// How far two measurements of somebody who stands may lie apart.
double errors_of(Person const& person) { return noise(person.sigma) + 50; }

// How far the robot may come up to somebody, so that the difference can be seen.
double way_up_to(Driver const& driver, Person const& person) {
    auto const way = std::min(driver.stage.room(), distance(driver.home.at, person.at) - nearest);
    auto const needed = 1.4 * (errors_of(person) + tolerance(driver.home, way));
    if (way < needed)
        throw NotObservable{person.ref + " is " + std::to_string(std::lround(distance(driver.home.at, person.at))) +
                            " mm away. To see a robot come up to them, --room " + std::to_string(std::lround(needed)) +
                            " is needed, and " + std::to_string(std::lround(nearest + needed)) + " mm between them"};
    return way;
}

void people_who_stand_still_keep_name_and_place(Stage& stage) {
    Guest guest{stage};
    Lookout lookout{stage, guest};
    auto const first = lookout.people({}), second = lookout.people({}), third = lookout.people({});
    for (auto const* const people : {&first, &second, &third}) {
        std::set<std::string> refs;
        for (auto const& person : *people) refs.insert(person.ref);
        require(refs.size() == people->size(), "two of the people who are localized have one name");
    }
    bool stands = false;
    for (auto const& person : first) {
        auto const is_near = [&](Person const& other) { return distance(person.at, other.at) <= errors_of(person); };
        if (std::ranges::none_of(second, is_near) || std::ranges::none_of(third, is_near)) continue;  // has walked
        stands = true;
        auto const later = same_person(third, person);
        require(later && is_near(*later),
                "somebody stands at " + text_of(person.at) + ", who was called " + person.ref + " at first and is not any more");
    }
    if (!stands) throw NotObservable{"no person stands still"};
}

void details_have_the_entries_that_match(Stage& stage) {
    Guest guest{stage};
    Lookout lookout{stage, guest};
    lookout.start();
    std::optional<Document> event;
    for (auto const end = Clock::now() + stage.patience(); !event || people_in(*event).size() < 2;) {
        if (Clock::now() >= end) throw NotObservable{"there are no two people who are localized together"};
        event = lookout.next(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
    }
    auto const people = people_in(*event);
    auto const& chosen = people.back();
    auto const answer = ok(guest.get_event_detail(event->text("event_id"), kit::where(kit::equal("person_ref", chosen.ref))));
    auto const found = people_in(answer);
    require(found.size() == 1 && found.front().ref == chosen.ref && distance(found.front().at, chosen.at) < 1,
            "of " + std::to_string(people.size()) + " people, person_ref = " + chosen.ref + " should choose the one at " +
                text_of(chosen.at) + ": " + answer.whole());
    auto const results = answer.root().child("results").children("located");
    for (auto const located : results) same("the person of an element `located`", chosen.ref, located.attribute("ref").value());
    require(answer.values().contains("timestamp"), "values other than a list should stay: " + answer.whole());
}

void people_are_where_the_robot_drives_to(Stage& stage) {
    Driver driver{stage, stage.one_of({"navigation"})};
    Lookout lookout{stage, driver.guest, &driver.wheels};
    auto const person = lookout.people(driver.home.at).front();
    auto const way = way_up_to(driver, person);
    auto target = ahead(driver.home.at, way, direction(driver.home.at, person.at));
    if (target.heading) target.heading = direction(driver.home.at, person.at);
    auto const drive = [&](Point const& place) {
        auto const status = driver.go({argument(driver.wheels, "target_position", {text_of(place)})}).status;
        if (status != "OK") throw NotObservable{"the way to " + text_of(place) + " ended with " + status};
        driver.require_at(place);
    };
    drive(target);
    auto const from_there = same_person(lookout.people(target), person);
    auto const stays = [&](std::optional<Person> const& seen) {
        return seen && distance(seen->at, person.at) <= errors_of(person) + tolerance(driver.home, 0);
    };
    if (stays(from_there)) return;
    drive(driver.home.at);
    if (!stays(same_person(lookout.people(driver.home.at), person))) throw NotObservable{person.ref + " does not stand still"};
    throw Broken{person.ref + " stands at " + text_of(person.at) + ", and is reported " +
                 (from_there ? "at " + text_of(from_there->at) : "nowhere") + " when the robot is at " + text_of(target)};
}

void follow_keeps_its_distance(Stage& stage) {
    Driver driver{stage, stage.one_of({"follow"})};
    Lookout lookout{stage, driver.guest, &driver.wheels};
    auto const person = lookout.people(driver.home.at).front();
    auto const due = std::lround(distance(driver.home.at, person.at) - way_up_to(driver, person));
    auto const trip = driver.set_off(
        {argument(driver.wheels, "target_object_ref", {person.ref}), argument(driver.wheels, "distance", {std::to_string(due)})});
    if (trip.status == "ERROR") throw NotObservable{driver.wheels.ref + " follows only whom it sees"};
    same("the status of a follow that was not stopped", "", trip.status);
    auto resting = driver.eye.look();
    constexpr milliseconds long_enough{700};
    for (auto last = Clock::now(); Clock::now() - last < long_enough; wait(milliseconds{20})) {
        auto const seen = driver.eye.look();
        if (distance(seen.at, resting.at) <= noise(seen)) continue;
        resting = seen;
        last = Clock::now();
    }
    resting = driver.eye.look();
    auto const kept = distance(resting.at, person.at);
    same("the status of stop", "OK", driver.guest.ending(command(driver.wheels, "stop")));
    auto const later = same_person(lookout.people(resting.at), person);
    if (!later || distance(later->at, person.at) > errors_of(person) + tolerance(resting, 0))
        throw NotObservable{person.ref + " does not stand still"};
    require(std::abs(kept - static_cast<double>(due)) <= errors_of(person) + tolerance(resting, 0),
            "the robot should be " + std::to_string(due) + " mm from " + person.ref + ", who is at " + text_of(person.at) +
                ", and is reported " + std::to_string(std::lround(kept)) + " mm away at " + shown(resting));
}

void an_active_function_reports_events(Stage& stage) {
    Guest guest{stage};
    Lookout lookout{stage, guest};
    lookout.start();
    auto const window = lookout.time_of_some_events();
    auto const silent = [&](std::string const& when) {
        lookout.catch_up();
        require(lookout.count(2 * window) == 0, "events of " + lookout.localization.ref + " come after " + when);
    };
    lookout.end("suspend");
    silent("suspend");
    lookout.end("resume");
    bool const goes_on = lookout.next(stage.patience()).has_value();
    lookout.end("stop");
    silent("stop");
    lookout.start();
    lookout.time_of_some_events();
    require(goes_on, "people move, and no event of " + lookout.localization.ref + " comes after resume");
    ok(guest.release(lookout.localization.ref));
    lookout.catch_up();
    std::size_t heard = guest.heard_events(localized);
    wait(2 * window);
    guest.search(only(lookout.localization));
    lookout.catch_up();
    require(guest.heard_events(localized) == heard, "events of " + lookout.localization.ref + " come after release");
}

// With this value of the parameter, only the first measurement after a start is an event.
void one_event_alone(Stage& stage, std::string const& parameter, int value) {
    Guest guest{stage};
    Lookout lookout{stage, guest};
    auto const large = argument(lookout.localization, parameter, {std::to_string(value)});
    lookout.start();
    auto const window = lookout.time_of_some_events();
    lookout.end("stop");
    auto const set = guest.set_parameter(lookout.localization.ref, {large});
    if (set.return_code() == "BAD_PARAMETER") throw NotObservable{parameter + " cannot be so large: " + set.reason()};
    same("the status of set_parameter", "OK", guest.status_of(ok(set).text("command_id")));
    lookout.catch_up();
    lookout.start();
    auto const events = lookout.count(2 * window);
    lookout.end("stop");
    // The first person who comes into sight is an event.
    require(events < Lookout::some_events, "with " + parameter + " = " + std::to_string(value) + ", " + std::to_string(events) +
                                               " events came within " + std::to_string(2 * window.count()) + " ms");
}

void minimum_interval_spaces_events(Stage& stage) { one_event_alone(stage, "minimum_interval", 3'600'000); }

void detection_threshold_holds_small_motions_back(Stage& stage) { one_event_alone(stage, "detection_threshold", 1'000'000); }

}  // namespace

Clause people_clause() {
    return {"Effects: people",
            {{"people_who_stand_still_keep_name_and_place", "table 36; decision 27", people_who_stand_still_keep_name_and_place},
             {"details_have_the_entries_that_match", "tables 5, 36; decision 19", details_have_the_entries_that_match},
             {"people_are_where_the_robot_drives_to", "tables 34, 36, 46; decision 27", people_are_where_the_robot_drives_to},
             {"follow_keeps_its_distance", "tables 34, 36, 47; decisions 8, 27", follow_keeps_its_distance},
             {"an_active_function_reports_events", "tables 32, 36; decisions 6, 8, 9", an_active_function_reports_events},
             {"minimum_interval_spaces_events", "table 36", minimum_interval_spaces_events},
             {"detection_threshold_holds_small_motions_back", "table 36", detection_threshold_holds_small_motions_back}}};
}

}  // namespace rois::conformance
