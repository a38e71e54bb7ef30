// Adapters make components for user-defined profiles (docs/profiles.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "basic/adapters/robots.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::basic {

// Returns the name of the profile's adapter: the adapter that its metaDataProperty names
// (urn:x-rois:def:adapter:simulation::<name>), else the adapter of the first basic component whose profile it includes. Empty if
// it has none. Sub components are looked up in `known`. Throws std::runtime_error for an unknown adapter.
std::string adapter_of(ComponentProfile const&, std::vector<ComponentProfile> const& known, Streams);

class Adapters {
public:
    Adapters(Robots robots, std::shared_ptr<xml::Schemas const> schemas)
        : robots_{std::move(robots)}, schemas_{std::move(schemas)} {}

    // Makes a component of this profile for each robot. Returns none if the profile has no adapter. Throws like adapter_of().
    std::vector<std::unique_ptr<Component>> components(ComponentProfile const&, std::vector<ComponentProfile> const& known) const;

    Streams streams() const { return robots_.streams(); }

private:
    Robots robots_;
    std::shared_ptr<xml::Schemas const> schemas_;
};

}  // namespace rois::basic
