// Halls for tests: small ones, and the shipped ones.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "files/files.hpp"
#include "simulation/plan/floor_plan_file.hpp"
#include "simulation/scenario/scenario_file.hpp"
#include "simulation/world/hall.hpp"

namespace rois::simulation {

using namespace basic;

// 10 m by 8 m without inner walls. The entrance is at (9, 4), the desk at (5, 7). robot1 stands at (2, 4) and looks along x.
inline FloorPlan plain_hall() {
    FloorPlan plan;
    plan.name = "plain";
    plan.bounds = {Point{0, 0}, Point{10, 8}};
    plan.places = {{"entrance", {Point{9, 4}, from_degrees(180)}}, {"desk", {Point{5, 7}, from_degrees(90)}}};
    RobotPlan robot;
    robot.name = "robot1";
    robot.start = {Point{2, 4}, 0};
    plan.robots = {robot};
    return plan;
}

// The plain hall with a wall at x = 5, which has a door from y = 6 to the upper edge.
inline FloorPlan divided_hall() {
    FloorPlan plan = plain_hall();
    plan.places[1].pose.position = Point{7, 7};
    plan.walls = {{Point{5, 0}, Point{5, 6}}};
    return plan;
}

// The plain hall with robot2 at (8, 4), which looks at robot1.
inline FloorPlan hall_with_two_robots() {
    FloorPlan plan = plain_hall();
    plan.robots.push_back(plan.robots[0]);
    plan.robots[1].name = "robot2";
    plan.robots[1].start = {Point{8, 4}, from_degrees(180)};
    plan.places[0].pose.position = Point{9.3, 1};
    return plan;
}

inline Scenario nobody() { return {}; }

// What a robot says in English with the default voice, for `duration` or as long as the text takes.
inline Utterance said(std::string text, double loudness = 0.5, std::optional<Seconds> duration = {}) {
    auto const seconds = duration.value_or(speech_duration(text));
    return {{{.text = std::move(text), .language = "en", .duration = seconds}}, loudness};
}

// A known person who enters at once and does these actions.
inline Role tanaka(std::vector<ScriptedAction> actions, std::vector<Answer> answers = {}) {
    Role role;
    role.id = "tanaka";
    role.known = true;
    role.language = "ja";
    role.answers = std::move(answers);
    role.actions = std::move(actions);
    return role;
}

inline Scenario only(Role role) { return {"only one", {}, {std::move(role)}, {}, {}}; }

// Steps the hall until the condition holds. Returns false after `at_most` seconds of world time.
template <class Condition>
bool runs_until(Hall& hall, Seconds most, Condition condition) {
    for (WorldTime const end = hall.now() + world_time(most); hall.now() < end;) {
        hall.step();
        if (condition()) return true;
    }
    return false;
}

inline void run(Hall& hall, Seconds duration) { hall.advance(hall.now() + world_time(duration)); }

inline RobotId const robot1{0}, robot2{1};

inline MotionState state(Hall const& hall, RobotId robot, MotionId motion) { return hall.drive(robot).progress(motion).state; }

inline std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const read = std::make_shared<xml::Schemas const>(files::schemas());
    return read;
}

inline FloorPlan shipped_plan(std::string const& name) {
    return read_floor_plan(schemas(), name, std::string{files::simulation().at(name)});
}

inline Scenario reception_day(FloorPlan const& plan) {
    return read_scenario(schemas(), "reception-day.xml", std::string{files::simulation().at("reception-day.xml")}, plan);
}

// The complete observable state, exactly.
inline std::string observed(Hall const& hall) {
    std::string all;
    auto add = [&](double number) {
        char text[32];
        std::snprintf(text, sizeof text, "%a ", number);
        all += text;
    };
    auto add_pose = [&](Pose const& pose) {
        add(pose.position.x());
        add(pose.position.y());
        add(pose.heading);
    };
    for (Robot const& robot : hall.robots()) add_pose(robot.pose);
    for (Person const& person : hall.people()) {
        all += person.role + " ";
        add_pose(person.pose);
    }
    for (Happening const& happening : hall.chronicle().since(0)) {
        all +=
            std::to_string(happening.at.count()) + " " + std::to_string(static_cast<int>(happening.kind)) + happening.text + "\n";
    }
    return all;
}

}  // namespace rois::simulation
