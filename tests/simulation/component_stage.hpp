// A hall with one or two robots. Tests operate the components like the engine, with a manual clock.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basic/adapters/adapters.hpp"
#include "basic/fake_media.hpp"
#include "basic/operated.hpp"
#include "simulation/adapters/robots.hpp"
#include "types/text/texts.hpp"

namespace rois::simulation::stage {

using namespace basic;
using namespace basic::stage;

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
        for (auto& component : robot_components(robots(simulation_, media_), bare_profiles())) operate(std::move(component));
    }

    // The first robot's component with the profile of this file.
    Operated& add(std::string const& profile) { return add(shipped_profile(profile)); }
    Operated& add(ComponentProfile const& profile) {
        auto components = Adapters{robots(simulation_, media_), schemas()}.components(profile, own_profiles());
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
        for (auto const& [ref, operated] : operated_) operated->after_step();
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

}  // namespace rois::simulation::stage
