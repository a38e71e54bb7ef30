// A hall with one or two robots. Tests operate the components like the engine, with a manual clock.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/files.hpp"
#include "simulation/adapters/adapters.hpp"
#include "simulation/adapters/robot_components.hpp"
#include "simulation/streaming/fake_media.hpp"
#include "types/texts.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois::simulation::stage {

// A report of a component: an event, or the progress of a command.
struct LogEntry {
    std::string what;  // the event's type, or "started", or "completed OK"
    Results results;   // of an event
    WorldTime at{};
};

// One component with its port. Stores the parameters like the engine.
class Operated final : public ComponentPort {
public:
    Operated(std::unique_ptr<Component> component, std::function<Instant()> now, std::function<WorldTime()> world_now)
        : component_{std::move(component)}, now_{std::move(now)}, world_now_{std::move(world_now)} {
        component_->attach(*this);
    }

    Component& component() { return *component_; }

    // Returns why the command is refused with these parameters merged into the stored ones.
    std::optional<std::string> refusal(std::string const& command_type, ParameterList const& arrived) const {
        return component_->refusal(command_type, merged(arrived));
    }

    void set_parameter(ParameterList const& arrived) {
        stored_ = merged(arrived);
        component_->parameters_changed(stored_, now_());
    }

    void start(ParameterList const& arrived = {}) {
        if (runs_) component_->halt(now_());
        stored_ = merged(arrived);
        runs_ = true;
        component_->start(CommandHandle{++last_}, stored_, now_());
    }

    // A command of the component's own profile.
    void perform(std::string_view command_type, ParameterList const& arguments) {
        component_->perform(CommandHandle{++last_}, command_type, arguments, now_());
    }

    Halted stop() {
        runs_ = false;
        return component_->halt(now_());
    }
    void suspend() { component_->suspend(now_()); }
    void resume() { component_->resume(now_()); }
    std::vector<Results> rows(std::string_view type) { return component_->query(type, now_()); }
    Results query(std::string_view type) {
        auto all = rows(type);
        return all.empty() ? Results{} : all.front();
    }
    ParameterList const& stored() const { return stored_; }

    // The outcome of the last `start`; nothing if it has not ended.
    std::optional<std::string> ended() const {
        for (auto entry = log_.rbegin(); entry != log_.rend() && entry->what != "started"; ++entry)
            if (entry->what.starts_with("completed")) return entry->what.substr(std::string{"completed "}.size());
        return {};
    }

    // Of the last command that completed.
    Results const& results() const { return last_results_; }
    Afterwards afterwards() const { return last_afterwards_; }
    std::string const& reason() const { return last_reason_; }

    std::vector<LogEntry> const& log() const { return log_; }
    std::vector<std::string> words() const {
        std::vector<std::string> all;
        for (auto const& entry : log_) all.push_back(entry.what);
        return all;
    }
    std::vector<LogEntry> events(std::string_view type) const {
        std::vector<LogEntry> found;
        for (auto const& entry : log_)
            if (entry.what == type) found.push_back(entry);
        return found;
    }
    void forget() { log_.clear(); }
    // By default, only the last command may complete.
    void allow_any_command() { any_command_ = true; }

    void halted() override { record("halted", {}); }
    void started(CommandHandle) override { record("started", {}); }
    void completed(CommandHandle command, CompletedStatus status, Results results, Afterwards afterwards,
                   std::string reason) override {
        if (!any_command_) {
            EXPECT_EQ(static_cast<std::uint64_t>(command), last_);
        }
        last_results_ = std::move(results);
        last_afterwards_ = afterwards;
        last_reason_ = std::move(reason);
        runs_ = afterwards == Afterwards::active;
        record("completed " + std::string{to_text(status)} + (runs_ ? ", active" : ""), {});
    }
    void event(std::string_view type, Results results) override { record(std::string{type}, std::move(results)); }
    void error(ErrorType, std::string text, Report report) override {
        record((report == Report::once ? "error, once: " : "error ") + text, {});
    }

private:
    ParameterList merged(ParameterList const& arrived) const {
        ParameterList all = stored_;
        for (auto const& parameter : arrived) {
            std::erase_if(all, [&](Parameter const& p) { return p.name == parameter.name; });
            all.push_back(parameter);
        }
        component_->reconcile(all, arrived);
        return all;
    }
    void record(std::string what, Results results) { log_.push_back({std::move(what), std::move(results), world_now_()}); }

    std::unique_ptr<Component> component_;
    std::function<Instant()> now_;
    std::function<WorldTime()> world_now_;
    ParameterList stored_;
    std::uint64_t last_ = 0;
    bool runs_ = false;
    bool any_command_ = false;
    Results last_results_;
    std::string last_reason_;
    Afterwards last_afterwards_ = Afterwards::as_before;
    std::vector<LogEntry> log_;
};

// 12 m by 8 m. The robot stands at (2, 4) and looks along x, to the entrance at (11, 4). A wall closes off the upper right
// corner.
inline FloorPlan reception() {
    FloorPlan plan;
    plan.name = "reception";
    plan.bounds = {Point{0, 0}, Point{12, 8}};
    plan.walls = {{Point{8, 8}, Point{8, 6}}, {Point{8, 6}, Point{12, 6}}};
    plan.places = {{"entrance", {Point{11, 4}, from_degrees(180)}},
                   {"exit", {Point{11, 1}, 0}},
                   {"desk", {Point{3, 2}, from_degrees(90)}},
                   {"start", {Point{2, 4}, 0}}};
    RobotPlan robot;
    robot.name = "robot";
    robot.start = {Point{2, 4}, 0};
    plan.robots = {robot};
    return plan;
}

