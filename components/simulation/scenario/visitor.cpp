#include "simulation/scenario/visitor.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "simulation/world/visibility.hpp"

namespace rois::simulation {
namespace {

constexpr Metres hearing = 5.0;  // at loudness 0.5, proportional to it
constexpr Radians field_of_view = from_degrees(120);
constexpr WorldTime gesture_length{1'500};
constexpr WorldTime before_answer{700};

std::string lowered(std::string_view text) {
    std::string lower{text};
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

bool fits(Answer const& answer, Happening const& happening) {
    if (happening.kind == Happening::Kind::reaction_shown) return !answer.reaction.empty() && answer.reaction == happening.text;
    if (answer.to.empty()) return false;
    return answer.to == "*" || lowered(happening.text).find(lowered(answer.to)) != std::string::npos;
}

}  // namespace

Visitor::Visitor(PersonId id, Role role, Pose const& pose, WorldTime now, FloorPlan const& plan, Planner const& planner,
                 std::uint64_t seed)
    : role_(std::move(role)), voice_(id), random_(seed), walker_(plan, planner), came_(now), action_began_(now) {
    person_.id = id;
    person_.role = role_.id;
    person_.known = role_.known;
    person_.height = role_.height;
    person_.gender = role_.gender;
    person_.age = role_.age;
    person_.pose = pose;
}

void Visitor::notice(Happening const& happening, Robot const& robot, double loudness, VisitorSurroundings const& around) {
    bool const speech = happening.kind == Happening::Kind::speech_finished;
    Metres const reach = speech ? hearing * std::sqrt(std::max(0.0, loudness) / 0.5) : hearing;
    if (ignores_ || !reaches(around.plan, person_.pose, robot.pose.position, reach, field_of_view)) return;
    addressed_ = around.now;
    if (talks_left_ > 0) patience_ = usual_patience;
    talks_left_ = std::max(0, talks_left_ - 1);
    for (std::size_t i = 0; i < role_.answers.size() && pending_.size() < most_pending; ++i) {
        if (!fits(role_.answers[i], happening) || !is_open(i)) continue;
        pending_.push_back({i, around.now + before_answer});
        return;
    }
}

bool Visitor::is_open(std::size_t answer) const {
    if (!role_.answers[answer].once) return true;
    return std::ranges::find(answered_, answer) == answered_.end() &&
           std::ranges::find(pending_, answer, &Pending::answer) == pending_.end();
}

void Visitor::step(VisitorSurroundings& around) {
    end_speech_and_gesture(around);
    mind_robots(around);
    answer(around);
    person_.velocity = Point::Zero();
    play(around);
    turn(around);
}

void Visitor::end_speech_and_gesture(VisitorSurroundings& around) {
    voice_.step(around.now, person_.pose.position, around.chronicle);
    person_.speaking = voice_.speech();
    if (person_.gesturing && around.now >= person_.gesturing->ends) person_.gesturing.reset();
}

void Visitor::say(std::string text, std::string language, VisitorSurroundings& around) {
    Seconds const duration = basic::speech_duration(text);
    voice_.speak({{{.text = std::move(text), .language = std::move(language), .duration = duration}}}, around.now,
                 person_.pose.position, around.chronicle);
    person_.speaking = voice_.speech();
}

void Visitor::make_gesture(std::string id, VisitorSurroundings& around) {
    person_.gesturing = Gesturing{std::move(id), around.now + gesture_length};
    around.chronicle.add(
        {0, around.now, Happening::Kind::gesture_made, person_.id, person_.pose.position, person_.gesturing->id, {}, 0, {}});
}

void Visitor::answer(VisitorSurroundings& around) {
    if (pending_.empty() || around.now < pending_.front().due || person_.speaking || person_.gesturing) return;
    std::size_t const index = pending_.front().answer;
    pending_.pop_front();
    Answer const& given = role_.answers[index];
    if (given.once) answered_.push_back(index);
    if (!given.gesture.empty()) make_gesture(given.gesture, around);
    if (!given.text.empty()) say(given.text, given.language, around);
}

void Visitor::play(VisitorSurroundings& around) {
    if (gone_) return;
    if (action_ >= role_.actions.size()) role_.actions.push_back({Leave{}, std::nullopt});
    ScriptedAction const& action = role_.actions[action_];
    if (action.at && in_seconds(around.now - came_) < *action.at) return;
    Doing const doing = std::visit([&](auto const& what) { return act(what, around); }, action.what);
    action_fresh_ = false;
    if (doing == Doing::still) return;
    if (std::holds_alternative<Leave>(action.what)) gone_ = true;
    next_action(around.now);
}

void Visitor::next_action(WorldTime now) {
    ++action_;
    action_began_ = now;
    action_fresh_ = true;
    walker_.stop();
}

}  // namespace rois::simulation
