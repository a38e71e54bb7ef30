#include "simulation/scenario/scenario_file.hpp"

#include <algorithm>
#include <utility>

#include "basic/components/reaction_types.hpp"
#include "simulation/world/person.hpp"
#include "simulation/world/units.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::simulation {

namespace {

using basic::gestures;
using basic::reaction_code;
using basic::reaction_types;
using basic::target_from_wire;

bool is_true(std::string_view text) { return trimmed(text) == "true" || trimmed(text) == "1"; }

bool is_language(std::string_view text) {
    return text.size() == 2 && std::ranges::all_of(text, [](char c) { return c >= 'a' && c <= 'z'; });
}

// Reads the elements of one scenario and checks their places and robots against the floor plan.
class ScenarioReader {
public:
    explicit ScenarioReader(FloorPlan const& plan) : plan_{plan} {}

    Role role(xml::Element const& element) const {
        Role role;
        role.id = element.token("id", "");
        role.known = is_true(element.token("known", "false"));
        role.language = language(element, "en");
        role.height = element.number("height", role.height * 1000.0) / 1000.0;
        role.speed = element.number("speed", role.speed * 1000.0) / 1000.0;
        role.gender = gender(element);
        if (element.attribute("age")) role.age = static_cast<int>(element.number("age"));
        role.enters = element.number("enters", 0);
        for (auto const& child : element.children()) {
            if (child.name() == "answer") {
                role.answers.push_back(answer(child, role.language));
            } else {
                role.actions.push_back(action(child, role.language));
            }
        }
        return role;
    }

private:
    Answer answer(xml::Element const& element, std::string const& usual_language) const {
        Answer answer;
        answer.to = element.attribute("to", "");
        answer.reaction = element.token("reaction", "");
        if (answer.to.empty() == answer.reaction.empty()) throw element.complain("an answer needs either 'to' or 'reaction'");
        if (!answer.reaction.empty()) check_reaction(element, answer.reaction);
        answer.language = language(element, usual_language);
        answer.text = trimmed(element.text());
        answer.gesture = element.token("gesture", "");
        if (!answer.gesture.empty()) check_gesture(element, answer.gesture);
        answer.once = is_true(element.token("once", "false"));
        return answer;
    }

    ScriptedAction action(xml::Element const& element, std::string const& usual_language) const {
        ScriptedAction action;
        if (element.attribute("at")) action.at = element.number("at");
        auto const name = element.name();
        if (name == "walk") {
            action.what = Walk{whereabouts(element)};
        } else if (name == "face") {
            action.what = Face{whereabouts(element)};
        } else if (name == "ignore") {
            action.what = Ignore{};
        } else if (name == "say") {
            action.what = Say{language(element, usual_language), std::string{trimmed(element.text())}};
        } else if (name == "gesture") {
            check_gesture(element, element.token("id", ""));
            action.what = Gesture{element.token("id", "")};
        } else if (name == "wait") {
            action.what = Wait{element.number("seconds")};
        } else if (name == "wander") {
            action.what = Wander{element.number("seconds")};
        } else {
            action.what = Leave{};
        }
        return action;
    }

    Whereabouts whereabouts(xml::Element const& element) const {
        auto const to = element.attribute("to", "");
        bool const named = plan_.place(to) != nullptr ||
                           std::ranges::any_of(plan_.robots, [&](RobotPlan const& robot) { return robot.name == to; });
        if (named) return {to};
        auto const target = target_from_wire(to);
        if (!target) throw element.complain(quoted(to) + " is not a place, a robot or a point \"x, y\" of the floor plan");
        if (plan_.clearance(target->position) < person_radius)
            throw element.complain(quoted(to) + " is too near to a wall or desk: people cannot stand there");
        return {target->position};
    }

    static std::string language(xml::Element const& element, std::string const& otherwise) {
        auto language = element.token("language", otherwise);
        if (!is_language(language)) throw element.complain(quoted(language) + " is not an ISO 639-1 language such as en or ja");
        return language;
    }

    static Gender gender(xml::Element const& element) {
        auto const name = element.token("gender", "");
        if (name == "male") return Gender::male;
        if (name == "female") return Gender::female;
        return name == "not_applicable" ? Gender::not_applicable : Gender::not_known;
    }

    static void check_reaction(xml::Element const& element, std::string const& code) {
        if (reaction_code(code) == code) return;
        throw element.complain("unknown reaction " + quoted(code) + "; expected a code from 1 to " +
                               std::to_string(reaction_types.size()) + " (Annex D)");
    }

    static void check_gesture(xml::Element const& element, std::string const& id) {
        if (std::ranges::find(gestures(), id) != gestures().end()) return;
        throw element.complain("unknown gesture " + quoted(id) + "; expected one of " + listed(gestures()));
    }

    FloorPlan const& plan_;
};

Fault::Kind kind_of_fault(std::string_view name) {
    if (name == "failed") return Fault::Kind::failed;
    if (name == "complaining") return Fault::Kind::complaining;
    return name == "unstoppable" ? Fault::Kind::unstoppable : Fault::Kind::silent;
}

Fault fault(xml::Element const& element, std::vector<std::string> const& refs) {
    Fault read{.component = element.token("component", ""),
               .kind = kind_of_fault(element.token("kind", "")),
               .from = element.number("from", 0),
               .until = {}};
    if (std::ranges::find(refs, read.component) == refs.end())
        throw element.complain("unknown component " + quoted(read.component) +
                               "; expected a basic component of a robot or one of the profiles folder");
    if (element.attribute("until")) read.until = element.number("until");
    if (read.until && *read.until <= read.from) throw element.complain("'until' must be later than 'from'");
    return read;
}

Arrivals arrivals(xml::Element const& element) {
    Arrivals read{.gap_least = element.number("gap_least"),
                  .gap_most = element.number("gap_most"),
                  .at_most = static_cast<std::size_t>(element.number("at_most"))};
    if (read.gap_most < read.gap_least) throw element.complain("'gap_most' must not be less than 'gap_least'");
    return read;
}

}  // namespace

Scenario read_scenario(std::shared_ptr<xml::Schemas const> schemas, std::string name, std::string text, FloorPlan const& plan,
                       std::vector<std::string> const& components) {
    auto const document = xml::Document::parse(std::move(schemas), std::move(name), std::move(text));
    auto const root = document.root();
    if (root.name() != "scenario") throw root.complain("not a scenario: the root element must be scenario");
    Scenario scenario;
    scenario.name = root.attribute("name", "");
    if (root.attribute("round")) scenario.round = root.number("round");
    if (auto const element = root.child("arrivals")) scenario.arrivals = arrivals(*element);
    auto const refs = component_refs(plan, components);
    for (auto const& element : root.children("fault")) scenario.faults.push_back(fault(element, refs));
    ScenarioReader const reader{plan};
    for (auto const& person : root.children("person")) {
        auto role = reader.role(person);
        if (std::ranges::find(scenario.roles, role.id, &Role::id) != scenario.roles.end())
            throw person.complain("duplicate person id " + quoted(role.id));
        if (scenario.round && role.enters >= *scenario.round)
            throw person.complain("'enters' must be before the end of the round");
        scenario.roles.push_back(std::move(role));
    }
    return scenario;
}

}  // namespace rois::simulation
