#include "command/scenario/scenario_file.hpp"

#include <algorithm>
#include <array>
#include <ranges>
#include <string_view>

#include "command/scenario/variables.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"
#include "xml/profiles/document.hpp"

namespace rois::command {

namespace {

bool is_true(std::string_view text) { return trimmed(text) == "true" || trimmed(text) == "1"; }

std::string place_of(xml::Element const& element) {
    std::string text = element.complain("").what();  // "name:line:column: "
    text.resize(text.rfind(':'));
    return text;
}

CompletedStatus status_of(std::string_view text) {
    using enum CompletedStatus;
    for (auto const status : {ok, error, abort, out_of_resources, timeout})
        if (to_text(status) == text) return status;
    return error;
}

class ScenarioParser {
public:
    explicit ScenarioParser(xml::Element const& root) {
        scenario_.name = root.attribute("name", "");
        scenario_.start = root.token("start", "");
        for (auto const& element : root.children("component")) component(element);
        for (auto const& element : root.children("variable")) variable(element);
        for (auto const& element : root.children()) {
            if (element.name() != "state" && element.name() != "end") continue;
            auto const name = element.token("name", "");
            if (scenario_.states.contains(name)) throw element.complain("duplicate state " + rois::quoted(name));
            scenario_.states.emplace(name, ScenarioState{});  // all names first, so that triggers can be checked
        }
        check_state(root, scenario_.start);
        for (auto const& element : root.children())
            if (element.name() == "state" || element.name() == "end")
                scenario_.states.at(element.token("name", "")) = state(element);
    }

    RobotScenario take() { return std::move(scenario_); }

private:
    void component(xml::Element const& element) {
        ScenarioComponent read{element.token("name", ""), element.token("ref", ""), element.token("type", ""),
                               to_code<Switching>(element.token("switching", "")).value_or(Switching::none)};
        if (!read.ref.empty() && !read.type.empty())
            throw element.complain("a component has both 'ref' and 'type': give only one of them");
        if (read.ref.empty() && read.type.empty()) read.ref = read.name;
        if (std::ranges::find(scenario_.components, read.name, &ScenarioComponent::name) != scenario_.components.end())
            throw element.complain("duplicate component " + rois::quoted(read.name));
        scenario_.components.push_back(std::move(read));
    }

    void variable(xml::Element const& element) {
        auto const name = element.token("name", "");
        if (!scenario_.variables.emplace(name, trimmed(element.text())).second)
            throw element.complain("duplicate variable " + rois::quoted(name));
    }

    ScenarioState state(xml::Element const& element) {
        ScenarioState state;
        state.name = element.token("name", "");
        state.place = place_of(element);
        state.is_end = element.name() == "end";
        state.failed = is_true(element.token("failed", "false"));
        for (auto const& child : element.children()) {
            auto const name = child.name();
            if (name == "command") {
                state.commands.push_back(command(child));
            } else if (name == "query") {
                state.query = ScenarioQuery{child.token("type", ""), known_component(child, child.token("component", ""))};
            } else if (name == "leaving") {
                for (auto const& each : child.children()) state.leaving.push_back(command(each));
            } else if (child.attribute("to")) {
                state.triggers.push_back(trigger(child));
            } else {
                state.steps.push_back(step(child));
            }
        }
        check_ways_out(element, state);
        return state;
    }

    static void check_ways_out(xml::Element const& element, ScenarioState const& state) {
        if (state.is_end) return;
        if (state.triggers.empty())
            throw element.complain("this state has no trigger: add one, or use the element 'end' instead of 'state'");
        for (auto const& trigger : state.triggers) {
            if (trigger.kind == Trigger::Kind::completed && state.commands.empty())
                throw element.complain("this state waits for the end of its commands, and has none");
            if (trigger.kind == Trigger::Kind::answered && !state.query)
                throw element.complain("this state waits for an answer, and has no query");
        }
    }

    ScenarioCommand command(xml::Element const& element) {
        ScenarioCommand command{
            known_component(element, element.token("component", "")), element.token("type", ""), {}, {}, place_of(element)};
        if (element.attribute("delay")) command.delay = static_cast<std::int64_t>(element.number("delay"));
        for (auto const& argument : element.children())
            command.arguments.push_back(
                {argument.token("name", ""), known_text(argument, std::string{trimmed(argument.text())})});
        return command;
    }

