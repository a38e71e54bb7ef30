#include "simulation/component_refs.hpp"

#include <algorithm>

#include "simulation/basic_components.hpp"
#include "types/texts.hpp"

namespace rois::simulation {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_small_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }
bool is_big(char c) { return c >= 'A' && c <= 'Z'; }

bool is_name(std::string_view text) {
    auto const fits = [](char c) { return is_letter(c) || is_small_or_digit(c) || c == '-'; };
    return !text.empty() && is_letter(text.front()) && std::ranges::all_of(text, fits);
}

}  // namespace

std::string component_ref(std::string_view component, std::string_view engine) {
    return engine.empty() ? std::string{component} : std::string{engine} + "." + std::string{component};
}

std::vector<std::string> component_refs(FloorPlan const& plan, std::vector<std::string> const& further) {
    std::vector<std::string> refs;
    for (auto const& robot : plan.robots) {
        bool const first = &robot == &plan.robots.front();
        auto const engine = first ? "" : robot.name;
        for (auto const& basic : basic_components()) refs.push_back(component_ref(basic.ref, engine));
        for (auto const& name : further) refs.push_back(component_ref(name, engine));
    }
    return refs;
}

std::string component_name(ComponentProfile const& profile) {
    if (is_name(profile.object.name)) return profile.object.name;
    auto const& urn = profile.object.identifier;
    std::string name;
    for (char const c : urn.substr(urn.rfind(':') + 1)) {
        if (is_big(c) && !name.empty() && is_small_or_digit(name.back())) name += '_';
        name += is_letter(c) || is_small_or_digit(c) ? c : '_';
    }
    return is_name(name) ? lower_case(name) : "_" + lower_case(name);
}

}  // namespace rois::simulation
