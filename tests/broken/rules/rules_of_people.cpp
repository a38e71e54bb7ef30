// The positions of people, and the reports about them. The robot starts at 6000, 6000; a person stands at 8800, 7200.
#include <memory>
#include <sstream>

#include "broken/breaking.hpp"
#include "broken/commands.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

constexpr auto localization = "_localization";

struct Place {
    double x = 0, y = 0;
};

Place place_in(std::string text) {
    for (auto& c : text)
        if (c == ',') c = ' ';
    std::istringstream numbers{text};
    Place place;
    numbers >> place.x >> place.y;
    return place;
}

pugi::xml_node values_of(pugi::xml_node root, char const* name) {
    return root.child("results").find_child_by_attribute("result", "rois:name", name);
}

// Changes the positions of people in each event: in the texts and in the elements `located`.
Breaking reports_people_at(std::function<Place(Place)> const& displaced) {
    return edits_notifications("receive_event", [=](pugi::xml_node root) {
        for (auto const value : values_of(root, "position_data").children("rois:value")) {
            std::string const text = value.text().get();
            auto const at = displaced(place_in(text));
            value.text().set((std::to_string(at.x) + ", " + std::to_string(at.y) + text.substr(text.rfind(','))).c_str());
        }
        for (auto const located : root.child("results").children("located")) {
            auto const at = displaced(place_in(located.child("position").text().get()));
            located.child("position").text().set((std::to_string(at.x) + " " + std::to_string(at.y) + " 0").c_str());
        }
    });
}

Breaking reports_people_relative_to_the_robot() {
    auto const robot = std::make_shared<Place>();
    auto breaking = reports_people_at([=](Place at) -> Place { return {at.x - robot->x, at.y - robot->y}; });
    breaking.answer = edits_answers("query", [=](pugi::xml_node root) {
                          if (auto const data = values_of(root, "position_data"))
                              *robot = place_in(data.child("rois:value").text().get());
                      }).answer;
    return breaking;
}

Breaking renames_people() {
    auto const events = std::make_shared<int>(0);
    return edits_notifications("receive_event", [=](pugi::xml_node root) {
        ++*events;
        for (auto const value : values_of(root, "person_ref").children("rois:value"))
            value.text().set((value.text().get() + ("-" + std::to_string(*events))).c_str());
    });
}

Breaking omits_a_position() {
    return edits_notifications("receive_event", [](pugi::xml_node root) {
        auto positions = values_of(root, "position_data");
        positions.remove_child(positions.last_child());
        while (root.child("results").remove_child("located")) {
        }
    });
}

// Returns the selected person with a wrong position.
Breaking selects_names_only() {
    return edits_answers("get_event_detail", [](pugi::xml_node root) {
        for (auto const value : values_of(root, "position_data").children("rois:value")) value.text().set("1000, 1000, 0");
        while (root.child("results").remove_child("located")) {
        }
    });
}

Breaking ignores_parameter(std::string const& name) {
    return edits_requests("set_parameter", [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (node.attribute("rois:name").value() == name) node.parent().remove_child(node);
        });
    });
}

}  // namespace

std::vector<BrokenRule> rules_of_people() {
    std::string const stand = "people_who_stand_still_keep_ref_and_position", active = "only_an_active_function_reports_events";
    auto const visitor = World::visitor, stroller = World::strollers;
    auto const websocket = Over::websocket;
    return {{"a condition on details selects all people or none", "a_condition_selects_entries_of_details",
             [] { return edits_requests("get_event_detail", remove_condition); }, websocket, World::strollers},
            {"a condition on details selects names without their positions", "a_condition_selects_entries_of_details",
             selects_names_only, websocket, World::strollers},
            {"people are mirrored", "follow_keeps_its_distance",
             [] { return reports_people_at([](Place at) -> Place {
                      return {at.x, 12'000 - at.y};
                  }); }, websocket, visitor},
            {"people are reported relative to the robot", "positions_of_people_are_independent_of_the_robot",
             reports_people_relative_to_the_robot, websocket, visitor},
            {"people have another name in each event", stand, renames_people, websocket, visitor},
            {"a person has no position", stand, omits_a_position, websocket, visitor},
            {"start of a follow has the effect of stop", "follow_keeps_its_distance",
             [] { return replaces_command("follow", "start", "stop"); }, websocket, visitor},
            {"a follow keeps another distance", "follow_keeps_its_distance",
             [] { return edits_arguments("follow", "distance", [](Values) { return Values{"2600"}; }); }, websocket, visitor},
            {"a follow completes before stop", "follow_keeps_its_distance", [] { return completes_at_once("follow"); }, websocket,
             visitor},
            {"minimum_interval is ignored", "minimum_interval_limits_events",
             [] { return ignores_parameter("minimum_interval"); }, websocket, stroller},
            {"detection_threshold is ignored", "detection_threshold_suppresses_small_motions",
             [] { return ignores_parameter("detection_threshold"); }, websocket, stroller},
            {"people are reported while localization is suspended", active, [] { return pretends_to_suspend(localization); },
             websocket, stroller},
            {"people are reported after stop", active, [] { return replaces_command(localization, "stop", "set_parameter"); },
             websocket, stroller},
            {"no person is reported after resume", active,
             [] { return replaces_command(localization, "resume", "set_parameter"); }, websocket, stroller},
            {"people are reported after release", active, [] { return ignores_operation("release"); }, websocket, stroller}};
}

}  // namespace rois::broken
