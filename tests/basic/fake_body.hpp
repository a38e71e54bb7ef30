// A body of plain fakes: tests set what it reports, and read what components asked of it.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "basic/adapters/robots.hpp"
#include "basic/body/body.hpp"
#include "basic/fake_media.hpp"
#include "basic/operated.hpp"

namespace rois::basic::stage {

struct FakeBase final : MobileBase {
    std::variant<MotionId, Rejection> begin(std::string_view asking, Motion motion) override {
        if (rejection) return *rejection;
        owner = asking;
        motions.push_back(std::move(motion));
        now = {MotionState::moving, 0};
        return MotionId{motions.size()};
    }
    Progress progress(MotionId) const override { return now; }
    void stop(MotionId) override {
        now.state = MotionState::ended;
        report.stopping = brakes_slowly;
    }
    void hold(MotionId) override { now.state = MotionState::held; }
    void go_on(MotionId) override { now.state = MotionState::moving; }
    void brake(bool on) override { report.brakes = on; }
    void limit_speed(std::optional<MetresPerSecond> speed) override { limit = speed; }
    BaseStatus status() const override { return report; }

    template <class Kind>
    Kind const& last() const {
        return std::get<Kind>(motions.back());
    }

    std::optional<Rejection> rejection;  // of the next motions
    bool brakes_slowly = false;          // whether the robot still moves after stop()
    BaseStatus report;
    Progress now;  // of the last motion
    std::string owner;
    std::vector<Motion> motions;
    std::optional<MetresPerSecond> limit;
};

struct FakeSpeech final : SpeechOutput {
    UtteranceId speak(Utterance utterance) override {
        said.push_back(std::move(utterance));
        now = SpeechState::speaking;
        return UtteranceId{said.size()};
    }
    SpeechState state(UtteranceId) const override { return now; }
    void break_off(UtteranceId) override { now = SpeechState::broken; }
    void hold(UtteranceId) override { now = SpeechState::held; }
    void go_on(UtteranceId) override { now = SpeechState::speaking; }
    std::optional<std::string> speaking() const override {
        if (now != SpeechState::speaking) return {};
        return said.back().passages.front().character;
    }

    SpeechState now = SpeechState::spoken;  // of the last utterance
    std::vector<Utterance> said;
};

struct FakePerception final : Perception {
    std::vector<Sighting> sightings(Sense sense) const override {
        auto const found = seen.find(sense);
        return found == seen.end() ? std::vector<Sighting>{} : found->second;
    }
    Metres sigma(Sense) const override { return noise; }
    std::vector<RecognizedPerson> recognized() const override { return people; }
    std::optional<EntityId> find(std::string_view ref, std::string_view) const override {
        auto const found = names.find(ref);
        return found == names.end() ? std::nullopt : std::optional{found->second};
    }
    bool knows(std::string_view ref) const override { return names.contains(ref); }
    std::uint64_t last_sequence() const override { return last; }
    std::vector<SpeechEvent> speech_since(std::uint64_t sequence) const override {
        std::vector<SpeechEvent> later;
        std::ranges::copy_if(speech, std::back_inserter(later), [&](auto const& event) { return event.sequence > sequence; });
        return later;
    }
    std::vector<std::string> gestures_since(std::uint64_t sequence) const override {
        std::vector<std::string> later;
        for (auto const& [number, gesture] : gestures)
            if (number > sequence) later.push_back(gesture);
        return later;
    }

    void hear(SpeechEvent event) {
        event.sequence = ++last;
        speech.push_back(std::move(event));
    }
    // Somebody at (1, 0) says this, from beginning to end.
    void hear(std::string const& text, std::string const& language = "en") {
        Point const place{1, 0};
        Sighting const source{EntityId{5}, "sound-5", {place, 0}, 1.6, Covariance::Identity() * 0.01};
        hear({.kind = SpeechEvent::Kind::began, .speaker = EntityId{5}, .place = place, .source = source});
        hear({.kind = SpeechEvent::Kind::ended, .speaker = EntityId{5}, .place = place, .text = text, .language = language});
    }
    void see_gesture(std::string gesture) { gestures.emplace_back(++last, std::move(gesture)); }