    Trigger trigger(xml::Element const& element) {
        static std::map<std::string_view, Trigger::Kind> const kinds{{"event", Trigger::Kind::event},
                                                                     {"completed", Trigger::Kind::completed},
                                                                     {"answered", Trigger::Kind::answered},
                                                                     {"after", Trigger::Kind::after},
                                                                     {"at_once", Trigger::Kind::at_once}};
        Trigger trigger;
        trigger.kind = kinds.at(element.name());
        trigger.event_type = trigger.kind == Trigger::Kind::event ? element.token("type", "") : "";
        trigger.component = known_component(element, element.token("component", ""));
        if (auto const status = element.token("status")) trigger.status = status_of(*status);
        trigger.seconds = known_text(element, element.attribute("seconds", ""));
        trigger.to = element.token("to", "");
        check_state(element, trigger.to);
        bool const has_results = trigger.kind == Trigger::Kind::event || trigger.kind == Trigger::Kind::answered;
        for (auto const& child : element.children()) {
            if (child.name() == "take" && !has_results) throw child.complain("only events and answers have results to take");
            trigger.steps.push_back(step(child));
        }
        return trigger;
    }

    Step step(xml::Element const& element) {
        auto const name = element.name();
        if (name == "print") return Print{known_text(element, std::string{trimmed(element.text())})};
        auto const variable = known_variable(element, element.token("variable", ""));
        if (name == "set") return SetVariable{variable, known_text(element, std::string{trimmed(element.text())})};
        if (name == "add") return AddValue{variable, known_text(element, std::string{trimmed(element.text())})};
        if (name == "count") return CountUp{variable};
        if (name == "take") return take_result(element, variable);
        if (name == "when") return when(element, variable);
        return PlaceBefore{variable, known_text(element, element.attribute("before", "")), element.number("distance"),
                           element.number("turn", 0)};
    }

    Step take_result(xml::Element const& element, std::string const& variable) {
        TakeResult take{variable,
                        element.token("result", ""),
                        known_variable(element, element.token("not_in", "")),
                        element.token("beside", ""),
                        known_text(element, element.attribute("is", "")),
                        element.number("apart", 0)};
        if (take.not_in.empty() && element.attribute("apart")) throw element.complain("'apart' needs 'not_in'");
        if (take.beside.empty() == element.attribute("is").has_value())
            throw element.complain("'beside' needs 'is', and 'is' needs 'beside'");
        return take;
    }

    Step when(xml::Element const& element, std::string const& variable) {
        using enum When::Relation;
        static std::array<std::pair<std::string_view, When::Relation>, 6> const relations{
            {{"is", is}, {"is_not", is_not}, {"in", in}, {"not_in", not_in}, {"empty", empty}, {"near", near}}};
        auto const is_given = [&](auto const& one) { return element.attribute(one.first).has_value(); };
        if (std::ranges::count_if(relations, is_given) != 1)
            throw element.complain("a 'when' needs exactly one of " +
                                   listed(relations, [](auto const& one) { return std::string{one.first}; }));
        auto const& [attribute, relation] = *std::ranges::find_if(relations, is_given);
        When read{variable, relation, known_text(element, element.attribute(attribute, ""))};
        if (read.relation == in || read.relation == not_in) known_variable(element, read.operand);
        if (read.relation == empty && !is_true(read.operand)) read.relation = not_empty;
        if ((read.relation == near) != element.attribute("within").has_value())
            throw element.complain("'near' needs 'within', and 'within' needs 'near'");
        read.within = element.number("within", 0);
        return read;
    }

    void check_state(xml::Element const& element, std::string const& name) const {
        if (scenario_.states.contains(name)) return;
        throw element.complain("no state " + rois::quoted(name) + "; there are " + listed(std::views::keys(scenario_.states)));
    }

    std::string known_component(xml::Element const& element, std::string const& name) const {
        if (name.empty() || std::ranges::find(scenario_.components, name, &ScenarioComponent::name) != scenario_.components.end())
            return name;
        throw element.complain("no component " + rois::quoted(name) + "; there are " +
                               listed(scenario_.components, &ScenarioComponent::name));
    }

    std::string known_variable(xml::Element const& element, std::string const& name) const {
        if (name.empty() || scenario_.variables.contains(name)) return name;
        throw element.complain("no variable " + rois::quoted(name) + "; there are " +
                               listed(std::views::keys(scenario_.variables)));
    }

    std::string known_text(xml::Element const& element, std::string text) const {
        for (auto const& name : names_in(text)) known_variable(element, name);
        return text;
    }

    RobotScenario scenario_;
};

}  // namespace

RobotScenario read_robot_scenario(std::shared_ptr<xml::Schemas const> const& schemas, std::string const& name, std::string text) {
    auto const document = xml::Document::parse(schemas, name, std::move(text));
    auto const root = document.root();
    if (root.name() != "robot_scenario")
        throw root.complain("this is not a robot scenario: expected the element robot_scenario, not " +
                            rois::quoted(root.name()));
    return ScenarioParser{root}.take();
}

}  // namespace rois::command
