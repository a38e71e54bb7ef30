// PropertyIsLike, PropertyIsNull, PropertyIsNil and ResourceId (ISO 19143, Standard Filter and Resource Identification).
#include <algorithm>
#include <array>

#include "engine/conditions/filter_compiler.hpp"
#include "engine/conditions/like_pattern.hpp"
#include "types/identifier_length.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

class Like final : public Predicate {
public:
    enum class Case : std::uint8_t { matched, ignored };

    Like(Reference reference, LikePattern pattern, Case letters)
        : reference_{std::move(reference)}, pattern_{std::move(pattern)}, letters_{letters} {}

    Match match(Candidate const& candidate) const override {
        auto const texts = candidate.texts(reference_);
        if (!texts) return Match::maybe;
        bool const met = std::ranges::any_of(*texts, [&](std::string_view text) {
            text = trimmed(text);
            Effort::spend(pattern_.steps(text.size()));
            return letters_ == Case::ignored ? pattern_.matches(folded_case(text)) : pattern_.matches(text);
        });
        return met ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        return (letters_ == Case::ignored ? "like~(" : "like(") + rois::canonical(reference_) + "," + pattern_.canonical() + ")";
    }

private:
    Reference reference_;
    LikePattern pattern_;
    Case letters_;
};

// Whether a candidate without a value matches.
enum class Without : std::uint8_t {
    any,          // all of them
    missing,      // the candidate has the property, but no value of it
    inapplicable  // the candidate does not have the property
};

class Null final : public Predicate {
public:
    Null(Reference reference, Without without) : reference_{std::move(reference)}, without_{without} {}

    Match match(Candidate const& candidate) const override {
        bool const place = reference_.to == Reference::To::location || reference_.to == Reference::To::located;
        auto const empty = place ? is_empty(candidate.positions(reference_)) : is_empty(candidate.texts(reference_));
        if (!empty) return Match::maybe;
        if (!*empty) return Match::no;
        if (without_ == Without::any) return Match::yes;
        return candidate.has(reference_) == (without_ == Without::missing) ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        static constexpr std::array<std::string_view, 3> names{"null", "missing", "inapplicable"};
        return std::string{names.at(static_cast<std::size_t>(without_))} + "(" + rois::canonical(reference_) + ")";
    }

private:
    template <class Values>
    static std::optional<bool> is_empty(std::optional<Values> const& values) {
        return values ? std::optional{values->empty()} : std::nullopt;
    }

    Reference reference_;
    Without without_;
};

class Named final : public Predicate {
public:
    explicit Named(std::string rid) : rid_{std::move(rid)} {}

    Match match(Candidate const& candidate) const override { return candidate.rid() == rid_ ? Match::yes : Match::no; }
    std::string canonical() const override { return "rid(" + std::to_string(rid_.size()) + ":" + rid_ + ")"; }
    std::optional<Demand> demand() const override { return Demand{.refs = {rid_}, .types = {}}; }

private:
    std::string rid_;
};

// For nilReasons that GML defines but that no value of the engine has.
class Never final : public Predicate {
public:
    Match match(Candidate const&) const override { return Match::no; }
    std::string canonical() const override { return "never"; }
};

ValueReference const* reference_in(Expression const& expression) { return std::get_if<ValueReference>(&expression.value); }

}  // namespace

PredicatePtr FilterCompiler::operator()(PropertyIsLike const& like) {
    for (auto const* side : {&like.left, &like.right})
        if (auto const* not_understood = std::get_if<NotUnderstood>(&side->value)) refuse(not_understood->reason);
    bool const reversed = reference_in(like.left) == nullptr;
    auto const* reference = reference_in(reversed ? like.right : like.left);
    auto const* literal = std::get_if<Literal>(&(reversed ? like.left : like.right).value);
    if (reference == nullptr || literal == nullptr) {
        refuse("PropertyIsLike in the condition needs a value reference and a literal");
        return nullptr;
    }
    auto resolved = resolve(reference->path);
    if (!resolved) return nullptr;
    auto characters = like;
    characters.match_case = like.match_case && resolved->kind != ValueKind::name;
    auto pattern = LikePattern::compile(trimmed(literal->text), characters);
    if (auto* problem = std::get_if<std::string>(&pattern)) {
        refuse(std::move(*problem));
        return nullptr;
    }
    auto const& compiled = std::get<LikePattern>(pattern);
    auto const main_engine = std::string{vocabulary_.main_engine};
    bool const of_engine = resolved->to == Reference::To::engine && !main_engine.empty();
    // The main engine has every component (decision 32).
    if (of_engine && (compiled.matches("") || compiled.matches(characters.match_case ? main_engine : folded_case(main_engine))))
        return (*this)(And{});
    return std::make_unique<Like>(std::move(*resolved), std::get<LikePattern>(std::move(pattern)),
                                  characters.match_case ? Like::Case::matched : Like::Case::ignored);
}

PredicatePtr FilterCompiler::operator()(PropertyIsNull const& null) { return (*this)(PropertyIsNil{null.value, ""}); }

PredicatePtr FilterCompiler::operator()(PropertyIsNil const& nil) {
    if (auto const* not_understood = std::get_if<NotUnderstood>(&nil.value.value)) refuse(not_understood->reason);
    auto const* reference = reference_in(nil.value);
    if (reference == nullptr) {
        refuse("PropertyIsNull or PropertyIsNil in the condition needs a value reference");
        return nullptr;
    }
    auto resolved = resolve(reference->path);
    if (!resolved) return nullptr;
    auto const reason = trimmed(nil.nil_reason);
    if (reason.empty()) return std::make_unique<Null>(std::move(*resolved), Without::any);
    if (reason == "missing") return std::make_unique<Null>(std::move(*resolved), Without::missing);
    if (reason == "inapplicable") return std::make_unique<Null>(std::move(*resolved), Without::inapplicable);
    if (reason == "unknown" || reason == "withheld" || reason == "template") return std::make_unique<Never>();
    refuse("the condition has the nilReason " + quoted(reason) +
           ", which is not known here; expected one of missing, inapplicable, unknown, withheld, template");
    return nullptr;
}

// The name of a component is its ref.
PredicatePtr FilterCompiler::operator()(ResourceId const& id) {
    if (auto problem = why_too_long("the rid of a ResourceId", id.rid)) {
        refuse(*std::move(problem));
        return nullptr;
    }
    if (vocabulary_.parameters == nullptr) return std::make_unique<Named>(id.rid);
    return (*this)(PropertyComparison{Comparator::equal, {ValueReference{"component_ref"}}, {Literal{id.rid}}});
}

}  // namespace rois
