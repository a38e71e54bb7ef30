#include "engine/component_index.hpp"

#include <algorithm>
#include <utility>

#include "engine/registry.hpp"

namespace rois {

namespace {

using Components = std::vector<RegisteredComponent*>;

std::string const& ref_of(RegisteredComponent const* component) { return component->ref().code; }

void add_to(Components& components, RegisteredComponent& component) {
    auto const place = std::ranges::lower_bound(components, ref_of(&component), {}, ref_of);
    if (place == components.end() || *place != &component) components.insert(place, &component);
}

void remove_from(Components& components, RegisteredComponent const& component) {
    auto const place = std::ranges::lower_bound(components, ref_of(&component), {}, ref_of);
    if (place != components.end() && *place == &component) components.erase(place);
}

}  // namespace

ComponentsInOrder::ComponentsInOrder(View view, std::vector<RegisteredComponent*> own, std::vector<List> others)
    : view_{view}, own_{std::move(own)}, first_{own_}, others_{std::move(others)} {}

RegisteredComponent* ComponentsInOrder::next() {
    for (;;) {
        auto* lowest = first_.empty() ? nullptr : first_.front();
        bool const is_demanded = lowest != nullptr && !own_.empty();
        for (auto const& list : others_)
            if (!list.empty() && (lowest == nullptr || ref_of(list.front()) < ref_of(lowest))) lowest = list.front();
        bool const is_shown = lowest == nullptr || !lowest->is_member || view_.members == Members::shown ||
                              (is_demanded && first_.front() == lowest);
        auto const pass = [&](List& list) {
            if (!list.empty() && list.front() == lowest) list = list.subspan(1);
        };
        pass(first_);
        for (auto& list : others_) pass(list);
        if (lowest == nullptr || (is_shown && view_.shows(ref_of(lowest)))) return lowest;
    }
}

std::vector<RegisteredComponent*> ComponentsInOrder::rest() {
    std::vector<RegisteredComponent*> components;
    while (auto* component = next()) components.push_back(component);
    return components;
}

void ComponentIndex::add(RegisteredComponent& component) {
    add_to(all_, component);
    add_to(by_type_[component.type_key()], component);
}

void ComponentIndex::remove(RegisteredComponent const& component) {
    remove_from(all_, component);
    auto const alike = by_type_.find(component.type_key());
    if (alike == by_type_.end()) return;
    remove_from(alike->second, component);
    if (alike->second.empty()) by_type_.erase(alike);
}

ComponentsInOrder ComponentIndex::possible(std::optional<Demand> const& demand, View view) const {
    if (!demand) return {view, all_};
    Components named;
    named.reserve(demand->refs.size());
    for (auto const ref : demand->refs) {
        auto const place = std::ranges::lower_bound(all_, ref, {}, ref_of);
        if (place != all_.end() && ref_of(*place) == ref) named.push_back(*place);
    }
    std::vector<ComponentsInOrder::List> of_types;
    for (auto const type : demand->types)
        if (auto const alike = by_type_.find(type); alike != by_type_.end()) of_types.emplace_back(alike->second);
    return {view, std::move(named), std::move(of_types)};
}

}  // namespace rois
