// The comparisons (ISO 19143, Minimum Standard Filter) and PropertyIsBetween: numbers as numbers, times as times, else texts.
#include <algorithm>
#include <compare>

#include "engine/filter_compiler.hpp"
#include "engine/space.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

enum class Case : std::uint8_t { matched, ignored };

// A value read as the kinds that it may be compared as.
struct Comparable {
    std::string text;
    std::optional<double> number;
    std::optional<Utc> time;
};
using Comparables = std::vector<Comparable>;

// How the values of one comparison are compared.
struct Manner {
    ValueKind kind = ValueKind::any;
    Case letters = Case::matched;

    Comparable read(std::string_view text) const {
        if (kind == ValueKind::number) return {.text = {}, .number = to_double(text), .time = {}};
        if (kind == ValueKind::time) return {.text = {}, .number = {}, .time = to_utc(text)};
        if (kind == ValueKind::boolean) {
            auto const said = trimmed(text);
            return {.text = said == "1" ? "true" : said == "0" ? "false" : std::string{said}, .number = {}, .time = {}};
        }
        Comparable value;
        if (kind == ValueKind::any) value.number = to_double(text);
        if (kind == ValueKind::any && !value.number) value.time = to_utc(text);
        auto const said = trimmed(text);
        value.text = letters == Case::ignored ? folded_case(said) : std::string{said};
        return value;
    }

    // Unordered: also what is not of the kind.
    std::partial_ordering compare(Comparable const& a, Comparable const& b) const {
        if (a.number && b.number) return *a.number <=> *b.number;
        if (a.time && b.time) return *a.time <=> *b.time;
        if (kind == ValueKind::number || kind == ValueKind::time) return std::partial_ordering::unordered;
        return a.text <=> b.text;
    }
};

// One side of a comparison.
class Side {
public:
    explicit Side(std::string literal) : literal_{std::move(literal)} {}
    explicit Side(Utc time) : time_{time} {}
    explicit Side(Reference reference) : told_{std::move(reference)} {}
    explicit Side(Distance distance) : told_{std::move(distance)} {}

    std::optional<ValueKind> kind() const {
        if (auto const* reference = std::get_if<Reference>(&told_)) return reference->kind;
        if (std::holds_alternative<Distance>(told_)) return ValueKind::number;
        return time_ ? std::optional{ValueKind::time} : std::nullopt;
    }

    // A literal that is not of the kind it is compared as; nothing when all is well.
    std::optional<std::string> misfit(ValueKind kind) const {
        if (!literal_) return {};
        bool const fits = kind == ValueKind::number    ? to_double(*literal_).has_value()
                          : kind == ValueKind::time    ? to_utc(*literal_).has_value()
                          : kind == ValueKind::boolean ? is_boolean(*literal_)
                                                       : true;
        return fits ? std::nullopt : literal_;
    }

    // What is known beforehand is read once.
    void settle(Manner const& manner) {
        if (literal_) known_ = {manner.read(*literal_)};
        if (time_) known_ = {{.text = to_text(*time_), .number = {}, .time = time_}};
    }

    // Null while open. What a candidate tells is kept in `told`.
    Comparables const* values(Candidate const& candidate, Manner const& manner, Comparables& told) const {
        if (auto const* distance = std::get_if<Distance>(&told_)) {
            auto const lengths = distance->of(candidate);
            if (!lengths) return nullptr;
            for (double const length : *lengths) told.push_back({.text = {}, .number = length, .time = {}});
            return &told;
        }
        auto const* reference = std::get_if<Reference>(&told_);
        if (reference == nullptr) return &known_;
        auto const texts = candidate.texts(*reference);
        if (!texts) return nullptr;
        for (auto const& text : *texts) told.push_back(manner.read(text));
        return &told;
    }

    std::string canonical(ValueKind kind) const {
        if (auto const* reference = std::get_if<Reference>(&told_)) return rois::canonical(*reference);
        if (auto const* distance = std::get_if<Distance>(&told_)) return distance->canonical();
        auto const& known = known_.front();
        if (kind == ValueKind::number) return "N" + rois::canonical(*known.number);
        if (kind == ValueKind::time || time_) return "T" + std::to_string(known.time->time_since_epoch().count());
        return "L" + std::to_string(known.text.size()) + ":" + known.text;
    }

