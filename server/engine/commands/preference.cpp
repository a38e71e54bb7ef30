#include "engine/commands/preference.hpp"

#include <tuple>

#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

Preference::Preference(Session const& asker) {
    for (auto const* component : asker.bound) ++bound_[component->entry().engine];
}

void Preference::order(std::vector<RegisteredComponent*>& components) const {
    std::ranges::sort(components, [](auto const* a, auto const* b) {
        return std::tuple{a->code_in_engine(), std::string_view{a->entry().engine}} <
               std::tuple{b->code_in_engine(), std::string_view{b->entry().engine}};
    });
    bring_forward(components);
}

std::size_t Preference::bound_beside(RegisteredComponent const& component) const {
    auto const found = bound_.find(component.entry().engine);
    return found == bound_.end() ? 0 : found->second;
}

}  // namespace rois
