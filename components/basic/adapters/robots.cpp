#include "basic/adapters/robots.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "basic/base/component_names.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

using SharedProfile = std::shared_ptr<ComponentProfile const>;

SharedProfile profile_of(BasicComponent const& basic, std::vector<ComponentProfile> const& profiles) {
    auto const urn = urn_of(basic);
    auto const found = std::ranges::find_if(
        profiles, [&](ComponentProfile const& p) { return equal_ignoring_case(trimmed(p.object.identifier), urn); });
    if (found == profiles.end()) throw std::runtime_error("the component profile " + urn + " is missing");
    return std::make_shared<ComponentProfile const>(*found);
}

}  // namespace

std::unique_ptr<Component> Robots::component(std::shared_ptr<Body> const& body, std::string_view name, SharedProfile profile,
                                             std::function<std::unique_ptr<LocalComponent>(Context)> const& make) const {
    auto ref = component_ref(name, body == bodies.front() && !prefix_first ? "" : body->name());
    auto made = make(make_context(body, media, std::move(ref), std::move(profile)));
    return wrap ? wrap(std::move(made)) : std::move(made);
}

std::vector<std::unique_ptr<Component>> robot_components(Robots const& robots, std::vector<ComponentProfile> const& profiles) {
    std::vector<SharedProfile> found;
    for (auto const& basic : basic_components(robots.streams())) found.push_back(profile_of(basic, profiles));
    std::vector<std::unique_ptr<Component>> components;
    for (auto const& body : robots.bodies) {
        auto profile = found.begin();
        for (auto const& basic : basic_components(robots.streams())) {
            auto const& known = *profile++;
            if (!basic.acts || !body->is_fixed()) components.push_back(robots.component(body, basic.ref, known, basic.make));
        }
    }
    return components;
}

}  // namespace rois::basic
