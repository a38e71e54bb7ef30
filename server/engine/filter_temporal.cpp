// The temporal operators (ISO 19143, Temporal Filter) over moments and periods.
#include <algorithm>
#include <array>

#include "engine/filter_compiler.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

// When something is: known beforehand, or told by a candidate.
class When {
public:
    When(Period period) : when_{period} {}
    When(Reference reference) : when_{std::move(reference)} {}

    bool is_known() const { return std::holds_alternative<Period>(when_); }

    // Nothing while open.
    std::optional<std::vector<Period>> of(Candidate const& candidate) const {
        if (auto const* known = std::get_if<Period>(&when_)) return std::vector<Period>{*known};
        auto const texts = candidate.texts(std::get<Reference>(when_));
        if (!texts) return {};
        std::vector<Period> periods;
        for (auto const& text : *texts)
            if (auto const period = to_period(text)) periods.push_back(*period);
        return periods;
    }

    std::string canonical() const {
        auto const* known = std::get_if<Period>(&when_);
        if (known == nullptr) return rois::canonical(std::get<Reference>(when_));
        auto const count = [](Utc time) { return std::to_string(time.time_since_epoch().count()); };
        return "P" + count(known->begin) + ":" + count(known->end);
    }

private:
    std::variant<Period, Reference> when_;
};

bool holds(TemporalRelation relation, Period const& a, Period const& b) {
    switch (relation) {
        case TemporalRelation::after:
            return a.begin > b.end;
        case TemporalRelation::before:
            return a.end < b.begin;
        case TemporalRelation::during:
            return a.begin > b.begin && a.end < b.end;
        case TemporalRelation::t_equals:
            break;
    }
    return a == b;
}

// One of several times must meet it. "Before" is "after" with the operands exchanged.
class Temporal final : public Predicate {
public:
    Temporal(TemporalRelation relation, When left, When right)
        : relation_{relation}, left_{std::move(left)}, right_{std::move(right)} {
        if (relation_ != TemporalRelation::before) return;
        relation_ = TemporalRelation::after;
        std::swap(left_, right_);
    }

    Match match(Candidate const& candidate) const override {
        auto const left = left_.of(candidate), right = right_.of(candidate);
        if ((left && left->empty()) || (right && right->empty())) return Match::no;
        if (!left || !right) return Match::maybe;
        if (make_too_many_pairs(*left, *right)) return Match::no;
        for (auto const& a : *left)
            for (auto const& b : *right)
                if (holds(relation_, a, b)) return Match::yes;
        return Match::no;
    }

    std::string canonical() const override {
        static constexpr std::array<std::string_view, 4> names{"after", "before", "during", "at"};
        auto one = left_.canonical(), other = right_.canonical();
        if (relation_ == TemporalRelation::t_equals && other < one) std::swap(one, other);
        return std::string{names.at(static_cast<std::size_t>(relation_))} + "(" + one + "," + other + ")";
    }

private:
    TemporalRelation relation_;
    When left_;
    When right_;
};

// Nothing when refused.
std::optional<When> when(FilterCompiler& compiler, Expression const& expression) {
    if (auto const* not_understood = std::get_if<NotUnderstood>(&expression.value))
        return compiler.refuse(not_understood->reason);
    if (auto const* period = std::get_if<Period>(&expression.value)) return *period;
    if (auto const* literal = std::get_if<Literal>(&expression.value)) {
        if (auto const period = to_period(literal->text)) return *period;
        return compiler.refuse("the condition has the time " + quoted(literal->text) + ", which is none");
    }
    auto const* reference = std::get_if<ValueReference>(&expression.value);
    if (reference == nullptr) return compiler.refuse("the condition relates something to a time that is none");
    auto resolved = compiler.resolve(reference->path);
    if (!resolved) return {};
    if (resolved->kind != ValueKind::time && resolved->kind != ValueKind::any)
        return compiler.refuse("the condition takes " + quoted(reference->path) + " for a time, which it is not");
    return std::move(*resolved);
}

}  // namespace

// What is told is during what is known, in whichever order the two stand.
PredicatePtr FilterCompiler::operator()(TemporalComparison const& comparison) {
    auto const own = vocabulary_.own_time();
    if (comparison.operands.size() < 2 && own.empty()) {
        refuse("the condition has a temporal operator with one operand, which means nothing here");
        return nullptr;
    }
    auto const reference = Expression{ValueReference{std::string{own}}};
    auto left = when(*this, comparison.operands.size() < 2 ? reference : comparison.operands.front());
    auto right = left ? when(*this, comparison.operands.back()) : std::nullopt;
    if (!right) return nullptr;
    if (comparison.relation == TemporalRelation::during && left->is_known() && !right->is_known()) std::swap(left, right);
    return std::make_unique<Temporal>(comparison.relation, std::move(*left), std::move(*right));
}

}  // namespace rois
