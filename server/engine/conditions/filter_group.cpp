// Conditions on components that belong together (the ComponentGroupCondition of the published examples; docs/conditions.md).
#include <algorithm>

#include "engine/conditions/filter_compiler.hpp"
#include "types/identifier_length.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using Members = std::vector<Candidate const*>;

// The first value of a property that every component has.
std::string text_of(Candidate const& component, Reference::To to) {
    auto const texts = component.texts(Reference{.to = to, .name = {}, .entity = {}});
    return texts && !texts->empty() ? texts->front() : std::string{};
}

std::string_view last_part(std::string_view urn) { return urn.substr(urn.rfind(':') + 1); }

// Returns whether the robot has this name: its own, its engine's, or the URN of the engine.
bool is_robot(std::string_view type, std::string_view engine, std::string_view robot) {
    if (equal_ignoring_case(type, "Robot") || equal_ignoring_case(type, robot)) return true;
    auto const name = last_part(type);
    return equal_ignoring_case(name, engine) || equal_ignoring_case(name.substr(name.rfind('.') + 1), engine);
}

// Returns whether the component has the type, or its robot has. Every robot belongs to the main engine.
bool is_of(std::string_view type, Candidate const& component, std::string_view main_engine) {
    Effort::spend(40);
    if (!main_engine.empty() && (equal_ignoring_case(type, main_engine) || equal_ignoring_case(last_part(type), main_engine)))
        return true;
    auto const own = text_of(component, Reference::To::component_type);
    if (equal_ignoring_case(type, own) || equal_ignoring_case(type, last_part(own))) return true;
    return is_robot(type, text_of(component, Reference::To::engine), text_of(component, Reference::To::robot_id));
}

// A component for a group condition. A component that the asker has bound counts as free: otherwise the asker could not bind a
// second component of a group whose condition requires free components.
class ForAsker final : public WithComponent {
public:
    using WithComponent::WithComponent;

    std::optional<Texts> texts(Reference const& reference) const override {
        auto texts = component().texts(reference);
        bool const is_own = reference.to == Reference::To::bound && holder() == Holder::asker;
        if (texts && is_own) std::ranges::fill(*texts, "false");
        return texts;
    }
    std::optional<Positions> positions(Reference const& reference) const override { return component().positions(reference); }
    bool has(Reference const& reference) const override { return component().has(reference); }
};

// A robot for the filter of its group. A reference has the values of all components of the group's types; with an alias, only of
// the components of that type.
class Robot final : public Candidate {
public:
    Robot(Members const& all, std::vector<std::string> const& types, std::string_view main_engine) {
        for (auto const& type : types) {
            auto& holders = by_type_.emplace_back();
            std::ranges::copy_if(all, std::back_inserter(holders),
                                 [&](auto const* component) { return is_of(type, *component, main_engine); });
        }
        for (auto const* component : all) {
            bool const meant = types.empty() ||
                               std::ranges::any_of(types, [&](auto const& type) { return is_of(type, *component, main_engine); });
            if (meant) members_.push_back(component);
        }
    }

    bool has_all_types() const {
        return std::ranges::none_of(by_type_, [](Members const& holders) { return holders.empty(); });
    }

    std::optional<Texts> texts(Reference const& reference) const override {
        return united<Texts>(reference, [&](Candidate const& component) { return component.texts(reference); });
    }
    std::optional<Positions> positions(Reference const& reference) const override {
        return united<Positions>(reference, [&](Candidate const& component) { return component.positions(reference); });
    }
    bool has(Reference const& reference) const override {
        return std::ranges::any_of(meant(reference), [&](auto const* component) { return component->has(reference); });
    }
    std::string_view rid() const override { return {}; }
    std::vector<Candidate const*> robot() const override { return members_; }
    std::optional<GroupVerdict>* verdict(void const*) const override { return nullptr; }

private:
    Members const& meant(Reference const& reference) const {
        return reference.alias < by_type_.size() ? by_type_[reference.alias] : members_;
    }

    // nullopt if the value of one component is not known yet.
    template <class Values, class Ask>
    std::optional<Values> united(Reference const& reference, Ask const& ask) const {
        Values all;
        for (auto const* component : meant(reference)) {
            auto const values = ask(ForAsker{*component});
            if (!values) return {};
            all.insert(all.end(), values->begin(), values->end());
        }
        return all;
    }

    std::vector<Members> by_type_;
    Members members_;
};

// The type of a unr:ComponentCondition. Matches a component by its own type, not by the other components of its robot.
class OfType final : public Predicate {
public:
    OfType(std::string type, std::string_view main_engine) : type_{std::move(type)}, main_engine_{main_engine} {}

    Match match(Candidate const& candidate) const override {
        return is_of(type_, candidate, main_engine_) ? Match::yes : Match::no;
    }
    std::string canonical() const override { return "type(" + lower_case(type_) + ")"; }

private:
    std::string type_;
    std::string main_engine_;
};

