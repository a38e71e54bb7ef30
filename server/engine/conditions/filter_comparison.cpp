// Comparisons (ISO 19143, Minimum Standard Filter) and PropertyIsBetween: numbers as numbers, times as times, others as texts.
#include <algorithm>
#include <array>
#include <compare>
#include <initializer_list>
#include <span>

#include "engine/conditions/filter_compiler.hpp"
#include "engine/frames/space.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

enum class Case : std::uint8_t { matched, ignored };

// A value, parsed in advance as each kind of value that it can be compared as.
struct Comparable {
    std::string text;
    std::optional<double> number;
    std::optional<Utc> time;
};
using Comparables = std::vector<Comparable>;

// The settings of one comparison: kind of value, case.
struct Comparing {
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
        value.text = letters == Case::ignored ? folded_name(text) : std::string{trimmed(text)};
        return value;
    }

    // Unordered if one of the values cannot be read as this kind.
    std::partial_ordering compare(Comparable const& a, Comparable const& b) const {
        if (a.number && b.number) return *a.number <=> *b.number;
        if (a.time && b.time) return *a.time <=> *b.time;
        if (kind == ValueKind::number || kind == ValueKind::time) return std::partial_ordering::unordered;
        return a.text <=> b.text;
    }
};

// A value in the condition itself.
struct Known {
    enum class Is : std::uint8_t { literal, time } is = Is::literal;
    Comparable value;
};

// One side of a comparison.
class Side {
public:
    // Reads the expression. Sets the compiler's problem if the expression cannot be compared.
    void read(FilterCompiler& compiler, Expression const& expression) {
        if (auto const* reference = std::get_if<ValueReference>(&expression.value)) {
            if (auto resolved = compiler.resolve(reference->path)) what_ = std::move(*resolved);
        } else if (auto const* literal = std::get_if<Literal>(&expression.value)) {
            what_ =
                Known{.is = Known::Is::literal, .value = {.text = std::string{trimmed(literal->text)}, .number = {}, .time = {}}};
        } else if (auto const* function = std::get_if<Function>(&expression.value)) {
            if (auto distance = compiler.distance(*function)) what_ = std::make_unique<Distance const>(std::move(*distance));
        } else if (auto const* not_understood = std::get_if<NotUnderstood>(&expression.value)) {
            compiler.refuse(not_understood->reason);
        } else if (auto const* period = std::get_if<Period>(&expression.value);
                   period != nullptr && period->begin == period->end) {
            what_ = Known{.is = Known::Is::time, .value = {.text = to_text(period->begin), .number = {}, .time = period->begin}};
        } else {
            compiler.refuse("the condition compares a geometry or a period as a value; use a spatial or temporal operator");
        }
    }

    // The kind of the expression; nullopt for a literal, which can be of any kind.
    std::optional<ValueKind> kind() const {
        if (auto const* reference = std::get_if<Reference>(&what_)) return reference->kind;
        auto const* known = std::get_if<Known>(&what_);
        if (known == nullptr) return ValueKind::number;
        return known->is == Known::Is::time ? std::optional{ValueKind::time} : std::nullopt;
    }

    // The text of a literal, or null.
    std::string const* literal() const {
        auto const* known = std::get_if<Known>(&what_);
        return known != nullptr && known->is == Known::Is::literal ? &known->value.text : nullptr;
    }

    // Returns whether a literal can be read as `kind`.
    bool fits(ValueKind kind) const {
        auto const* text = literal();
        if (text == nullptr) return true;
        if (kind == ValueKind::number) return to_double(*text).has_value();
        if (kind == ValueKind::time) return to_utc(*text).has_value();
        return kind != ValueKind::boolean || is_boolean(*text);
    }

    // Parses a literal once, as the kind that it is compared as.
    void settle(Comparing const& manner) {
        auto const* text = literal();
        bool const as_it_is = manner.kind == ValueKind::text && manner.letters == Case::matched;
        if (text != nullptr && !as_it_is) std::get<Known>(what_).value = manner.read(*text);
    }

