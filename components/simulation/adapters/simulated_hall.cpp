#include "simulation/adapters/simulated_hall.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "basic/base/component_names.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/reaction_types.hpp"
#include "basic/speech/languages.hpp"
#include "simulation/scenario/steering.hpp"
#include "simulation/world/units.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::simulation {
namespace {

using basic::gestures;
using basic::integer_of;
using basic::is_language;
using basic::text_of;

constexpr std::size_t longest_name = 64, longest_text = 16'384;  // bytes
constexpr WorldTime most_to_pass = std::chrono::hours{1};

// Writes a list with one truth value for each person.
template <class Is>
Parameter truths(std::string name, std::span<Person const> people, Is is) {
    Identifier type{.code = "bool[]", .authority = {}, .codebook_ref = {}, .version = {}};
    std::string text;
    for (auto const& person : people) text += (text.empty() ? "" : " ") + std::string{is(person) ? "true" : "false"};
    return {.name = std::move(name), .data_type_ref = std::move(type), .values = {std::move(text)}};
}

class SimulatedHall final : public LocalComponent, private Observer {
public:
    SimulatedHall(std::shared_ptr<Simulation> simulation, ComponentProfile profile) : simulation_{std::move(simulation)} {
        description_.ref = {.code = std::string{simulated_hall_ref},
                            .authority = profile.object.code_space,
                            .codebook_ref = profile.object.identifier,
                            .version = {}};
        description_.profile = std::make_shared<ComponentProfile const>(std::move(profile));
        description_.positions = {"target_position"};
        description_.provider = Simulation::provider;
        description_.returns_at_once = true;
        for (Place const& place : hall().plan().places) places_.push_back({place.name, place.pose});
    }

    ~SimulatedHall() override {
        if (is_attached()) simulation_->part(*this);
    }
    SimulatedHall(SimulatedHall const&) = delete;
    SimulatedHall& operator=(SimulatedHall const&) = delete;

    ComponentDescription const& description() const override { return description_; }

    void attach(ComponentPort& port) override {
        LocalComponent::attach(port);
        simulation_->join(*this);
    }

    ComponentStatus status() const override { return stepped_ ? ComponentStatus::ready : ComponentStatus::uninitialized; }

    // `start` does nothing: visitors can be steered without it.
    Prepared prepare(std::string_view command_type, ParameterList const& arguments) override {
        if (command_type == "set_parameter") return [](CommandHandle, Instant) {};
        if (command_type == "start")
            return [this](CommandHandle command, Instant) {
                port().completed(command, CompletedStatus::ok, {}, Afterwards::active);
            };
        if (auto problem = problem_of(command_type, arguments)) return Refused{std::move(*problem)};
        return [this, type = std::string{command_type}, arguments](CommandHandle command, Instant) {
            perform(command, type, arguments);
        };
    }

    std::optional<std::string> problem_of(std::string_view command_type, ParameterList const& arguments) const {
        if (command_type == "let_pass") return no_time(arguments);
        if (auto const* visitor = find(arguments, "visitor_ref"))
            if (auto problem = no_visitor(text_of(arguments, visitor->name))) return problem;
        if (command_type == "gesture") return no_gesture(text_of(arguments, "gesture"));
        if (command_type == "walk") return no_way(*find(arguments, "target_position"));
        if (command_type == "say")
            if (auto problem = no_words(text_of(arguments, "text"))) return problem;
        auto const language = text_of(arguments, "language");
        return language.empty() && command_type != "enter" ? std::nullopt : no_language(language);
    }

    Halted halt(Instant) override {
        orders_.clear();
        passing_.clear();
        hall().stop_steering();
        simulation_->stand_still();
        return Halted::confirmed;
    }
    void suspend(Instant) override {}
    void resume(Instant) override {}

    void perform(CommandHandle command, std::string_view command_type, ParameterList const& arguments) {
        port().started(command);
        if (command_type == "let_pass") {
            passing_.push_back({command, simulation_->let_pass(WorldTime{integer_of(arguments, "time").value_or(0)})});
        } else if (Ordered ordered{command, order(command_type, arguments)}; !completed_if_over(ordered)) {
            orders_.push_back(std::move(ordered));
        }
    }

    std::vector<Results> query(std::string_view query_type, Instant) override {
        if (query_type != "visitors") return {};
        auto const people = hall().people();
        std::vector<std::string> refs, poses;
        for (auto const& person : people) {
            refs.push_back(person.role);
            poses.push_back(basic::to_wire(person.pose));
        }
        return one_row({{texts("visitor_ref", std::move(refs)), positions("position_data", std::move(poses), hall().plan().crs),
                         truths("known", people, [](Person const& person) { return person.known; }),
                         truths("steered", people, [](Person const& person) { return is_steered(person.id); })},
                        {}});
    }

private:
    struct Ordered {
        CommandHandle command;
        SharedOrderStatus status;
    };
    struct Passing {
        CommandHandle command;
        WorldTime until;
    };

