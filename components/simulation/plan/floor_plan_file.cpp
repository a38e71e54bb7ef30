#include "simulation/plan/floor_plan_file.hpp"

#include <utility>

namespace rois::simulation {

namespace {

Metres metres(double millimetres) { return millimetres / 1000.0; }

Point point(xml::Element const& element, std::string_view x, std::string_view y) {
    return {metres(element.number(x)), metres(element.number(y))};
}

Pose pose(xml::Element const& element) {
    return {.position = point(element, "x", "y"), .heading = from_degrees(element.number("heading", 0))};
}

Box box(xml::Element const& element) {
    Point const low = point(element, "x", "y");
    return {.low = low, .high = low + point(element, "width", "depth")};
}

bool is_set(xml::Element const& element, std::string_view name) {
    auto const value = element.token(name, "false");
    return value == "true" || value == "1";
}

// Replaces the default by the attribute if it is present.
void read_length(xml::Element const& element, std::string_view name, Metres& value) {
    value = metres(element.number(name, value * 1000.0));
}

void read_angle(xml::Element const& element, std::string_view name, Radians& value) {
    value = from_degrees(element.number(name, to_degrees(value)));
}

template <class Seeing>
void read_view(xml::Element const& element, Seeing& sensor) {
    read_length(element, "range", sensor.range);
    read_angle(element, "field_of_view", sensor.field_of_view);
}

template <class Measuring>
void read_noise(xml::Element const& element, Measuring& sensor) {
    read_length(element, "sigma", sensor.sigma);
    read_angle(element, "heading_sigma", sensor.heading_sigma);
}

Sensors sensors(xml::Element const& robot) {
    Sensors all;
    if (auto const people = robot.child("people")) {
        read_view(*people, all.people);
        read_noise(*people, all.people);
    }
    if (auto const faces = robot.child("faces")) {
        read_view(*faces, all.faces);
        read_noise(*faces, all.faces);
        read_angle(*faces, "turned_within", all.faces.turned_within);
    }
    if (auto const identification = robot.child("identification")) {
        read_view(*identification, all.identification);
        read_angle(*identification, "turned_within", all.identification.turned_within);
    }
    if (auto const sound = robot.child("sound")) {
        read_length(*sound, "range", all.sound.range);
        read_length(*sound, "sigma", all.sound.sigma);
    }
    if (auto const gestures = robot.child("gestures")) read_view(*gestures, all.gestures);
    return all;
}

RobotFrame robot_frame(xml::Element const& element) {
    RobotFrame frame{.crs = element.attribute("crs", ""), .origin = pose(element)};
    read_noise(element, frame);
    return frame;
}

Place place(xml::Element const& element) {
    Place place{.name = element.attribute("name", ""), .pose = pose(element)};
    read_length(element, "width", place.width);
    read_length(element, "depth", place.depth);
    return place;
}

RobotPlan robot(xml::Element const& element) {
    RobotPlan plan;
    plan.name = element.attribute("name", "");
    plan.start = pose(element);
    plan.fixed = is_set(element, "fixed");
    read_length(element, "radius", plan.radius);
    read_length(element, "max_speed", plan.max_speed);
    read_length(element, "max_acceleration", plan.max_acceleration);
    read_angle(element, "max_turn_rate", plan.max_turn_rate);
    read_angle(element, "max_turn_acceleration", plan.max_turn_acceleration);
    if (double const charge = element.number("battery", 0); charge > 0) plan.battery = charge;
    plan.sensors = sensors(element);
    if (auto const frame = element.child("frame")) plan.frame = robot_frame(*frame);
    return plan;
}

// The element that has the flaw.
xml::Element culprit(xml::Element const& root, PlanFlaw const& flaw) {
    switch (flaw.of) {
        case PlanFlaw::Of::place:
            return root.children("place").at(flaw.index);
        case PlanFlaw::Of::robot:
            return root.children("robot").at(flaw.index);
        case PlanFlaw::Of::plan:
            break;
    }
    return root;
}

}  // namespace

FloorPlan read_floor_plan(std::shared_ptr<xml::Schemas const> schemas, std::string name, std::string text) {
    auto const document = xml::Document::parse(std::move(schemas), std::move(name), std::move(text));
    auto const root = document.root();
    if (root.name() != "floor_plan") throw root.complain("not a floor plan: the root element must be floor_plan");
    FloorPlan plan;
    plan.name = root.attribute("name", "");
    plan.crs = root.attribute("crs", plan.crs);
    plan.prefix_first = is_set(root, "prefix_first");
    plan.bounds = box(*root.child("bounds"));
    for (auto const& wall : root.children("wall")) plan.walls.push_back({point(wall, "x1", "y1"), point(wall, "x2", "y2")});
    for (auto const& furniture : root.children("furniture")) plan.desks.push_back(box(furniture));
    for (auto const& element : root.children("place")) plan.places.push_back(place(element));
    for (auto const& element : root.children("robot")) plan.robots.push_back(robot(element));
    if (auto const found = flaw(plan)) throw culprit(root, *found).complain(found->reason);
    return plan;
}

}  // namespace rois::simulation