class Group final : public Predicate {
public:
    Group(std::vector<std::string> types, PredicatePtr filter, std::vector<PredicatePtr> members, std::string_view main_engine)
        : types_{std::move(types)}, filter_{std::move(filter)}, members_{std::move(members)}, main_engine_{main_engine} {}

    Match match(Candidate const& candidate) const override {
        auto const own = match_itself(candidate);
        if (own == Match::no) return own;
        auto* verdict = candidate.verdict(this);
        if (verdict == nullptr) return Match::no;
        if (!*verdict) *verdict = judge(candidate.robot());
        return std::min(own, (*verdict)->match);
    }

    std::string canonical() const override {
        std::string text = "group(";
        for (auto const& type : types_) text += std::to_string(type.size()) + ":" + lower_case(type) + ",";
        text += ";" + (filter_ ? filter_->canonical() : "");
        for (auto const& member : members_) text += ";" + member->canonical();
        return text + ")";
    }

private:
    // Returns whether the group asks for this component: it is a member, or, without members, it is of one of the types.
    Match match_itself(Candidate const& candidate) const {
        if (!members_.empty()) return best(members_, ForAsker{candidate});
        bool const meant =
            types_.empty() || std::ranges::any_of(types_, [&](auto const& type) { return is_of(type, candidate, main_engine_); });
        return meant ? Match::yes : Match::no;
    }

    // Matches if each member and each type is present, and the robot meets the filter.
    Match match_robot(Members const& all) const {
        Robot const robot{all, types_, main_engine_};
        if (!robot.has_all_types()) return Match::no;
        auto worst = filter_ ? filter_->match(robot) : Match::yes;
        for (auto const& member : members_) {
            auto met = Match::no;
            for (auto const* component : all) met = std::max(met, member->match(ForAsker{*component}));
            worst = std::min(worst, met);
        }
        return worst;
    }

    GroupVerdict judge(Members const& all) const {
        GroupVerdict verdict;
        verdict.match = match_robot(all);
        if (verdict.match != Match::yes) return verdict;
        for (auto const& member : members_)
            add(verdict, all, [&](Candidate const& component) { return member->match(ForAsker{component}) == Match::yes; });
        if (!members_.empty()) return verdict;
        for (auto const& type : types_)
            add(verdict, all, [&](Candidate const& component) { return is_of(type, component, main_engine_); });
        if (types_.empty()) add(verdict, all, [](Candidate const&) { return true; });
        return verdict;
    }

    // Adds the component that is easiest to bind, among the components that `is_meant` accepts (one type or one member of the
    // group).
    template <class IsMeant>
    static void add(GroupVerdict& verdict, Members const& all, IsMeant const& is_meant) {
        Candidate const* found = nullptr;
        for (auto const* component : all)
            if (is_meant(*component) && (found == nullptr || component->holder() < found->holder())) found = component;
        if (found == nullptr) return;
        switch (found->holder()) {
            case Holder::asker:
                ++verdict.bound;
                break;
            case Holder::nobody:
                verdict.to_bind.push_back(found);
                break;
            case Holder::another_session:
                verdict.held = found;
                break;
        }
    }

    static Match best(std::vector<PredicatePtr> const& predicates, Candidate const& candidate) {
        auto met = Match::no;
        for (auto const& predicate : predicates) met = std::max(met, predicate->match(candidate));
        return met;
    }

    std::vector<std::string> types_;
    PredicatePtr filter_;
    std::vector<PredicatePtr> members_;
    std::string main_engine_;
};

}  // namespace

// A group condition is about robots and components, never about results.
PredicatePtr FilterCompiler::operator()(ComponentGroup const& group) {
    if (vocabulary_.parameters == nullptr) {
        refuse("the condition has ComponentCondition or ComponentGroupCondition, which a condition on results does not support");
        return nullptr;
    }
    count(group.types.size() + group.aliases.size(), "; each type and each alias counts as one");
    if (problem_) return nullptr;
    for (auto const& [what, names] : {std::pair{"the type of a component", &group.types}, {"an alias", &group.aliases}}) {
        for (auto const& name : *names) {
            if (auto problem = why_too_long(what, name)) {
                refuse(*std::move(problem));
                return nullptr;
            }
        }
    }
    bool const is_type = in_and_ && group.types.size() == 1 && group.members.empty() && group.filter.empty();
    if (is_type) return std::make_unique<OfType>(group.types.front(), vocabulary_.main_engine);
    auto const around = vocabulary_;
    vocabulary_.results = nullptr;
    std::vector<PredicatePtr> members;
    members.reserve(group.members.size());
    for (auto const& member : group.members) members.push_back(compile(member));
    aliases_ = group.aliases;
    auto filter = group.filter.empty() ? nullptr : compile(group.filter.front());
    aliases_.clear();
    vocabulary_ = around;
    if (problem_) return nullptr;
    if (group.types.empty() && members.empty() && filter == nullptr) return (*this)(And{});
    return std::make_unique<Group>(group.types, std::move(filter), std::move(members), vocabulary_.main_engine);
}

}  // namespace rois
