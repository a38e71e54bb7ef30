// A rule of the specification, or of the decisions that complete it, as something that can be played and seen from outside.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "kit/application.hpp"

namespace rois::conformance {

class Stage;

// The gateway breaks the rule; the text contains the expected and the received value.
class Broken : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// This gateway gives no occasion to see the rule: it has no such component, or another application uses it.
class NotPlayed : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The effect is not observable: the robot's position is not reported, or no person is in front of it.
class NotObservable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Check {
    std::string name;    // the rule in words, with underscores
    std::string proves;  // figures, tables, decisions
    std::function<void(Stage&)> play;
    std::optional<kit::Way> only_over{};
};

// A clause of the specification, by which the report is grouped.
struct Clause {
    std::string title;
    std::vector<Check> checks;
};

Clause wire_clause();
Clause websocket_clause();
Clause notification_clause();
Clause session_clause();
Clause profile_clause();
Clause binding_clause();
Clause parameter_clause();
Clause execution_clause();
Clause completion_clause();
Clause sequence_clause();
Clause query_clause();
Clause event_clause();
Clause condition_clause();
Clause component_clause();
Clause stream_clause();
Clause motion_clause();
Clause action_clause();
Clause people_clause();
Clause system_clause();

// A name of a component, command, query, event or parameter that no gateway has.
inline constexpr auto nobody = "conformance_nobody";

std::vector<Clause> all_clauses();  // in the order in which they are played

void require(bool holds, std::string const& otherwise);
// The answer itself when it is OK.
kit::Document const& ok(kit::Document const& answer);
// The answer is this refusal, and its reason has these words.
void refused(kit::Document const& answer, std::string const& return_code, std::string const& words = "");
void fault(kit::Document const& answer, std::string const& code);
void same(std::string const& what, std::string const& expected, std::string const& found);
std::string list(std::vector<std::string> const& texts);  // for messages
// What a gateway says may be empty where it should not be: Broken says so.
std::string first(std::string const& what, std::vector<std::string> const& texts);
// The only value of this result or parameter.
std::string value_of(kit::Values const&, std::string const& name);

}  // namespace rois::conformance
