// Conditions made ready (ISO 19143): references resolved, numbers, times, geometries and patterns read, so that holding them
// against something only compares. docs/conditions.md says what they mean.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/candidate.hpp"
#include "engine/demand.hpp"
#include "engine/vocabulary.hpp"
#include "types/condition.hpp"

namespace rois {

class Predicate;
class SortKey;

// What is true or false of candidates.
class Filter {
public:
    Filter();  // restricts nothing
    ~Filter();
    Filter(Filter&&) noexcept;
    Filter& operator=(Filter&&) noexcept;

    // The filter, or why the condition cannot be used: what is not understood, or not known in the vocabulary, is named. SortBy
    // is refused: it has a meaning only where a Selection is made.
    static std::variant<Filter, std::string> compile(QueryExpression const&, Vocabulary const&);

    Match match(Candidate const&) const;

    // Whether there is anything that it does not let through.
    bool restricts() const { return predicate_ != nullptr; }

    // The condition's canonical text: the same for conditions that mean the same (decision 20). Made anew each time.
    std::string meaning() const;

    // Which components alone can be let through, be it with `maybe`, in order and each once; nothing when it may be any. Good for
    // as long as the filter.
    std::optional<Demand> demand() const;

    // How many predicates it is made of: what it costs to hold it against something.
    std::size_t predicates() const { return predicates_; }

    // The total length of its texts, including the points of geometries, as a measure of the memory that it takes.
    std::size_t text_bytes() const { return text_bytes_; }

    // The references to results, in the order of the condition.
    std::vector<Reference> const& results() const { return results_; }

    // Whether the answer may differ from asker to asker (`status` and parameters do, decisions 7 and 30).
    bool depends_on_asker() const { return depends_on_asker_; }

private:
    friend class Selection;
    static std::variant<Filter, std::string> compile(std::optional<Condition> const&, Vocabulary const&);

    std::unique_ptr<Predicate const> predicate_;  // null: restricts nothing
    std::size_t predicates_ = 0;
    std::size_t text_bytes_ = 0;
    std::vector<Reference> results_;
    bool depends_on_asker_ = false;
};

// A filter, and the order in which those that it lets through come.
class Selection {
public:
    ~Selection();
    Selection(Selection&&) noexcept;
    Selection& operator=(Selection&&) noexcept;

    static std::variant<Selection, std::string> compile(QueryExpression const&, Vocabulary const&);

    Match match(Candidate const& candidate) const { return filter_.match(candidate); }
    Filter const& filter() const { return filter_; }

    bool sorts() const { return !keys_.empty(); }

    // The places of these candidates in the order in which they come; those that SortBy does not tell apart stay as they are.
    // What has no value comes last.
    std::vector<std::size_t> order(std::vector<Candidate const*> const&) const;

private:
    Selection();

    Filter filter_;
    std::vector<std::unique_ptr<SortKey const>> keys_;
};

}  // namespace rois
