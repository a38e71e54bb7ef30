#include "server/hall/reception.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rois::test {

namespace {

constexpr double before = 1'000;       // distance from a person at which the robot stops, mm
constexpr double still_there = 600;    // distance that a person may have moved meanwhile, mm
constexpr double same_person = 1'500;  // smallest distance of two people, mm
constexpr int listens_for = 1'000;     // real ms: 20 s in the hall
constexpr int looks_for = 400;
constexpr int watches_for = 100;

Pose pose_of(std::string const& text) {
    Pose pose;
    EXPECT_EQ(std::sscanf(text.c_str(), "%lf, %lf, %lf", &pose.x, &pose.y, &pose.th), 3) << text;
    return pose;
}

std::string text_of(Pose const& pose) {
    return std::to_string(std::lround(pose.x)) + ", " + std::to_string(std::lround(pose.y)) + ", " +
           std::to_string(std::lround(pose.th));
}

// Returns the pose a metre away from the person, `turn` degrees beside the direction of their view, looking at them.
Pose place_before(Pose const& person, double turn) {
    auto const angle = (person.th + turn) * std::numbers::pi / 180;
    return {person.x + before * std::cos(angle), person.y + before * std::sin(angle), person.th + turn + 180};
}

}  // namespace

double distance(Pose const& a, Pose const& b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::ostream& operator<<(std::ostream& out, Received const& received) {
    out << "{" << received.visitor << ", message \"" << received.message << "\", answers";
    for (auto const& words : received.answers) out << " \"" << words << "\"";
    return out << "}";
}

Reception::Reception(Transport way, GatewayProcess const& gateway, std::map<std::string, std::string> messages)
    : engine_{way, gateway}, messages_{std::move(messages)} {
    engine_.connect();
    for (auto const* ref : {"person_detection", "person_localization", "person_identification", "speech_recognition",
                            "speech_synthesis", "reaction", "navigation"})
        EXPECT_EQ(engine_.bind(ref).return_code(), "OK") << ref;
    for (auto const* event : {"person_detected", "person_localized", "person_identified", "speech_recognized", "reached_target"})
        subscriptions_.push_back(engine_.subscribe(event, "", true).text("subscribe_id"));
    start_ = where();
}

Received Reception::receive() {
    wait_for_a_person();
    auto const person = approach();
    Received received;
    received.visitor = identify();
    received.message = "Welcome. How can I help you?";
    if (!received.visitor.empty()) {
        auto const own = messages_.find(received.visitor);
        received.message = own == messages_.end() ? "Welcome. There is no message for you today." : own->second;
    }
    received.answers = say_and_listen(received.message);
    bow();
    run({{.component = "speech_synthesis", .id = fresh_id("say"), .arguments = {speech_text("Goodbye.")}}});
    received_.push_back(person);
    EXPECT_TRUE(go_to(start_)) << "back to the start";
    return received;
}

void Reception::close() {
    for (auto const& id : subscriptions_) EXPECT_EQ(engine_.unsubscribe(id).return_code(), "OK");
    run({{.component = "person_detection", .id = fresh_id("detect")}});
    run({{.component = "person_localization", .id = fresh_id("locate")}});
    EXPECT_TRUE(go_to(start_));
}

Pose Reception::where() { return pose_of(engine_.query("robot_position").values()["position_data"].at(0)); }

void Reception::wait_for_a_person() {
    run({{.component = "person_detection", .id = fresh_id("detect")}});
    while (engine_.next_event("person_detected").values()["number"].at(0) == "0") {
    }
    run({{.component = "person_detection", .type = "stop", .id = fresh_id("detected")}});
}

std::vector<Reception::Person> Reception::standing() {
    auto const notifications =
        run({{.component = "person_localization", .id = fresh_id("locate")},
             {.component = "person_localization", .type = "stop", .id = fresh_id("located"), .delay = watches_for}});
    std::map<std::string, Pose> first;
    std::vector<Person> here;  // at the last notification
    for (auto const& one : notifications) {
        if (one.text("event_type") != "person_localized") continue;
        here.clear();
        auto const results = one.values();
        auto const& refs = results.at("person_ref");
        for (std::size_t i = 0; i < refs.size(); ++i) {
            here.push_back({pose_of(results.at("position_data").at(i)), refs[i]});
            first.try_emplace(refs[i], here.back().pose);
        }
    }
    std::erase_if(here, [&](Person const& person) {
        auto const is_same = [&](Pose const& other) { return distance(person.pose, other) < same_person; };
        return distance(first.at(person.ref), person.pose) > still_there || std::ranges::any_of(received_, is_same);
    });
    return here;
}

Reception::Person Reception::locate(std::string const& ref) {
    auto here = standing();
    while (here.empty()) here = standing();
    auto const wanted = std::ranges::find(here, ref, &Person::ref);
    return wanted == here.end() ? here.front() : *wanted;
}

Pose Reception::approach() {
    auto person = locate();
    for (double const turn : {0, 60, -60, 120, -120, 0, 60, -60, 120, -120}) {
        if (!go_to(place_before(person.pose, turn))) continue;
        auto const now = locate(person.ref);
        if (distance(now.pose, person.pose) < still_there) return now.pose;
        person = now;
    }
    ADD_FAILURE() << "no way to " << person.ref;
    return person.pose;
}

bool Reception::go_to(Pose const& pose) {
    auto const id = fresh_id("go");
    driven_.push_back(id);
    auto const notifications =
        run({{.component = "navigation", .id = id, .arguments = {target_position({text_of(pose)}), time_limit("90000")}}});
    return notifications.back().text("status") == "OK";
}

std::string Reception::identify() {
    auto const notifications =
        run({{.component = "person_identification", .id = fresh_id("identify")},
             {.component = "person_identification", .type = "stop", .id = fresh_id("identified"), .delay = looks_for}});
    for (auto const& one : notifications)
        if (one.text("event_type") == "person_identified") return one.values()["person_ref"].at(0);
    return "";
}

std::vector<std::string> Reception::say_and_listen(std::string const& text) {
    auto const notifications =
        run({{.component = "speech_recognition", .id = fresh_id("listen")},
             {.component = "speech_synthesis", .id = fresh_id("say"), .arguments = {speech_text(text)}},
             {.component = "speech_recognition", .type = "stop", .id = fresh_id("listened"), .delay = listens_for}});
    std::vector<std::string> words;
    for (auto const& one : notifications)
        if (one.text("event_type") == "speech_recognized") words.push_back(one.values()["recognized_text"].at(0));
    return words;
}

void Reception::bow() {
    run({{.component = "reaction", .id = fresh_id("bow"), .arguments = {{"reaction_ref", "RoISIdentifier", {"9"}}}}});
}

std::vector<Document> Reception::run(std::vector<Command> units) {
    Xml sequence;
    for (auto const& command : units) {
        sequence += unit(command);
        commanded_.push_back(command.id);
    }
    EXPECT_EQ(engine_.execute(sequence).return_code(), "OK");
    auto const begin = history().size();
    engine_.status_of(units.back().id);
    return {history().begin() + static_cast<std::ptrdiff_t>(begin), history().end()};
}

std::string Reception::fresh_id(std::string const& of) { return of + "-" + std::to_string(commanded_.size() + 1); }

}  // namespace rois::test
