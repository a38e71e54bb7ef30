#include "engine/candidate.hpp"

#include <algorithm>

#include "engine/component_candidate.hpp"
#include "engine/referred.hpp"
#include "engine/registry.hpp"

namespace rois {

Perspective::Perspective(Registry const& registry, Places const& places, Session const* asker, Of of)
    : registry_{registry}, places_{places}, asker_{asker}, of_{of} {}

Perspective::~Perspective() = default;

Candidate const& Perspective::candidate(RegisteredComponent const& component) {
    auto& made = components_[&component];
    if (!made) made = std::make_unique<ComponentCandidate>(component, *this);
    return *made;
}

std::vector<Candidate const*> const& Perspective::robot(std::string_view engine) {
    if (robots_.empty())
        for (auto const& [ref, component] : registry_.all()) robots_[component->entry().engine].push_back(&candidate(*component));
    static std::vector<Candidate const*> const none;
    auto const found = robots_.find(engine);
    return found == robots_.end() ? none : found->second;
}

std::optional<Texts> ToldCandidate::texts(Reference const& reference) const {
    return speaks_of_results(reference) ? texts_in(results_, reference) : component_.texts(reference);
}

std::optional<Positions> ToldCandidate::positions(Reference const& reference) const {
    return speaks_of_results(reference) ? positions_in(results_, reference) : component_.positions(reference);
}

bool ToldCandidate::has(Reference const& reference) const {
    return speaks_of_results(reference) ? is_in(results_, reference) : component_.has(reference);
}

std::optional<Texts> ResultsCandidate::texts(Reference const& reference) const { return texts_in(results_, reference); }

std::optional<Positions> ResultsCandidate::positions(Reference const& reference) const {
    return positions_in(results_, reference);
}

bool ResultsCandidate::has(Reference const& reference) const { return is_in(results_, reference); }

}  // namespace rois
