// Reads robot scenarios (figure 1) from files (schemas/scenario.xsd).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "types/codes.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::command {

// --- Actions on variables; texts may contain {name} ---

struct SetVariable {
    std::string variable;
    std::string text;
};
struct AddValue {
    std::string variable;
    std::string text;
};
struct CountUp {
    std::string variable;
};
struct PlaceBefore {
    std::string variable;
    std::string before;
    double distance = 0;  // mm
    double turn = 0;      // degrees
};
struct Print {
    std::string text;
};

// --- Conditions of triggers ---

struct TakeResult {
    std::string variable;
    std::string result;
    std::string not_in;  // a variable; empty: any value
    std::string beside;  // another result; empty: none
    std::string is;
    double apart = 0;  // mm; above 0, `not_in` is a list of places
};
struct When {
    enum class Relation : std::uint8_t { is, is_not, in, not_in, empty, not_empty, near };
    std::string variable;
    Relation relation = Relation::is;
    std::string operand;
    double within = 0;  // mm
};

using Step = std::variant<SetVariable, AddValue, CountUp, PlaceBefore, Print, TakeResult, When>;

struct ScenarioCommand {
    struct Argument {
        std::string name;
        std::string text;
    };
    std::string component;  // its name in the scenario
    std::string type;
    std::vector<Argument> arguments;
    std::optional<std::int64_t> delay;  // ms
    std::string place;                  // "file:line:column"
};

struct Trigger {
    enum class Kind : std::uint8_t { event, completed, answered, after, at_once };
    Kind kind = Kind::event;
    std::string event_type;
    std::string component;                  // empty: any
    std::optional<CompletedStatus> status;  // none: any
    std::string seconds;
    std::vector<Step> steps;
    std::string to;
};

struct ScenarioQuery {
    std::string type;
    std::string component;  // empty: any
};

struct ScenarioState {
    std::string name;
    std::vector<Step> steps;
    std::vector<ScenarioCommand> commands;
    std::optional<ScenarioQuery> query;
    std::vector<Trigger> triggers;
    std::vector<ScenarioCommand> leaving;
    bool is_end = false;
    bool failed = false;
    std::string place;
};

struct ScenarioComponent {
    std::string name;
    std::string ref;   // empty: any
    std::string type;  // of this type
    Switching switching = Switching::none;
};

struct RobotScenario {
    std::string name;
    std::string start;
    std::vector<ScenarioComponent> components;
    std::map<std::string, std::string> variables;
    std::map<std::string, ScenarioState> states;
};

// Throws xml::BadDocument, "name:line:column: reason", if the text is not valid by the schema, names an unknown state, component
// or variable, or has a state without a way out.
RobotScenario read_robot_scenario(std::shared_ptr<xml::Schemas const> const&, std::string const& name, std::string text);

}  // namespace rois::command
