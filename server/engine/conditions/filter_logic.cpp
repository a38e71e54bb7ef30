// And, Or and Not (ISO 19143, Minimum Standard Filter) in three-valued logic.
#include <algorithm>
#include <set>
#include <utility>

#include "engine/conditions/filter_compiler.hpp"

namespace rois {

namespace {

using Predicates = std::vector<PredicatePtr>;

// The operands' canonical texts, sorted and without duplicates. A single operand is returned unchanged.
std::string joined(char name, Predicates const& operands) {
    std::set<std::string> meanings;
    for (auto const& operand : operands) meanings.insert(operand->canonical());
    if (meanings.size() == 1) return *meanings.begin();
    std::string text{name};
    for (auto const& meaning : meanings) text.append("(").append(meaning).append(")");
    return text;
}

// Everything matches if there are no operands.
class All final : public Predicate {
public:
    explicit All(Predicates operands) : operands_{std::move(operands)} {}

    Match match(Candidate const& candidate) const override {
        auto worst = Match::yes;
        Effort::spend(5 * operands_.size());
        for (auto const& operand : operands_)
            if (worst = std::min(worst, operand->match(candidate)); worst == Match::no) break;
        return worst;
    }
    bool met_by_everything() const override { return operands_.empty(); }
    std::string canonical() const override { return joined('&', operands_); }
    // Returns the demand of one operand, since all operands must match. Prefers refs to types: a type has many components.
    std::optional<Demand> demand() const override {
        std::optional<Demand> narrowest;
        for (auto const& operand : operands_)
            if (auto demand = operand->demand(); demand && (!narrowest || demand->types.size() < narrowest->types.size()))
                narrowest = std::move(demand);
        return narrowest;
    }

private:
    Predicates operands_;
};

class Any final : public Predicate {
public:
    explicit Any(Predicates operands) : operands_{std::move(operands)} {}

    Match match(Candidate const& candidate) const override {
        auto best = Match::no;
        Effort::spend(5 * operands_.size());
        for (auto const& operand : operands_)
            if (best = std::max(best, operand->match(candidate)); best == Match::yes) break;
        return best;
    }
    std::string canonical() const override { return joined('|', operands_); }
    std::optional<Demand> demand() const override {
        Demand all;
        for (auto const& operand : operands_) {
            auto const demand = operand->demand();
            if (!demand) return {};
            all.widen(*demand);
        }
        return all;
    }

private:
    Predicates operands_;
};

class Contrary final : public Predicate {
public:
    explicit Contrary(PredicatePtr operand) : operand_{std::move(operand)} {}

    Match match(Candidate const& candidate) const override {
        switch (operand_->match(candidate)) {
            case Match::no:
                return Match::yes;
            case Match::maybe:
                return Match::maybe;
            case Match::yes:
                break;
        }
        return Match::no;
    }
    std::string canonical() const override { return "-(" + operand_->canonical() + ")"; }

private:
    PredicatePtr operand_;
};

// Replaces an And or Or that has one operand by that operand. Exception: an And around a group is a unr:ComponentCondition.
Condition const* innermost(Condition const* condition) {
    auto const* all = std::get_if<And>(&condition->predicate);
    auto const* any = std::get_if<Or>(&condition->predicate);
    bool const one_of_all = all != nullptr && all->operands.size() == 1;
    if (one_of_all && !std::holds_alternative<ComponentGroup>(all->operands.front().predicate))
        return innermost(&all->operands.front());
    if (any != nullptr && any->operands.size() == 1) return innermost(&any->operands.front());
    return condition;
}

// Compiles the operands of an And or Or. Merges the operands of a nested And (Or) into those of the outer one.
template <class Operator>
class Flattened {
public:
    explicit Flattened(FilterCompiler& compiler) : compiler_{compiler} {}

    void add(Operator const& many) {
        operands_.reserve(operands_.size() + many.operands.size());
        for (auto const& each : many.operands) {
            auto const& operand = *innermost(&each);
            if (auto const* same = std::get_if<Operator>(&operand.predicate)) {
                add(*same);
            } else if (auto predicate = compiler_.compile(operand)) {
                decided_ = decided_ || predicate->met_by_everything();
                if (!predicate->met_by_everything()) operands_.push_back(std::move(predicate));
            }
        }
    }

    // An operand that always matches is redundant in And, and makes Or always match.
    template <class Made>
    PredicatePtr made() && {
        if (std::is_same_v<Operator, Or> && decided_) return std::make_unique<All>(Predicates{});
        return operands_.size() == 1 ? std::move(operands_.front()) : std::make_unique<Made>(std::move(operands_));
    }

private:
    FilterCompiler& compiler_;
    Predicates operands_;
    bool decided_ = false;  // one of the operands always matches
};

}  // namespace

PredicatePtr FilterCompiler::operator()(And const& both) {
    Flattened<And> flattened{*this};
    auto const around = std::exchange(in_and_, true);
    flattened.add(both);
    in_and_ = around;
    return std::move(flattened).made<All>();
}

PredicatePtr FilterCompiler::operator()(Or const& either) {
    Flattened<Or> flattened{*this};
    auto const around = std::exchange(in_and_, false);
    flattened.add(either);
    in_and_ = around;
    return std::move(flattened).made<Any>();
}

PredicatePtr FilterCompiler::operator()(Not const& contrary) {
    auto const& operand = *innermost(&contrary.operand.front());
    if (auto const* twice = std::get_if<Not>(&operand.predicate)) return compile(twice->operand.front());
    auto const around = std::exchange(in_and_, false);
    auto predicate = compile(operand);
    in_and_ = around;
    return predicate ? std::make_unique<Contrary>(std::move(predicate)) : nullptr;
}

}  // namespace rois