    // The values to compare; nullopt if they are not known yet. Values of the candidate are stored in `storage`.
    std::optional<std::span<Comparable const>> values(Candidate const& candidate, Comparing const& manner,
                                                      Comparables& storage) const {
        if (auto const* known = std::get_if<Known>(&what_)) return std::span{&known->value, 1};
        if (auto const* reference = std::get_if<Reference>(&what_)) {
            auto const texts = candidate.texts(*reference);
            if (!texts) return {};
            storage.reserve(texts->size());
            for (auto const& text : *texts) storage.push_back(manner.read(text));
            return storage;
        }
        auto const lengths = std::get<DistancePtr>(what_)->of(candidate);
        if (!lengths) return {};
        for (double const length : *lengths) storage.push_back({.text = {}, .number = length, .time = {}});
        return storage;
    }

    std::string canonical(ValueKind kind) const {
        if (auto const* reference = std::get_if<Reference>(&what_)) return rois::canonical(*reference);
        if (auto const* distance = std::get_if<DistancePtr>(&what_)) return (*distance)->canonical();
        auto const& [is, value] = std::get<Known>(what_);
        if (kind == ValueKind::number) return "N" + rois::canonical(*value.number);
        if (kind == ValueKind::time || is == Known::Is::time) return "T" + std::to_string(value.time->time_since_epoch().count());
        return "L" + std::to_string(value.text.size()) + ":" + value.text;
    }

    bool is_component_ref() const {
        auto const* reference = std::get_if<Reference>(&what_);
        return reference != nullptr && reference->to == Reference::To::component_ref && reference->position <= 1 &&
               (reference->part == Reference::Part::value || reference->part == Reference::Part::code);
    }

    bool is_engine() const {
        auto const* reference = std::get_if<Reference>(&what_);
        return reference != nullptr && reference->to == Reference::To::engine;
    }

    bool is_component_type() const {
        auto const* reference = std::get_if<Reference>(&what_);
        return reference != nullptr && reference->to == Reference::To::component_type;
    }

private:
    using DistancePtr = std::unique_ptr<Distance const>;

    static bool is_boolean(std::string_view text) {
        text = trimmed(text);
        return text == "true" || text == "false" || text == "1" || text == "0";
    }

    std::variant<Known, Reference, DistancePtr> what_;
};