    Hall& hall() { return simulation_->hall(); }
    Hall const& hall() const { return simulation_->hall(); }

    std::optional<std::string> no_visitor(std::string_view name) const {
        if (basic::is_name(name) && name.size() <= longest_name && !hall().find_robot(name)) return {};
        return "parameter 'visitor_ref': " + quoted(name) + " is not a valid visitor name: use at most " +
               std::to_string(longest_name) + " bytes, no spaces, dots or colons, and not the name of a robot";
    }

    static std::optional<std::string> no_gesture(std::string_view gesture) {
        if (std::ranges::find(gestures(), gesture) != gestures().end()) return {};
        return "parameter 'gesture': " + quoted(gesture) + " is unknown; expected one of " + listed(gestures());
    }

    static std::optional<std::string> no_words(std::string_view text) {
        if (!text.empty() && text.size() <= longest_text) return {};
        return "parameter 'text' must have 1 to " + std::to_string(longest_text) + " bytes";
    }

    static std::optional<std::string> no_language(std::string_view language) {
        if (is_language(language)) return {};
        return "parameter 'language': " + quoted(language) + " is not supported; expected one of " + basic::names_of_languages();
    }

    std::optional<std::string> no_way(Parameter const& targets) const {
        auto const& plan = hall().plan();
        if (targets.values.empty()) return "parameter 'target_position' must have at least one position";
        auto const is_target = [&](auto const& text) { return hall().target(text).has_value(); };
        if (auto problem = basic::not_targets(targets, places_, is_target)) return problem;
        for (auto const& text : targets.values)
            if (plan.clearance(hall().target(text)->position) <= 0)
                return "parameter 'target_position': " + quoted(text) + " is outside of the hall, in a wall or in furniture";
        return {};
    }

    std::optional<std::string> no_time(ParameterList const& arguments) const {
        if (simulation_->runs_by_itself()) return "let_pass needs --sim-speed 0: time passes by itself in this simulation";
        WorldTime const time{integer_of(arguments, "time").value_or(0)};
        if (time > WorldTime{0} && time <= most_to_pass && time % Hall::step_length == WorldTime{0}) return {};
        return "parameter 'time' must be a multiple of " + std::to_string(Hall::step_length.count()) +
               " ms, more than 0 and at most 1 hour, not " + std::to_string(time.count());
    }

    SharedOrderStatus order(std::string_view command_type, ParameterList const& arguments) {
        std::string const visitor{text_of(arguments, "visitor_ref")}, language{text_of(arguments, "language")};
        if (command_type == "enter") return enter(visitor, language, basic::is_true(arguments, "known"));
        if (command_type == "say") return hall().steer(visitor, Say{language, std::string{text_of(arguments, "text")}});
        if (command_type == "gesture") return hall().steer(visitor, Gesture{std::string{text_of(arguments, "gesture")}});
        if (command_type == "leave") return hall().steer(visitor, Leave{});
        Way way;
        for (auto const& text : find(arguments, "target_position")->values) way.stops.push_back(*hall().target(text));
        return hall().steer(visitor, std::move(way));
    }

    SharedOrderStatus enter(std::string const& visitor, std::string const& language, bool known) {
        Role role;
        role.id = visitor;
        role.known = known;
        role.language = language;
        return hall().let_in(std::move(role));
    }

    // Completes the command of an order that is over. Returns false if the order is still running.
    bool completed_if_over(Ordered const& ordered) {
        switch (ordered.status->state) {
            case OrderStatus::State::running:
                return false;
            case OrderStatus::State::done:
                port().completed(ordered.command, CompletedStatus::ok);
                break;
            case OrderStatus::State::failed:
                port().completed(ordered.command, CompletedStatus::error, {}, Afterwards::as_before, ordered.status->reason);
                break;
            case OrderStatus::State::dropped:
                port().completed(ordered.command, CompletedStatus::abort);
                break;
        }
        return true;
    }

    void observe(Instant) override {
        stepped_ = true;
        std::erase_if(orders_, [&](Ordered const& ordered) { return completed_if_over(ordered); });
        for (; !passing_.empty() && passing_.front().until <= hall().now(); passing_.pop_front())
            port().completed(passing_.front().command, CompletedStatus::ok);
    }

    std::shared_ptr<Simulation> simulation_;
    ComponentDescription description_;
    std::vector<basic::NamedPlace> places_;
    bool stepped_ = false;
    std::vector<Ordered> orders_;  // running
    std::deque<Passing> passing_;
};

}  // namespace

std::unique_ptr<LocalComponent> simulated_hall(std::shared_ptr<Simulation> simulation, ComponentProfile profile) {
    return std::make_unique<SimulatedHall>(std::move(simulation), std::move(profile));
}

}  // namespace rois::simulation
