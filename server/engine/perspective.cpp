#include "engine/perspective.hpp"

#include "engine/registry.hpp"

namespace rois {

Perspective::Perspective(Registry const& registry, Places const& places, Session const* asker, Of of)
    : registry_{registry}, places_{places}, asker_{asker}, of_{of} {}

Candidate const& Perspective::candidate(RegisteredComponent const& component) {
    return components_.try_emplace(&component, component, *this).first->second;
}

std::vector<Candidate const*> const& Perspective::robot(std::string_view engine) {
    if (robots_.empty())
        for (auto const& [ref, component] : registry_.all()) robots_[component->entry().engine].push_back(&candidate(*component));
    static std::vector<Candidate const*> const none;
    auto const found = robots_.find(engine);
    return found == robots_.end() ? none : found->second;
}

}  // namespace rois
