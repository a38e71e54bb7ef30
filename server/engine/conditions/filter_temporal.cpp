// Temporal operators (ISO 19143, Temporal Filter) on moments and periods.
#include <optional>
#include <variant>

#include "engine/conditions/filter_compiler.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// An operand of a temporal operator: a time of the condition, or a reference to times of the candidate.
class TemporalOperand {
public:
    TemporalOperand(Period period) : when_{period} {}
    TemporalOperand(Reference reference) : when_{std::move(reference)} {}

    bool is_known() const { return std::holds_alternative<Period>(when_); }

    // nullopt if the value is not known yet.
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

// Returns the relation that is stored instead, with exchanged operands; nullopt if the relation is stored itself.
std::optional<TemporalRelation> converse(TemporalRelation relation) {
    switch (relation) {
        case TemporalRelation::before:
            return TemporalRelation::after;
        case TemporalRelation::begun_by:
            return TemporalRelation::begins;
        case TemporalRelation::t_contains:
            return TemporalRelation::during;
        case TemporalRelation::ended_by:
            return TemporalRelation::ends;
        case TemporalRelation::met_by:
            return TemporalRelation::meets;
        case TemporalRelation::overlapped_by:
            return TemporalRelation::t_overlaps;
        default:
            return {};
    }
}

bool is_moment(Period const& period) { return period.begin == period.end; }

bool meets(Period const& a, Period const& b) { return a.end == b.begin && !is_moment(a) && !is_moment(b); }

// ISO 19108, TM_RelativePosition. The relation must not have a converse.
bool holds(TemporalRelation relation, Period const& a, Period const& b) {
    switch (relation) {
        case TemporalRelation::after:
            return a.begin > b.end;
        case TemporalRelation::during:
            return a.begin > b.begin && a.end < b.end;
        case TemporalRelation::begins:
            return a.begin == b.begin && a.end < b.end;
        case TemporalRelation::ends:
            return a.begin > b.begin && a.end == b.end;
        case TemporalRelation::meets:
            return meets(a, b);
        case TemporalRelation::t_overlaps:
            return a.begin < b.begin && a.end > b.begin && a.end < b.end;
        case TemporalRelation::any_interacts:
            return a.begin <= b.end && b.begin <= a.end && !meets(a, b) && !meets(b, a);
        default:
            break;
    }
    return a == b;
}

// Matches if one of several times meets the relation.
class Temporal final : public Predicate {
public:
    Temporal(TemporalRelation relation, TemporalOperand left, TemporalOperand right)
        : relation_{relation}, left_{std::move(left)}, right_{std::move(right)} {
        auto const other = converse(relation_);
        if (!other) return;
        relation_ = *other;
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
        bool const symmetric = relation_ == TemporalRelation::t_equals || relation_ == TemporalRelation::any_interacts;
        auto one = left_.canonical(), other = right_.canonical();
        if (symmetric && other < one) std::swap(one, other);
        return "time " + std::to_string(static_cast<int>(relation_)) + "(" + one + "," + other + ")";
    }

private:
    TemporalRelation relation_;
    TemporalOperand left_;
    TemporalOperand right_;
};

// Returns nullopt if the expression is invalid.
std::optional<TemporalOperand> temporal_operand(FilterCompiler& compiler, Expression const& expression) {
    if (auto const* not_understood = std::get_if<NotUnderstood>(&expression.value))
        return compiler.refuse(not_understood->reason);
    if (auto const* period = std::get_if<Period>(&expression.value)) return *period;
    if (auto const* literal = std::get_if<Literal>(&expression.value)) {
        if (auto const period = to_period(literal->text)) return *period;
        return compiler.refuse("the condition has the time " + quoted(literal->text) + ", which is not a time");
    }
    auto const* reference = std::get_if<ValueReference>(&expression.value);
    if (reference == nullptr) return compiler.refuse("an operand of a temporal operator in the condition is not a time");
    auto resolved = compiler.resolve(reference->path);
    if (!resolved) return {};
    if (resolved->kind != ValueKind::time && resolved->kind != ValueKind::any)
        return compiler.refuse("the condition uses " + quoted(reference->path) + " as a time, but it is not one");
    return std::move(*resolved);
}

}  // namespace

// For During, the candidate's time must be during the condition's period, in either order of the operands.
PredicatePtr FilterCompiler::operator()(TemporalComparison const& comparison) {
    auto const own = vocabulary_.own_time();
    if (comparison.operands.size() < 2 && own.empty()) {
        refuse("the condition has a temporal operator with one operand: expected two");
        return nullptr;
    }
    auto const reference = Expression{ValueReference{std::string{own}}};
    auto left = temporal_operand(*this, comparison.operands.size() < 2 ? reference : comparison.operands.front());
    auto right = left ? temporal_operand(*this, comparison.operands.back()) : std::nullopt;
    if (!right) return nullptr;
    if (comparison.relation == TemporalRelation::during && left->is_known() && !right->is_known()) std::swap(left, right);
    return std::make_unique<Temporal>(comparison.relation, std::move(*left), std::move(*right));
}

}  // namespace rois
