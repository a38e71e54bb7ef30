// Compiled conditions (ISO 19143). References are resolved, and numbers, times, geometries and patterns parsed, so matching only
// compares. For their meaning see docs/conditions.md.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/conditions/candidate.hpp"
#include "engine/conditions/demand.hpp"
#include "engine/conditions/vocabulary.hpp"
#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois {

class Predicate;
class SortKey;

// A compiled condition without SortBy.
class Filter {
public:
    Filter();  // matches every candidate
    ~Filter();
    Filter(Filter&&) noexcept;
    Filter& operator=(Filter&&) noexcept;

    // Returns the filter, or why the condition is invalid. The reason names the part that is not supported, or the name that is
    // not in the vocabulary. Rejects SortBy, which only a Selection supports.
    static std::variant<Filter, std::string> compile(QueryExpression const&, Vocabulary const&);

    Match match(Candidate const&) const;

    // Returns false if every candidate matches.
    bool restricts() const { return predicate_ != nullptr; }

    // Returns a canonical text, the same for equivalent conditions (decision 20). Computed at each call.
    std::string meaning() const;

    // Returns the components that can match, also those with `maybe`; nullopt if any component can. The texts belong to the
    // filter.
    std::optional<Demand> demand() const;

    // The number of predicates, as a measure of the cost of a match.
    std::size_t predicates() const { return predicates_; }

    // The total length of the texts, including the points of geometries, as a measure of memory.
    std::size_t text_bytes() const { return text_bytes_; }

    // The references to results, in the order in which the condition has them.
    std::vector<Reference> const& results() const { return results_; }

    // Returns whether the result of a match may depend on the session that asks. The status and parameters of components do
    // (decisions 7 and 30).
    bool depends_on_asker() const { return depends_on_asker_; }

    // Returns whether the condition refers to engines or robots. It can then match the members of logical components; other
    // conditions only match the members whose refs they demand (docs/choosing.md).
    bool names_units() const { return names_units_; }

private:
    friend class Selection;
    static std::variant<Filter, std::string> compile(std::optional<Condition> const&, Vocabulary const&);

    std::unique_ptr<Predicate const> predicate_;  // null: matches every candidate
    std::size_t predicates_ = 0;
    std::size_t text_bytes_ = 0;
    std::vector<Reference> results_;
    bool depends_on_asker_ = false;
    bool names_units_ = false;
};

// A filter with a sort order.
class Selection {
public:
    ~Selection();
    Selection(Selection&&) noexcept;
    Selection& operator=(Selection&&) noexcept;

    static std::variant<Selection, std::string> compile(QueryExpression const&, Vocabulary const&);

    Match match(Candidate const& candidate) const { return filter_.match(candidate); }
    Filter const& filter() const { return filter_; }

    bool sorts() const { return !keys_.empty(); }

    // Returns the indexes of the candidates in sorted order. The sort is stable; candidates without a value come last.
    std::vector<std::size_t> order(std::vector<Candidate const*> const&) const;

private:
    Selection();

    Filter filter_;
    std::vector<std::unique_ptr<SortKey const>> keys_;
};

// Removes the results that the filter does not match (decision 19). `id` is the id in the request for the results.
//
// Lists of the same length are parallel: `person_ref`, `position_data` and the `located` elements of both. If the filter refers
// to such lists, it is matched against each entry as a whole row, with the scalar results beside it. Keeps the entries that
// match, all scalars, and the lists of other lengths. If the filter refers to no list, keeps all results or none.
void keep_matching(Results&, Filter const&, std::string_view id);

}  // namespace rois
