// The results of the checks, as text for people and as JUnit XML for build servers.
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace rois::conformance {

enum class Outcome { holds, broken, skipped, not_observable };

// The result of a check over one transport.
struct Finding {
    std::string name;
    std::string proves;
    std::string over;  // "HTTP" or "WebSocket"; empty for rules over all transports
    Outcome outcome = Outcome::holds;
    std::string text{};  // the reason, unless the outcome is `holds`
    double seconds = 0;
};

struct Chapter {
    std::string title;
    std::vector<Finding> findings;
};

struct Report {
    std::string gateway;  // its address and name
    std::vector<Chapter> chapters;

    std::size_t count(Outcome) const;
};

// Both write only `readable` text, whatever a gateway has answered.
void write_text(std::ostream&, Report const&);
void write_junit(std::ostream&, Report const&);
// Writes the report of a gateway that could not be checked, with one error.
void write_junit_error(std::ostream&, std::string const& gateway, std::string const& why);

// Returns the text on one line, with U+FFFD in place of control characters and bytes that are not UTF-8.
std::string readable(std::string_view);

}  // namespace rois::conformance