    std::optional<std::string> const& literal() const { return literal_; }
    bool is_component_ref() const {
        auto const* reference = std::get_if<Reference>(&told_);
        return reference != nullptr && reference->to == Reference::To::component_ref &&
               (reference->part == Reference::Part::value || reference->part == Reference::Part::code);
    }

private:
    static bool is_boolean(std::string_view text) {
        text = trimmed(text);
        return text == "true" || text == "false" || text == "1" || text == "0";
    }

    std::variant<std::monostate, Reference, Distance> told_;
    std::optional<std::string> literal_;
    std::optional<Utc> time_;
    Comparables known_;
};

// Nothing when refused.
std::optional<Side> side(FilterCompiler& compiler, Expression const& expression) {
    if (auto const* reference = std::get_if<ValueReference>(&expression.value)) {
        auto resolved = compiler.resolve(reference->path);
        return resolved ? std::optional{Side{std::move(*resolved)}} : std::nullopt;
    }
    if (auto const* literal = std::get_if<Literal>(&expression.value)) return Side{std::string{trimmed(literal->text)}};
    if (auto const* function = std::get_if<Function>(&expression.value)) {
        auto distance = compiler.distance(*function);
        return distance ? std::optional{Side{std::move(*distance)}} : std::nullopt;
    }
    if (auto const* not_understood = std::get_if<NotUnderstood>(&expression.value))
        return compiler.refuse(not_understood->reason);
    auto const* period = std::get_if<Period>(&expression.value);
    if (period != nullptr && period->begin == period->end) return Side{period->begin};
    return compiler.refuse(
        "the condition compares a geometry or a period as if it were a value: operators of space and time do that");
}

// The kind that all sides agree on.
ValueKind common_kind(std::vector<Side> const& sides) {
    std::optional<ValueKind> common;
    for (auto const& side : sides) {
        auto const kind = side.kind();
        if (!kind) continue;
        if (kind == ValueKind::name || common == ValueKind::name) {
            common = ValueKind::name;
        } else if (!common || *common == *kind) {
            common = kind;
        } else if (kind == ValueKind::text || common == ValueKind::text) {
            common = ValueKind::text;
        } else {
            common = ValueKind::any;
        }
    }
    return common.value_or(ValueKind::any);
}

std::string name_of(ValueKind kind) {
    if (kind == ValueKind::number) return "number";
    return kind == ValueKind::time ? "time" : "true or false";
}

// The sides of a comparison, ready to be compared; nothing when refused.
std::optional<std::vector<Side>> sides(FilterCompiler& compiler, std::vector<Expression const*> const& expressions, Case letters,
                                       Manner& manner) {
    std::vector<Side> all;
    for (auto const* expression : expressions) {
        auto made = side(compiler, *expression);
        if (!made) return {};
        all.push_back(std::move(*made));
    }
    manner.kind = common_kind(all);
    manner.letters = manner.kind == ValueKind::name ? Case::ignored : letters;
    for (auto& each : all) {
        if (auto const misfit = each.misfit(manner.kind))
            return compiler.refuse("the condition compares a " + name_of(manner.kind) + " with " + quoted(*misfit) +
                                   ", which is none");
        each.settle(manner);
    }
    return all;
}

bool holds(Comparator comparator, std::partial_ordering order) {
    switch (comparator) {
        case Comparator::equal:
            return order == 0;
        case Comparator::not_equal:
            return order < 0 || order > 0;
        case Comparator::less:
        case Comparator::greater:
            return order < 0;
        case Comparator::less_or_equal:
        case Comparator::greater_or_equal:
            break;
    }
    return order <= 0;
}

// "greater" is "less" with the sides exchanged.
class Comparison final : public Predicate {
public:
    Comparison(Comparator comparator, Side left, Side right, Manner manner, MatchAction action)
        : comparator_{comparator}, left_{std::move(left)}, right_{std::move(right)}, manner_{manner}, action_{action} {
        if (comparator == Comparator::greater || comparator == Comparator::greater_or_equal) std::swap(left_, right_);
    }

