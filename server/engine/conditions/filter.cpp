#include "engine/conditions/filter.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/conditions/filter_compiler.hpp"

namespace rois {

Filter::Filter() = default;
Filter::~Filter() = default;
Filter::Filter(Filter&&) noexcept = default;
Filter& Filter::operator=(Filter&&) noexcept = default;

std::variant<Filter, std::string> Filter::compile(QueryExpression const& query, Vocabulary const& vocabulary) {
    if (!query.sort_by.empty()) return "the condition has SortBy, which only get_profile, search, bind_any and query support";
    return compile(query.filter, vocabulary);
}

std::variant<Filter, std::string> Filter::compile(std::optional<Condition> const& condition, Vocabulary const& vocabulary) {
    Filter filter;
    if (!condition) return filter;
    FilterCompiler compiler{vocabulary};
    filter.predicate_ = compiler.compile(*condition);
    if (compiler.problem()) return *compiler.problem();
    filter.predicates_ = compiler.predicates();
    filter.text_bytes_ = compiler.text_bytes();
    filter.results_ = compiler.results();
    filter.depends_on_asker_ = compiler.depends_on_asker();
    if (filter.predicate_->met_by_everything()) filter = Filter{};
    filter.names_units_ = compiler.names_units();
    return filter;
}

// A reference to units counts, even if the rest of the canonical text does not show it.
std::string Filter::meaning() const {
    std::string meaning = names_units_ ? "units " : "";
    if (predicate_) meaning += predicate_->canonical();
    return meaning;
}

Match Filter::match(Candidate const& candidate) const {
    if (!predicate_) return Match::yes;
    Effort::spend(20);
    return predicate_->match(candidate);
}

std::optional<Demand> Filter::demand() const {
    auto demand = predicate_ ? predicate_->demand() : std::nullopt;
    if (demand) demand->tidy();
    return demand;
}

Selection::Selection() = default;
Selection::~Selection() = default;
Selection::Selection(Selection&&) noexcept = default;
Selection& Selection::operator=(Selection&&) noexcept = default;

std::variant<Selection, std::string> Selection::compile(QueryExpression const& query, Vocabulary const& vocabulary) {
    auto filter = Filter::compile(query.filter, vocabulary);
    if (auto* problem = std::get_if<std::string>(&filter)) return std::move(*problem);
    if (query.sort_by.size() > FilterCompiler::most_predicates)
        return "the condition has more than " + std::to_string(FilterCompiler::most_predicates) + " sort keys";
    Selection selection;
    selection.filter_ = std::get<Filter>(std::move(filter));
    FilterCompiler compiler{vocabulary};
    for (auto const& property : query.sort_by) {
        auto const* function = std::get_if<Function>(&property.by.value);
        auto const* reference = std::get_if<ValueReference>(&property.by.value);
        if (auto const* not_understood = std::get_if<NotUnderstood>(&property.by.value)) return not_understood->reason;
        if (function != nullptr) {
            if (auto distance = compiler.distance(*function))
                selection.keys_.push_back(std::make_unique<SortKey const>(std::move(*distance), property.order));
        } else if (reference != nullptr) {
            if (auto resolved = compiler.resolve(reference->path))
                selection.keys_.push_back(std::make_unique<SortKey const>(std::move(*resolved), property.order));
        }
    }
    if (compiler.problem()) return *compiler.problem();
    return selection;
}

std::vector<std::size_t> Selection::order(std::vector<Candidate const*> const& candidates) const {
    std::vector<std::vector<std::optional<SortKey::Value>>> values(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i)
        for (auto const& key : keys_) values[i].push_back(key->value(*candidates[i]));
    std::vector<std::size_t> places(candidates.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::ranges::sort(places, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < keys_.size(); ++i)
            if (int const order = keys_[i]->compare(values[a][i], values[b][i]); order != 0) return order < 0;
        return a < b;
    });
    return places;
}

}  // namespace rois
