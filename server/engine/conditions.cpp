// What operations do with their conditions (decisions 4, 18, 19).
#include <utility>

#include "engine/core.hpp"

namespace rois {

std::vector<RegisteredComponent*> Engine::Core::possible(std::optional<Refs> const& refs) const {
    std::vector<RegisteredComponent*> components;
    if (refs) {
        for (auto const& ref : *refs)
            if (auto* component = registry_.find(ref)) components.push_back(component);
        return components;
    }
    components.reserve(registry_.all().size());
    for (auto const& [ref, component] : registry_.all()) components.push_back(component.get());
    return components;
}

std::vector<RegisteredComponent*> Engine::Core::select(Selection const& selection, Session const& asker) const {
    Perspective present{registry_, places_, &asker, Perspective::Of::present};
    std::vector<Candidate const*> candidates;
    for (auto const* component : possible(selection.refs())) {
        auto const& candidate = present.candidate(*component);
        if (selection.match(candidate) == Match::yes) candidates.push_back(&candidate);
    }
    std::vector<RegisteredComponent*> found;
    found.reserve(candidates.size());
    for (auto const place : selection.order(candidates)) found.push_back(registry_.find(candidates[place]->rid()));
    return found;
}

std::optional<std::string> Engine::Core::choose(Results& results, QueryExpression const& condition, Declarations const& known,
                                                std::string_view id) const {
    auto filter = Filter::compile(condition, {.places = &places_, .parameters = nullptr, .results = &known});
    if (auto* problem = std::get_if<std::string>(&filter)) return std::move(*problem);
    if (std::get<Filter>(filter).match(ResultsCandidate{results, id}) != Match::yes) results = {};
    return {};
}

}  // namespace rois
