// The rules that the proxy can break, each with the check that must find it.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "broken/proxy.hpp"

namespace rois::broken {

enum class Over { websocket, http };

struct BrokenRule {
    std::string name;      // what the gateway does wrong
    std::string found_by;  // the name of a check of rois-conformance
    std::function<Breaking()> breaking;
    Over over = Over::websocket;
};

std::vector<BrokenRule> rules_of_sessions();
std::vector<BrokenRule> rules_of_commands();
std::vector<BrokenRule> rules_of_information();  // queries, events, profiles
std::vector<BrokenRule> rules_of_conditions();
std::vector<BrokenRule> rules_of_http();
std::vector<BrokenRule> rules_of_gaps();  // what is left out, or empty

// The rules in parts.
struct Part {
    char const* name;
    std::vector<BrokenRule> (*rules)();
};
inline constexpr Part all_parts[] = {
    {"Sessions", rules_of_sessions},     {"Commands", rules_of_commands}, {"Information", rules_of_information},
    {"Conditions", rules_of_conditions}, {"Http", rules_of_http},         {"Gaps", rules_of_gaps}};

inline std::ostream& operator<<(std::ostream& out, Part const& part) { return out << part.name; }

}  // namespace rois::broken
