// What operations do with their conditions (decisions 4, 18, 19).
#include <utility>

#include "engine/core.hpp"

namespace rois {

bool Engine::Core::may_ever_match(Filter const& filter, ComponentsInOrder possible, Session const& asker) const {
    Perspective ever{registry_, places_, &asker, Perspective::Of::ever};
    while (auto const* component = possible.next())
        if (filter.match(ever.candidate(*component)) != Match::no) return true;
    return false;
}

std::vector<RegisteredComponent*> Engine::Core::select(Selection const& selection, Session const& asker, IsEnough enough) const {
    Perspective present{registry_, places_, &asker, Perspective::Of::present};
    std::vector<RegisteredComponent*> components;
    std::vector<Candidate const*> candidates;
    auto possible = registry_.possible(selection.filter().demand());
    while (auto* component = possible.next()) {
        auto const& candidate = present.candidate(*component);
        if (selection.match(candidate) != Match::yes) continue;
        components.push_back(component);
        candidates.push_back(&candidate);
        if (enough != nullptr && !selection.sorts() && enough(*component)) break;
    }
    if (!selection.sorts()) return components;
    std::vector<RegisteredComponent*> found;
    found.reserve(components.size());
    for (auto const place : selection.order(candidates)) found.push_back(components[place]);
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
