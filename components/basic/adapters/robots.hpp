// Makes the components of one or several robots.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "basic/components/basic_components.hpp"

namespace rois::basic {

// The robots of a gateway. Each is a sub engine with its name. The components of the first robot have plain refs, "navigation",
// unless `prefix_first`; the refs of the others begin with the robot's name, "robot2.navigation".
struct Robots {
    std::vector<std::shared_ptr<Body>> bodies;
    std::shared_ptr<media::Media> media;  // null without a media server: no streaming components

    // Wraps each new component, for example to make it fail in tests of applications; empty: nothing is wrapped.
    std::function<std::unique_ptr<Component>(std::unique_ptr<Component>)> wrap{};
    bool prefix_first = false;

    Streams streams() const { return media ? Streams::served : Streams::none; }

    // Makes the component `name` of one of the bodies.
    std::unique_ptr<Component> component(std::shared_ptr<Body> const&, std::string_view name,
                                         std::shared_ptr<ComponentProfile const>,
                                         std::function<std::unique_ptr<LocalComponent>(Context)> const& make) const;
};

// Makes the 15 basic components (7.6) of every robot and, with media, the two streaming components of RoIS 2.0. A fixed body has
// only those that sense. Finds their profiles by URN, urn:x-rois:def:component:OMG::Navigation, ignoring case; throws
// std::runtime_error if one is missing.
std::vector<std::unique_ptr<Component>> robot_components(Robots const&, std::vector<ComponentProfile> const& profiles);

}  // namespace rois::basic