    std::map<Sense, std::vector<Sighting>> seen;
    Metres noise = 0.02;
    std::vector<RecognizedPerson> people;
    std::map<std::string, EntityId, std::less<>> names;
    std::uint64_t last = 0;
    std::vector<SpeechEvent> speech;
    std::vector<std::pair<std::uint64_t, std::string>> gestures;
};

struct FakeCamera final : Camera {
    void capture() override { ++captures; }
    std::optional<media::Picture> picture(std::uint16_t longest) const override {
        return media::Picture{.width = longest, .height = 1, .rgb = {}};
    }

    int captures = 0;
};

class FakeBody final : public Body {
public:
    explicit FakeBody(std::string name = "fake") : name_{std::move(name)} {}

    std::string const& name() const override { return name_; }
    bool returns_at_once() const override { return !may_block; }
    EntityId self() const override { return EntityId{1}; }
    std::string const& crs() const override { return crs_; }
    bool uses_engines_frame() const override { return true; }
    std::vector<NamedPlace> const& places() const override { return places_; }
    std::optional<double> battery() const override { return charge; }
    Pose pose() const override { return {Point{1, 2}, 0}; }
    PoseEstimate measured_pose() const override { return {{Point{1.001, 2}, 0}, Covariance::Identity() * 1e-4}; }
    void join(Observer& observer) override { observers_.push_back(&observer); }
    void part(Observer& observer) override { std::erase(observers_, &observer); }
    WorldTime now() const override { return now_; }

    MobileBase& base() override { return wheels; }
    SpeechOutput& speech() override { return voice; }
    Perception const& perception() const override { return senses; }
    std::shared_ptr<Camera> camera() override { return eye; }
    void show(std::string const& reaction, Seconds duration) override { shown = {reaction, duration}; }
    void stop_showing() override { shown.reset(); }

    void step(Instant when, WorldTime length) {
        now_ += length;
        for (auto* observer : observers_) observer->observe(when);
        for (auto* observer : observers_) observer->time_passed(when);
    }
    std::size_t observers() const { return observers_.size(); }

    bool may_block = false;
    std::optional<double> charge;
    FakeBase wheels;
    FakeSpeech voice;
    FakePerception senses;
    std::shared_ptr<FakeCamera> eye = std::make_shared<FakeCamera>();
    std::optional<std::pair<std::string, Seconds>> shown;  // the reaction in progress

private:
    std::string name_;
    std::string crs_ = "urn:test::frame";
    std::vector<NamedPlace> places_{{"desk", {Point{3, 2}, from_degrees(90)}}, {"door", {Point{9, 2}, 0}}};
    std::vector<Observer*> observers_;
    WorldTime now_{0};
};

// All components on one fake body.
class FakeRobot : public testing::Test {
protected:
    FakeRobot() {
        for (auto& component : robot_components({.bodies = {body}, .media = media}, own_profiles())) add(std::move(component));
        step();
    }

    Operated& add(std::unique_ptr<Component> component) {
        std::string const ref = component->description().ref.code;
        auto operated = std::make_unique<Operated>(
            std::move(component), [this] { return now_; }, [this] { return body->now(); });
        return *operated_.emplace(ref, std::move(operated)).first->second;
    }

    Operated& operator[](std::string const& ref) { return *operated_.at(ref); }

    // Lets the body's world pass by `length`, in one step.
    void step(WorldTime length = WorldTime{20}) {
        now_ = now_ + length;
        body->step(now_, length);
        for (auto const& [ref, operated] : operated_) operated->after_step();
    }

    std::string refusal(std::string const& ref, std::string const& command_type, ParameterList const& parameters) {
        return (*this)[ref].refusal(command_type, parameters).value_or("accepted");
    }

    std::shared_ptr<FakeBody> body = std::make_shared<FakeBody>();
    std::shared_ptr<FakeMedia> media = std::make_shared<FakeMedia>();

private:
    Instant now_{Steady{}, Utc{std::chrono::seconds{1'800'000'000}}};
    std::map<std::string, std::unique_ptr<Operated>, std::less<>> operated_;
};

}  // namespace rois::basic::stage
