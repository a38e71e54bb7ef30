// The effects of navigation and move, and the reported position of the robot. The robot starts at 6000, 6000 with the
// heading 0.
#include <algorithm>
#include <iterator>
#include <memory>
#include <sstream>
#include <tuple>
#include <utility>

#include "broken/breaking.hpp"
#include "broken/commands.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

constexpr double here = 6'000;  // mm, x and y

struct Position {
    double x = 0, y = 0, heading = 0;
};

Position position_in(std::string text) {
    for (auto& c : text)
        if (c == ',') c = ' ';
    std::istringstream numbers{text};
    Position position;
    numbers >> position.x >> position.y >> position.heading;
    return position;
}

std::string text_of(Position const& position) {
    std::ostringstream text;
    text << position.x << ", " << position.y << ", " << position.heading;
    return text.str();
}

using Displace = std::function<Position(Position)>;

Breaking drives_to(Displace const& displaced) {
    return edits_arguments("navigation", "target_position", [=](Values values) {
        for (auto& value : values) value = text_of(displaced(position_in(value)));
        return values;
    });
}

Breaking drives_without_headings() {
    return edits_arguments("navigation", "target_position", [](Values values) {
        for (auto& value : values) value = value.substr(0, value.rfind(','));
        return values;
    });
}

// Changes each position in the text and in the element `located`.
Breaking reports_position_at(Displace const& displaced) {
    return edits_answers("query", [=](pugi::xml_node root) {
        auto const results = root.child("results");
        auto const data = results.find_child_by_attribute("result", "rois:name", "position_data");
        for (auto const value : data.children("rois:value"))
            value.text().set(text_of(displaced(position_in(value.text().get()))).c_str());
        for (auto const located : results.children("located")) {
            std::istringstream position{located.child("position").text().get()};
            std::istringstream orientation{located.child("orientation").text().get()};
            Position reported;
            double z = 0, roll = 0, pitch = 0;
            position >> reported.x >> reported.y >> z;
            orientation >> roll >> pitch >> reported.heading;
            reported = displaced(reported);
            std::ostringstream there, turned;
            there << reported.x << " " << reported.y << " " << z;
            turned << roll << " " << pitch << " " << reported.heading;
            located.child("position").text().set(there.str().c_str());
            located.child("orientation").text().set(turned.str().c_str());
        }
    });
}

// Repeats the first reported values of the results that `chosen` selects.
Breaking repeats_first_values(std::function<bool(std::string const& name)> const& chosen) {
    auto const first = std::make_shared<pugi::xml_document>();
    return edits_answers("query", [=](pugi::xml_node root) {
        auto results = root.child("results");
        if (!results.find_child_by_attribute("result", "rois:name", "position_data")) return;
        if (!first->first_child()) {
            first->append_copy(results);
            return;
        }
        for (auto result : results.children("result")) {
            std::string const name = result.attribute("rois:name").value();
            if (!chosen(name)) continue;
            auto const old = first->first_child().find_child_by_attribute("result", "rois:name", name.c_str());
            result.child("rois:value").text().set(old.child("rois:value").text().get());
        }
        if (!chosen("position_data")) return;
        while (results.remove_child("located")) {
        }
        for (auto const located : first->first_child().children("located")) results.append_copy(located);
    });
}

// Replaces the two numbers of `line` or `curve`.
Breaking moves(std::string const& motion, std::function<std::pair<int, int>(int, int)> const& otherwise) {
    return edits_arguments("move", motion, [=](Values values) {
        std::istringstream numbers{values.empty() ? "" : values.front()};
        int first = 0, second = 0;
        numbers >> first >> second;
        std::tie(first, second) = otherwise(first, second);
        return Values{std::to_string(first) + " " + std::to_string(second)};
    });
}

Breaking drives_curves_as_lines() {
    return edits_commands("move", [](pugi::xml_node command) {
        auto const curve = argument_of(command, "curve");
        if (curve) curve.attribute("rois:name").set_value("line");
    });
}

Breaking edits_targets(std::function<void(pugi::xml_node target, pugi::xml_node is_final)> const& edit) {
    return edits_notifications("receive_event", [=](pugi::xml_node root) {
        if (root.child("event_type").text().get() != std::string_view{"reached_target"}) return;
        auto const results = root.child("results");
        edit(results.find_child_by_attribute("result", "rois:name", "target").child("rois:value"),
             results.find_child_by_attribute("result", "rois:name", "is_final_target").child("rois:value"));
    });
}

bool is_target(std::string const& notification) { return notification.find("reached_target") != std::string::npos; }

Breaking reports_only_the_last_target() {
    return {.notification = [](std::string const& notification) -> Documents {
        if (is_target(notification) && notification.find(">false<") != std::string::npos) return {};
        return {notification};
    }};
}

Breaking reports_targets_after_completion() {
    auto const held = std::make_shared<Documents>();
    return {.notification = [held](std::string const& notification) -> Documents {
        if (is_target(notification)) {
            held->push_back(notification);
            return {};
        }
        Documents sent{notification};
        if (is(notification, "completed")) std::ranges::move(std::exchange(*held, {}), std::back_inserter(sent));
        return sent;
    }};
}

}  // namespace

