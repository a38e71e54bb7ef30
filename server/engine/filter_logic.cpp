// And, Or and Not (ISO 19143, Minimum Standard Filter) in three values.
#include <algorithm>
#include <map>

#include "engine/filter_compiler.hpp"

namespace rois {

namespace {

using Predicates = std::vector<PredicatePtr>;

std::string joined(char name, Predicates const& operands) {
    std::string text{name};
    for (auto const& operand : operands) text += "(" + operand->canonical() + ")";
    return text;
}

// Met by everything when it has no operands.
class All final : public Predicate {
public:
    explicit All(Predicates operands) : operands_{std::move(operands)} {}

    Match match(Candidate const& candidate) const override {
        auto worst = Match::yes;
        for (auto const& operand : operands_)
            if (worst = std::min(worst, operand->match(candidate)); worst == Match::no) break;
        return worst;
    }
    std::string canonical() const override { return joined('&', operands_); }

private:
    Predicates operands_;
};

class Any final : public Predicate {
public:
    explicit Any(Predicates operands) : operands_{std::move(operands)} {}

    Match match(Candidate const& candidate) const override {
        auto best = Match::no;
        for (auto const& operand : operands_)
            if (best = std::max(best, operand->match(candidate)); best == Match::yes) break;
        return best;
    }
    std::string canonical() const override { return joined('|', operands_); }

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

// And or Or with one operand stands for that operand.
Condition const* innermost(Condition const* condition) {
    auto const* all = std::get_if<And>(&condition->predicate);
    auto const* any = std::get_if<Or>(&condition->predicate);
    if (all != nullptr && all->operands.size() == 1) return innermost(&all->operands.front());
    if (any != nullptr && any->operands.size() == 1) return innermost(&any->operands.front());
    return condition;
}

// Operands in the order of their meanings, those of the same operator inside among them, none twice.
template <class Operator>
class Flattened {
public:
    explicit Flattened(FilterCompiler& compiler) : compiler_{compiler} {}

    void add(Operator const& many) {
        for (auto const& each : many.operands) {
            auto const& operand = *innermost(&each);
            if (auto const* same = std::get_if<Operator>(&operand.predicate)) {
                add(*same);
            } else if (auto predicate = compiler_.compile(operand)) {
                auto meaning = predicate->canonical();
                by_meaning_.try_emplace(std::move(meaning), std::move(predicate));
            }
        }
    }

    // What everything meets adds nothing to And, and decides Or.
    template <class Made>
    PredicatePtr made() && {
        if (by_meaning_.contains(met_by_everything)) {
            if (std::is_same_v<Operator, Or>) return std::make_unique<All>(Predicates{});
            by_meaning_.erase(met_by_everything);
        }
        Predicates operands;
        for (auto& [meaning, predicate] : by_meaning_) operands.push_back(std::move(predicate));
        return operands.size() == 1 ? std::move(operands.front()) : std::make_unique<Made>(std::move(operands));
    }

private:
    FilterCompiler& compiler_;
    std::map<std::string, PredicatePtr> by_meaning_;
};

}  // namespace

PredicatePtr FilterCompiler::operator()(And const& both) {
    Flattened<And> flattened{*this};
    flattened.add(both);
    return std::move(flattened).made<All>();
}

PredicatePtr FilterCompiler::operator()(Or const& either) {
    Flattened<Or> flattened{*this};
    flattened.add(either);
    return std::move(flattened).made<Any>();
}

PredicatePtr FilterCompiler::operator()(Not const& contrary) {
    auto const& operand = *innermost(&contrary.operand.front());
    if (auto const* twice = std::get_if<Not>(&operand.predicate)) return compile(twice->operand.front());
    auto predicate = compile(operand);
    return predicate ? std::make_unique<Contrary>(std::move(predicate)) : nullptr;
}

}  // namespace rois
