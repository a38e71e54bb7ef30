// The checks. Each check tests one rule of the specification, or of the decisions that complete it, from outside.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "kit/application.hpp"

namespace rois::conformance {

class Context;

// The gateway breaks the rule. The text contains the expected and the received value.
class Broken : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The check cannot run: the gateway lacks a component, another application uses the component, the component has failed, or
// an option forbids the check.
class Skipped : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The effect cannot be observed: for example, the robot does not report its position, or no person is in front of it.
class NotObservable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Check {
    std::string name;    // the rule as a sentence, with underscores
    std::string proves;  // the figures, tables and decisions that require it
    std::function<void(Context&)> run;
    std::optional<kit::Transport> only_over{};
};

// A clause of the specification with its checks: a chapter of the report.
struct Clause {
    std::string title;
    std::vector<Check> checks;
};

Clause http_clause();
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
Clause choosing_clause();

// A name that no gateway has: for unknown components, commands, queries, events and parameters.
inline constexpr auto unknown_name = "conformance_unknown";

std::vector<Clause> all_clauses();  // in the order in which they run

// These functions throw Broken if the requirement is not met.
void require(bool holds, std::string const& message);
// Requires the return code OK, and returns the answer.
kit::Document const& require_ok(kit::Document const& answer);
// Requires this return code, and a reason that contains `words`.
void require_refusal(kit::Document const& answer, std::string const& return_code, std::string const& words = "");
void require_fault(kit::Document const& answer, std::string const& code);
void require_equal(std::string const& what, std::string const& expected, std::string const& found);
std::string list(std::vector<std::string> const& texts);  // "[a, b]", for messages
// Requires at least one text, and returns the first.
std::string first_of(std::string const& what, std::vector<std::string> const& texts);
// Requires exactly one value of this result or parameter, and returns it.
std::string value_of(kit::Values const&, std::string const& name);

}  // namespace rois::conformance