std::vector<BrokenRule> rules_of_motion() {
    std::string const arrives = "navigation_reaches_its_target", in_order = "targets_are_visited_in_order";
    std::string const targets = "each_reached_target_is_reported", line = "move_follows_its_line";
    std::string const direction = "move_follows_its_direction", curve = "move_follows_its_curve";
    std::string const halts = "stop_halts_the_robot", holds = "suspend_halts_the_robot_and_resume_continues";
    std::vector<BrokenRule> rules{
        {"start of a navigation has the effect of stop", arrives, [] { return replaces_command("navigation", "start", "stop"); }},
        {"targets are mirrored", arrives,
         [] { return drives_to([](Position at) -> Position {
                  return {at.x, 2 * here - at.y, at.heading};
              }); }},
        {"x and y of targets are exchanged", arrives,
         [] { return drives_to([](Position at) -> Position {
                  return {at.y, at.x, at.heading};
              }); }},
        {"headings of targets are ignored", arrives, drives_without_headings},
        {"headings of targets are mirrored", arrives,
         [] { return drives_to([](Position at) -> Position {
                  return {at.x, at.y, -at.heading};
              }); }},
        {"a navigation drives half of the path", arrives,
         [] { return drives_to([](Position at) -> Position {
                  return {(at.x + here) / 2, (at.y + here) / 2, at.heading};
              }); }},
        {"a navigation completes before it has arrived", arrives, [] { return completes_at_once("navigation"); }},
        {"a navigation completes long after it has arrived", arrives, [] { return completes_late("navigation"); }},
        {"positions never change", arrives,
         [] { return repeats_first_values([](std::string const& name) { return name != "robot_ref"; }); }},
        {"positions have the time of the first one", arrives,
         [] { return repeats_first_values([](std::string const& name) { return name == "timestamp"; }); }},
        {"positions of the robot are mirrored", arrives,
         [] { return reports_position_at([](Position at) -> Position {
                  return {2 * here - at.x, at.y, at.heading};
              }); }},
        {"headings of the robot are reported to the right", arrives,
         [] { return reports_position_at([](Position at) -> Position {
                  return {at.x, at.y, -at.heading};
              }); }},
        {"positions of the robot are in metres", line,
         [] { return reports_position_at([](Position at) -> Position {
                  return {at.x / 1'000, at.y / 1'000, at.heading};
              }); }},
        {"only the last target is driven to", in_order,
         [] { return edits_arguments("navigation", "target_position", [](Values values) { return Values{values.back()}; }); }},
        {"targets are visited in the opposite order", in_order,
         [] {
             return edits_arguments("navigation", "target_position", [](Values values) {
                 return Values{values.rbegin(), values.rend()};
             });
         }},
        {"reached_target reports the starting point", targets,
         [] { return edits_targets([](pugi::xml_node target, pugi::xml_node) { target.text().set("6000, 6000, 0"); }); }},
        {"every target is the last one", targets,
         [] { return edits_targets([](pugi::xml_node, pugi::xml_node is_final) { is_final.text().set("true"); }); }},
        {"only the last target is reported", targets, reports_only_the_last_target},
        {"targets are reported after the navigation has completed", targets, reports_targets_after_completion},
        {"time_limit of a navigation is ignored", "navigation_stops_at_its_time_limit",
         [] { return drops_argument("navigation", "time_limit"); }},
        {"the robot continues to its target after stop", halts, [] { return pretends_to_stop("navigation"); }},
        {"the robot continues to its target after suspend", holds, [] { return pretends_to_suspend("navigation"); }},
        {"the robot does not continue after resume", holds,
         [] { return replaces_command("navigation", "resume", "set_parameter"); }},
        {"suspend ends a navigation", holds, [] { return replaces_command("navigation", "suspend", "stop"); }},
        {"start of a move has the effect of stop", line, [] { return replaces_command("move", "start", "stop"); }},
        {"a move completes before it has arrived", line, [] { return completes_at_once("move"); }},
        {"a move drives a third of its line", line,
         [] { return moves("line", [](int way, int turn) {
                  return std::pair{way / 3, turn};
              }); }},
        {"a move drives backwards", line, [] { return moves("line", [](int way, int turn) {
                                                   return std::pair{-way, turn};
                                               }); }},
        {"a move interprets millimetres as centimetres", line,
         [] { return moves("line", [](int way, int turn) {
                  return std::pair{way * 10, turn};
              }); }},
        {"the direction of a line is ignored", direction,
         [] { return moves("line", [](int way, int) {
                  return std::pair{way, 0};
              }); }},
        {"a line leads to the wrong side", direction,
         [] { return moves("line", [](int way, int turn) {
                  return std::pair{way, -turn};
              }); }},
        {"curves are driven as lines", curve, drives_curves_as_lines},
        {"curves are twice as wide", curve,
         [] { return moves("curve", [](int radius, int turn) {
                  return std::pair{2 * radius, turn};
              }); }},
        {"curves lead to the wrong side", curve,
         [] { return moves("curve", [](int radius, int turn) {
                  return std::pair{radius, -turn};
              }); }},
        {"the time of a move is ignored", "move_is_slower_with_a_longer_time", [] { return drops_argument("move", "time"); }}};
    for (auto& rule : rules) {
        // A fast robot arrives before it is halted, or within the allowed delay of reports.
        bool const completes_early = rule.name.ends_with("completes before it has arrived");
        bool const is_halted = rule.found_by == halts || rule.found_by == holds;
        rule.world = completes_early || is_halted ? World::slow_hall : World::calm_hall;
    }
    return rules;
}

}  // namespace rois::broken