inline FloorPlan reception_with_two_robots() {
    FloorPlan plan = reception();
    RobotPlan second = plan.robots.front();
    second.name = "robot2";
    second.start = {Point{2, 6}, 0};
    plan.robots.push_back(second);
    return plan;
}

inline std::vector<ComponentProfile> bare_profiles() {
    std::vector<ComponentProfile> profiles;
    for (auto name : {"SystemInformation", "PersonDetection", "PersonLocalization", "PersonIdentification", "FaceDetection",
                      "FaceLocalization", "SoundDetection", "SoundLocalization", "SpeechRecognition", "GestureRecognition",
                      "SpeechSynthesis", "Reaction", "Navigation", "Follow", "Move", "AudioStreaming", "VideoStreaming"}) {
        ComponentProfile profile;
        profile.object.identifier = "urn:x-rois:def:Component:omg::" + std::string{name};
        profiles.push_back(std::move(profile));
    }
    return profiles;
}

inline std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const compiled = std::make_shared<xml::Schemas const>(files::schemas());
    return compiled;
}

// The profiles of the basic components.
inline std::vector<ComponentProfile> own_profiles() {
    std::vector<ComponentProfile> profiles;
    for (auto const& [name, text] : files::profiles())
        profiles.push_back(xml::read_component_profile(schemas(), name, std::string{text}));
    return profiles;
}

// An example of a user-defined component (components/simulation/profiles).
inline ComponentProfile shipped_profile(std::string const& file) {
    std::ifstream in{std::string{ROIS_SOURCE_DIR "/components/simulation/profiles/"} + file};
    return xml::read_component_profile(schemas(), file, {std::istreambuf_iterator<char>{in}, {}});
}

// An identifier with only a code.
inline Identifier coded(std::string code) {
    return {.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}};
}

// A list of numbers: "1000 90".
inline Parameter integers(std::string name, std::string numbers) {
    return {std::move(name), coded("int[]"), {std::move(numbers)}};
}

// Parts of a visitor's role.
inline Whereabouts at(double x, double y) { return {Point{x, y}}; }
inline Whereabouts at(std::string name) { return {std::move(name)}; }
template <class Doing>
ScriptedAction does(Doing doing, std::optional<Seconds> when = {}) {
    return {std::move(doing), when};
}

inline Role visitor(std::string id, std::vector<ScriptedAction> actions, Seconds enters = 0) {
    Role role;
    role.id = std::move(id);
    role.language = "en";
    role.enters = enters;
    role.actions = std::move(actions);
    return role;
}

inline Role known(Role role) {
    role.known = true;
    return role;
}

class Stage {
public:
    explicit Stage(std::vector<Role> roles = {}, FloorPlan plan = reception(), std::vector<Fault> faults = {}, double speed = 1) {
        Scenario scenario;
        scenario.name = "test";
        scenario.faults = std::move(faults);
        scenario.roles = std::move(roles);
        simulation_ = std::make_shared<Simulation>(std::move(plan), std::move(scenario), 7, speed);
        for (auto& component : robot_components(simulation_, media_, bare_profiles())) operate(std::move(component));
    }

    // The first robot's component with the profile of this file.
    Operated& add(std::string const& profile) { return add(shipped_profile(profile)); }
    Operated& add(ComponentProfile const& profile) {
        auto components = Adapters{simulation_, media_, schemas()}.components(profile, own_profiles());
        return operate(std::move(components.at(0)));
    }

    Operated& operator[](std::string const& ref) { return *operated_.at(ref); }
    std::vector<std::string> refs() const {
        std::vector<std::string> all;
        for (auto const& [ref, operated] : operated_) all.push_back(ref);
        return all;
    }
    Hall& hall() { return simulation_->hall(); }
    FakeMedia& media() { return *media_; }
    Robot const& robot_state(std::uint32_t index = 0) { return hall().robot(RobotId{index}); }
    Pose robot(std::uint32_t index = 0) { return robot_state(index).pose; }
    Instant now() const { return now_; }

    void step() {
        now_ = now_ + Hall::step_length;
        simulation_->step(now_);
    }
    void run(Seconds seconds) {
        for (auto const end = hall().now() + world_time(seconds); hall().now() < end;) step();
    }
    // Returns whether the condition became true within `at_most`.
    bool run_until(std::function<bool()> const& come_about, Seconds at_most = 60) {
        for (auto const end = hall().now() + world_time(at_most); hall().now() < end;) {
            if (come_about()) return true;
            step();
        }
        return come_about();
    }
    // Waits for the outcome of the component's last `start`.
    std::string outcome(std::string const& ref, Seconds at_most = 60) {
        run_until([&] { return (*this)[ref].ended().has_value(); }, at_most);
        return (*this)[ref].ended().value_or("not ended");
    }

private:
    Operated& operate(std::unique_ptr<Component> component) {
        std::string const ref = component->description().ref.code;
        auto operated = std::make_unique<Operated>(
            std::move(component), [this] { return now_; }, [this] { return hall().now(); });
        return *operated_.emplace(ref, std::move(operated)).first->second;
    }

    std::shared_ptr<Simulation> simulation_;
    std::shared_ptr<FakeMedia> media_ = std::make_shared<FakeMedia>();
    Instant now_{Steady{}, Utc{std::chrono::seconds{1'800'000'000}}};
    std::map<std::string, std::unique_ptr<Operated>, std::less<>> operated_;
};

// Readers of results.
inline std::string value(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr || parameter->values.empty() ? "none" : parameter->values.front();
}
inline std::vector<std::string> values(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr ? std::vector<std::string>{"none"} : parameter->values;
}
inline std::string codebook_of(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr ? "none" : parameter->data_type_ref.codebook_ref;
}

}  // namespace rois::simulation::stage