    Match match(Candidate const& candidate) const override {
        Comparables told, also_told;
        auto const* left = left_.values(candidate, manner_, told);
        auto const* right = right_.values(candidate, manner_, also_told);
        if ((left != nullptr && left->empty()) || (right != nullptr && right->empty())) return Match::no;
        if (left == nullptr || right == nullptr) return Match::maybe;
        if (make_too_many_pairs(*left, *right)) return Match::no;
        std::size_t holding = 0;
        for (auto const& a : *left)
            for (auto const& b : *right)
                if (holds(comparator_, manner_.compare(a, b))) ++holding;
        bool const met = action_ == MatchAction::any   ? holding > 0
                         : action_ == MatchAction::all ? holding == left->size() * right->size()
                                                       : holding == 1;
        return met ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        static constexpr std::array<std::string_view, 6> signs{"=", "!", "<", "<", "[", "["};
        static constexpr std::array<std::string_view, 3> actions{"", "A", "O"};
        auto left = left_.canonical(manner_.kind), right = right_.canonical(manner_.kind);
        bool const symmetric = comparator_ == Comparator::equal || comparator_ == Comparator::not_equal;
        if (symmetric && right < left) std::swap(left, right);
        bool const by_letters = manner_.kind == ValueKind::any || manner_.kind == ValueKind::text;
        return std::string{signs.at(static_cast<std::size_t>(comparator_))} +
               std::string{actions.at(static_cast<std::size_t>(action_))} +
               (by_letters && manner_.letters == Case::ignored ? "~" : "") + "(" + left + "," + right + ")";
    }

    std::optional<Refs> refs() const override {
        bool const exact =
            comparator_ == Comparator::equal && manner_.kind == ValueKind::text && manner_.letters == Case::matched;
        bool const right = right_.is_component_ref();
        auto const& literal = right ? left_.literal() : right_.literal();
        if (!exact || !literal || !(right || left_.is_component_ref())) return {};
        return Refs{*literal};
    }

private:
    Comparator comparator_;
    Side left_;
    Side right_;
    Manner manner_;
    MatchAction action_;
};

// One of the values is between the boundaries, both included.
class Between final : public Predicate {
public:
    Between(Side value, Side lower, Side upper, Manner manner)
        : value_{std::move(value)}, lower_{std::move(lower)}, upper_{std::move(upper)}, manner_{manner} {}

    Match match(Candidate const& candidate) const override {
        Comparables told[3];
        auto const* values = value_.values(candidate, manner_, told[0]);
        auto const* lowest = lower_.values(candidate, manner_, told[1]);
        auto const* highest = upper_.values(candidate, manner_, told[2]);
        for (auto const* all : {values, lowest, highest})
            if (all != nullptr && all->empty()) return Match::no;
        if (values == nullptr || lowest == nullptr || highest == nullptr) return Match::maybe;
        if (make_too_many_pairs(*values, *lowest) || make_too_many_pairs(*values, *highest)) return Match::no;
        bool const met = std::ranges::any_of(*values, [&](Comparable const& value) {
            return std::ranges::any_of(*lowest, [&](auto const& low) { return manner_.compare(low, value) <= 0; }) &&
                   std::ranges::any_of(*highest, [&](auto const& high) { return manner_.compare(value, high) <= 0; });
        });
        return met ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        return "b(" + value_.canonical(manner_.kind) + "," + lower_.canonical(manner_.kind) + "," +
               upper_.canonical(manner_.kind) + ")";
    }

private:
    Side value_;
    Side lower_;
    Side upper_;
    Manner manner_;
};

}  // namespace

PredicatePtr FilterCompiler::operator()(PropertyComparison const& comparison) {
    Manner manner;
    auto both =
        sides(*this, {&comparison.left, &comparison.right}, comparison.match_case ? Case::matched : Case::ignored, manner);
    if (!both) return nullptr;
    return std::make_unique<Comparison>(comparison.comparator, std::move((*both)[0]), std::move((*both)[1]), manner,
                                        comparison.match_action);
}

PredicatePtr FilterCompiler::operator()(PropertyIsBetween const& between) {
    Manner manner;
    auto all = sides(*this, {&between.value, &between.lower, &between.upper}, Case::matched, manner);
    if (!all) return nullptr;
    return std::make_unique<Between>(std::move((*all)[0]), std::move((*all)[1]), std::move((*all)[2]), manner);
}

}  // namespace rois
