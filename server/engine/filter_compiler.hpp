// How conditions are made ready; the parts of Filter and Selection. Each kind of predicate has a file of its own: filter_*.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/candidate.hpp"
#include "engine/filter.hpp"
#include "engine/frames.hpp"
#include "engine/vocabulary.hpp"
#include "types/condition.hpp"

namespace rois {

// A condition made ready.
class Predicate {
public:
    virtual ~Predicate() = default;
    virtual Match match(Candidate const&) const = 0;
    // The same text for conditions that mean the same.
    virtual std::string canonical() const = 0;
    virtual bool met_by_everything() const { return false; }
    // Which components alone can meet it, be it perhaps, in texts of its own; nothing when it may be any.
    virtual std::optional<Demand> demand() const { return {}; }
};

using PredicatePtr = std::unique_ptr<Predicate const>;

// Where something is: known beforehand, or told by a candidate.
class Whereabouts {
public:
    Whereabouts(Geometry geometry) : where_{std::move(geometry)} {}
    Whereabouts(Reference reference) : where_{std::move(reference)} {}

    Geometry const* known() const { return std::get_if<Geometry>(&where_); }  // null when a candidate tells
    std::optional<Positions> of(Candidate const&) const;
    std::string canonical() const;

private:
    std::variant<Geometry, Reference> where_;
};

// The function `distance`: mm between the nearest of two things; nothing while open, and none when either has no place or they
// have no frame in common.
struct Distance {
    Whereabouts from;
    Whereabouts to;
    Frames const* frames;

    std::optional<std::vector<double>> of(Candidate const&) const;
    std::string canonical() const;
};

// Of lists that make more pairs nothing is said: nothing is met.
inline constexpr std::size_t most_pairs = 100'000;
template <class One, class Other>
bool make_too_many_pairs(One const& one, Other const& other) {
    return one.size() > 1 && other.size() > 1 && one.size() > most_pairs / other.size();
}

// Goes through a condition once. What cannot be used is refused with its reason; the first one counts, and what is returned then
// means nothing.
class FilterCompiler {
public:
    static constexpr std::size_t most_predicates = 256;      // in one condition
    static constexpr std::size_t points_of_a_predicate = 8;  // so many points of a line or polygon cost as much as a predicate

    explicit FilterCompiler(Vocabulary vocabulary) : vocabulary_{vocabulary} {}

    PredicatePtr compile(Condition const&);

    // Nothing when refused.
    std::optional<Reference> resolve(std::string_view path);
    std::optional<Whereabouts> whereabouts(Expression const&);
    std::optional<Distance> distance(Function const&);

    // Two things that a condition relates; nothing when refused.
    std::optional<std::pair<Whereabouts, Whereabouts>> related(Expression const&, Expression const&);

    // Always nothing.
    std::nullopt_t refuse(std::string reason);

    std::optional<std::string> const& problem() const { return problem_; }
    bool depends_on_asker() const { return depends_on_asker_; }
    std::size_t predicates() const { return predicates_; }
    std::size_t text_bytes() const { return text_bytes_; }
    std::vector<Reference> const& results() const { return results_; }
    Vocabulary const& vocabulary() const { return vocabulary_; }

    PredicatePtr operator()(PropertyComparison const&);
    PredicatePtr operator()(PropertyIsLike const&);
    PredicatePtr operator()(PropertyIsNull const&);
    PredicatePtr operator()(PropertyIsNil const&);
    PredicatePtr operator()(PropertyIsBetween const&);
    PredicatePtr operator()(SpatialComparison const&);
    PredicatePtr operator()(DistanceComparison const&);
    PredicatePtr operator()(TemporalComparison const&);
    PredicatePtr operator()(ResourceId const&);
    PredicatePtr operator()(And const&);
    PredicatePtr operator()(Or const&);
    PredicatePtr operator()(Not const&);
    PredicatePtr operator()(ComponentGroup const&);
    PredicatePtr operator()(NotUnderstood const&);

private:
    Vocabulary vocabulary_;
    std::vector<std::string> aliases_;  // of the group whose filter is compiled
    bool in_and_ = false;               // where a group is the type of a unr:ComponentCondition (types/condition.hpp)
    std::optional<std::string> problem_;
    std::vector<Reference> results_;  // the references to results, so far
    bool depends_on_asker_ = false;
    std::size_t predicates_ = 0;
    std::size_t text_bytes_ = 0;
};

// What a SortProperty sorts by.
class SortKey {
public:
    SortKey(std::variant<Reference, Distance> by, SortOrder order) : by_{std::move(by)}, order_{order} {}

    // A value to sort by; nothing when the candidate has none.
    struct Value {
        std::optional<double> number;
        std::string text;
    };
    std::optional<Value> value(Candidate const&) const;

    // Less than 0 when a comes before b.
    int compare(std::optional<Value> const& a, std::optional<Value> const& b) const;

private:
    std::variant<Reference, Distance> by_;
    SortOrder order_;
};

}  // namespace rois