// The kind of all sides that have one; `any` if they differ.
ValueKind common_kind(std::span<Side const> sides) {
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

// Prepares the sides of a comparison. Sets the compiler's problem if they cannot be compared.
Comparing settle(FilterCompiler& compiler, std::span<Side> sides, std::initializer_list<Expression const*> expressions,
                 Case letters) {
    Comparing manner;
    auto side = sides.begin();
    for (auto const* expression : expressions) (side++)->read(compiler, *expression);
    if (compiler.problem()) return manner;
    manner.kind = common_kind(sides);
    manner.letters = manner.kind == ValueKind::name ? Case::ignored : letters;
    for (auto& each : sides) {
        if (!each.fits(manner.kind)) {
            compiler.refuse("the condition compares a " + name_of(manner.kind) + " with " + quoted(*each.literal()) +
                            ", which is not one");
            return manner;
        }
        each.settle(manner);
    }
    return manner;
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

// Greater-than is stored as less-than with exchanged sides.
class Comparison final : public Predicate {
public:
    Comparison(FilterCompiler& compiler, PropertyComparison const& comparison)
        : comparator_{comparison.comparator}, action_{comparison.match_action} {
        manner_ = settle(compiler, sides_, {&comparison.left, &comparison.right},
                         comparison.match_case ? Case::matched : Case::ignored);
        if (comparator_ == Comparator::greater || comparator_ == Comparator::greater_or_equal) std::swap(sides_[0], sides_[1]);
        bool const exact =
            comparator_ == Comparator::equal && manner_.kind == ValueKind::text && manner_.letters == Case::matched;
        if (exact) named_ = literal_beside(&Side::is_component_ref);
        if (comparator_ == Comparator::equal) type_ = literal_beside(&Side::is_component_type);
    }

    Match match(Candidate const& candidate) const override {
        auto const rid = candidate.rid();
        if (named_ != nullptr && !rid.empty()) return rid == *named_ ? Match::yes : Match::no;
        Comparables left_values, right_values;
        auto const left = sides_[0].values(candidate, manner_, left_values);
        auto const right = sides_[1].values(candidate, manner_, right_values);
        if ((left && left->empty()) || (right && right->empty())) return Match::no;
        if (!left || !right) return Match::maybe;
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
        auto left = sides_[0].canonical(manner_.kind), right = sides_[1].canonical(manner_.kind);
        bool const symmetric = comparator_ == Comparator::equal || comparator_ == Comparator::not_equal;
        if (symmetric && right < left) std::swap(left, right);
        bool const by_letters = manner_.kind == ValueKind::any || manner_.kind == ValueKind::text;
        return std::string{signs.at(static_cast<std::size_t>(comparator_))} +
               std::string{actions.at(static_cast<std::size_t>(action_))} +
               (by_letters && manner_.letters == Case::ignored ? "~" : "") + "(" + left + "," + right + ")";
    }

    // Decision 32: the condition names the main engine, which has every component (by name, or with an empty text).
    bool speaks_of_main_engine(std::string_view name) const {
        auto const* literal = literal_beside(&Side::is_engine);
        if (literal == nullptr || name.empty()) return false;
        auto const manner = Comparing{.kind = ValueKind::text, .letters = manner_.letters};
        return literal->empty() || manner.read(*literal).text == manner.read(name).text;
    }

    std::optional<Demand> demand() const override {
        if (named_ != nullptr) return Demand{.refs = {*named_}, .types = {}};
        if (type_ != nullptr) return Demand{.refs = {}, .types = {*type_}};
        return {};
    }

private:
    // The literal that is compared with a reference of this kind; null if there is none.
    std::string const* literal_beside(bool (Side::*is_such)() const) const {
        if ((sides_[0].*is_such)()) return sides_[1].literal();
        return (sides_[1].*is_such)() ? sides_[0].literal() : nullptr;
    }

    Comparator comparator_;
    MatchAction action_;
    std::array<Side, 2> sides_;
    Comparing manner_;
    std::string const* named_ = nullptr;  // ref of the only component that can match, or null
    std::string const* type_ = nullptr;   // type of the only components that can match, or null
};

// Matches if one of the values is between the boundaries, both included.
class Between final : public Predicate {
public:
    Between(FilterCompiler& compiler, PropertyIsBetween const& between) {
        manner_ = settle(compiler, sides_, {&between.value, &between.lower, &between.upper}, Case::matched);
    }

    Match match(Candidate const& candidate) const override {
        Comparables storage[3];
        auto const values = sides_[0].values(candidate, manner_, storage[0]);
        auto const lowest = sides_[1].values(candidate, manner_, storage[1]);
        auto const highest = sides_[2].values(candidate, manner_, storage[2]);
        for (auto const& all : {values, lowest, highest})
            if (all && all->empty()) return Match::no;
        if (!values || !lowest || !highest) return Match::maybe;
        if (make_too_many_pairs(*values, *lowest) || make_too_many_pairs(*values, *highest)) return Match::no;
        bool const met = std::ranges::any_of(*values, [&](Comparable const& value) {
            return std::ranges::any_of(*lowest, [&](auto const& low) { return manner_.compare(low, value) <= 0; }) &&
                   std::ranges::any_of(*highest, [&](auto const& high) { return manner_.compare(value, high) <= 0; });
        });
        return met ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        return "b(" + sides_[0].canonical(manner_.kind) + "," + sides_[1].canonical(manner_.kind) + "," +
               sides_[2].canonical(manner_.kind) + ")";
    }

private:
    std::array<Side, 3> sides_;
    Comparing manner_;
};

}  // namespace

PredicatePtr FilterCompiler::operator()(PropertyComparison const& comparison) {
    bool const named_units = names_units_;
    auto made = std::make_unique<Comparison>(*this, comparison);
    if (problem_) return nullptr;
    bool const equal = comparison.comparator == Comparator::equal;
    bool const equality = equal || comparison.comparator == Comparator::not_equal;
    if (!equality || !made->speaks_of_main_engine(vocabulary_.main_engine)) return made;
    names_units_ = named_units;  // the main engine is the whole
    return equal ? (*this)(And{}) : (*this)(Not{{Condition{And{}}}});
}

PredicatePtr FilterCompiler::operator()(PropertyIsBetween const& between) {
    auto made = std::make_unique<Between>(*this, between);
    if (problem_) return nullptr;
    return made;
}

}  // namespace rois
