// The rules that the proxy can break, each with the check that must find it.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "broken/proxy.hpp"

namespace rois::broken {

enum class Over { websocket, http };

// Worlds in which a broken rule is observable.
enum class World {
    empty_hall,        // 20 times as fast as real time
    calm_hall,         // three times as fast: a motion takes a while
    slow_hall,         // in real time
    visitor,           // one standing visitor
    strollers,         // walking visitors
    two_robots,        // two robots in one hall
    failed_functions,  // failed functions
    team,              // two robots in their own gateways, below a main engine that chooses; one fails when it is disturbed
    short_expiry,      // details of events expire after a second
};

struct BrokenRule {
    std::string name;      // the wrong behaviour
    std::string found_by;  // the check of rois-conformance that must detect it
    std::function<Breaking()> breaking;
    Over over = Over::websocket;
    World world = World::empty_hall;
};

// The options of the gateway and of rois-conformance in a world.
struct Settings {
    std::vector<std::string> gateway;
    std::string judge;
};
Settings settings_of(World);

std::vector<BrokenRule> rules_of_sessions();
std::vector<BrokenRule> rules_of_commands();
std::vector<BrokenRule> rules_of_information();  // queries, events, profiles
std::vector<BrokenRule> rules_of_conditions();
std::vector<BrokenRule> rules_of_http();
std::vector<BrokenRule> rules_of_gaps();    // missing or empty parts
std::vector<BrokenRule> rules_of_motion();  // from here on: effects of components on robots and people
std::vector<BrokenRule> rules_of_actions();
std::vector<BrokenRule> rules_of_people();
std::vector<BrokenRule> rules_of_systems();
std::vector<BrokenRule> rules_of_choosing();

// A named group of rules.
struct Part {
    char const* name;
    std::vector<BrokenRule> (*rules)();
};
inline constexpr Part all_parts[] = {
    {"Sessions", rules_of_sessions},     {"Commands", rules_of_commands}, {"Information", rules_of_information},
    {"Conditions", rules_of_conditions}, {"Http", rules_of_http},         {"Gaps", rules_of_gaps},
    {"Motion", rules_of_motion},         {"Actions", rules_of_actions},   {"People", rules_of_people},
    {"Systems", rules_of_systems},       {"Choosing", rules_of_choosing}};

inline std::ostream& operator<<(std::ostream& out, Part const& part) { return out << part.name; }

}  // namespace rois::broken
