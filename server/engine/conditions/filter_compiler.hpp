// The parts of Filter and Selection, and their compiler. Each kind of predicate has its own file: filter_*.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/conditions/candidate.hpp"
#include "engine/conditions/effort.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/conditions/vocabulary.hpp"
#include "engine/frames/frames.hpp"
#include "types/condition.hpp"

namespace rois {

// A part of a compiled condition.
class Predicate {
public:
    virtual ~Predicate() = default;
    virtual Match match(Candidate const&) const = 0;
    // Returns the same text for equivalent predicates.
    virtual std::string canonical() const = 0;
    virtual bool met_by_everything() const { return false; }
    // Returns the components that can match, also with `maybe`; nullopt if any component can. The texts belong to the predicate.
    virtual std::optional<Demand> demand() const { return {}; }
};

using PredicatePtr = std::unique_ptr<Predicate const>;

// Counts the steps of comparing two geometries.
void spend_for(Geometry const&, Geometry const&);

// An operand of a spatial operator: a geometry of the condition, or a reference to positions of the candidate.
class SpatialOperand {
public:
    SpatialOperand(Geometry geometry) : where_{std::move(geometry)} {}
    SpatialOperand(Reference reference) : where_{std::move(reference)} {}

    Geometry const* known() const { return std::get_if<Geometry>(&where_); }  // null for a reference
    std::optional<Positions> of(Candidate const&) const;
    std::string canonical() const;

private:
    std::variant<Geometry, Reference> where_;
};

// The function `distance`: mm between the nearest points of the operands. nullopt if a value is not known yet; empty if an
// operand has no position, or they share no frame.
struct Distance {
    SpatialOperand from;
    SpatialOperand to;
    Frames const* frames;

    std::optional<std::vector<double>> of(Candidate const&) const;
    std::string canonical() const;
};

// Two lists that form more pairs than this are not compared, and do not match. Counts the steps of comparing them.
inline constexpr std::size_t most_pairs = 100'000;
template <class One, class Other>
bool make_too_many_pairs(One const& one, Other const& other) {
    if (one.size() > 1 && other.size() > 1 && one.size() > most_pairs / other.size()) return true;
    Effort::spend(20 + 4 * one.size() * other.size());
    return false;
}

// Compiles a condition. If it is invalid, `problem` is the first reason, and all other results are meaningless.
class FilterCompiler {
public:
    static constexpr std::size_t most_predicates = 256;      // of one condition
    static constexpr std::size_t points_of_a_predicate = 8;  // points of a line or polygon that count as one

    explicit FilterCompiler(Vocabulary vocabulary) : vocabulary_{vocabulary} {}

    PredicatePtr compile(Condition const&);

    // Returns nullopt, and sets `problem`, if the path is invalid. The functions below do the same.
    std::optional<Reference> resolve(std::string_view path);
    std::optional<SpatialOperand> spatial_operand(Expression const&);
    std::optional<Distance> distance(Function const&);

    // The two operands of a spatial relation.
    std::optional<std::pair<SpatialOperand, SpatialOperand>> related(Expression const&, Expression const&);

    // Sets `problem` if it is the first one.
    std::nullopt_t refuse(std::string reason);

    std::optional<std::string> const& problem() const { return problem_; }
    bool depends_on_asker() const { return depends_on_asker_; }
    bool names_units() const { return names_units_; }
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
    // Refuses a condition with too many predicates. `explanation` ends the reason.
    void count(std::size_t predicates, std::string const& explanation = {});

    Vocabulary vocabulary_;
    std::vector<std::string> aliases_;  // of the group whose filter is being compiled
    bool in_and_ = false;               // inside of an And, a group is the type of a unr:ComponentCondition (types/condition.hpp)
    std::optional<std::string> problem_;
    std::vector<Reference> results_;  // the references to results found so far
    bool depends_on_asker_ = false;
    bool names_units_ = false;
    std::size_t predicates_ = 0;
    std::size_t text_bytes_ = 0;
};

// The key of a SortProperty.
class SortKey {
public:
    SortKey(std::variant<Reference, Distance> by, SortOrder order) : by_{std::move(by)}, order_{order} {}

    // The value to sort by; nullopt if the candidate has none.
    struct Value {
        std::optional<double> number;
        std::string text;
    };
    std::optional<Value> value(Candidate const&) const;

    // Returns less than 0 if a comes before b.
    int compare(std::optional<Value> const& a, std::optional<Value> const& b) const;

private:
    std::variant<Reference, Distance> by_;
    SortOrder order_;
};

}  // namespace rois
