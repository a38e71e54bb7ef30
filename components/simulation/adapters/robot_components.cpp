#include "simulation/adapters/robot_components.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "simulation/basic/basic_components.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
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

std::vector<std::unique_ptr<Component>> robot_components(std::shared_ptr<Simulation> const& simulation,
                                                         std::shared_ptr<media::Media> const& media,
                                                         std::vector<ComponentProfile> const& profiles) {
    std::vector<SharedProfile> found;
    for (auto const& basic : basic_components(streams(media))) found.push_back(profile_of(basic, profiles));
    std::vector<std::unique_ptr<Component>> components;
    for (Robot const& robot : simulation->hall().robots()) {
        auto profile = found.begin();
        for (auto const& basic : basic_components(streams(media)))
            components.push_back(
                with_faults(basic.make(make_context(simulation, media, robot, basic.ref, *profile++)), simulation));
    }
    return components;
}

}  // namespace rois::simulation
