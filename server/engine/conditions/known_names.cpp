// The names of parameters and results that the conditions of a client may use.
#include <utility>

#include "engine/registry.hpp"

namespace rois {

namespace {

// `all`: by the patterns of those who see them. Gathers the declarations for these rights if they are missing.
template <class All, class Gather>
Declarations const& known_to(Rights const* rights, All& all, Gather const& gather) {
    auto patterns = may_see_everything(rights) ? std::nullopt : std::optional{rights->seen()};
    if (auto const known = all.find(patterns); known != all.end()) return known->second;
    return all.emplace(std::move(patterns), gather()).first->second;
}

}  // namespace

Declarations const& Registry::parameters(Rights const* rights) const {
    return known_to(rights, parameters_, [&] {
        Declarations gathered;
        for (auto const& [ref, component] : components_) {
            if (!may_see(rights, ref)) continue;
            gathered.add(component->settable());
            if (auto const* message = find_message(component->profile(), MessageKind::query, "get_parameter"))
                gathered.add(message->results);
        }
        return gathered;
    });
}

Declarations const& Registry::results(MessageKind kind, std::string_view message, Rights const* rights) const {
    auto const& of_message = providers(kind, message);
    static Declarations const none;
    if (of_message.components.all().empty()) return none;
    return known_to(rights, of_message.results, [&] {
        Declarations gathered;
        for (auto const* component : of_message.components.all())
            if (may_see(rights, component->ref().code)) gathered.add(find_message(component->profile(), kind, message)->results);
        return gathered;
    });
}

}  // namespace rois
