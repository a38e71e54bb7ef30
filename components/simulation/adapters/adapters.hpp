// Adapters make the simulation's components for user-defined profiles (docs/profiles.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "media/media.hpp"
#include "simulation/basic/basic_components.hpp"
#include "simulation/world/simulation.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::simulation {

// Returns the name of the profile's adapter: the adapter that its metaDataProperty names
// (urn:x-rois:def:adapter:simulation::<name>), else the adapter of the first basic component whose profile it includes. Empty if
// it has none. Sub components are looked up in `known`. Throws std::runtime_error for an unknown adapter.
std::string adapter_of(ComponentProfile const&, std::vector<ComponentProfile> const& known, Streams);

class Adapters {
public:
    Adapters(std::shared_ptr<Simulation> simulation, std::shared_ptr<media::Media> media,
             std::shared_ptr<xml::Schemas const> schemas)
        : simulation_{std::move(simulation)}, media_{std::move(media)}, schemas_{std::move(schemas)} {}

    // Makes a component of this profile for each robot. Returns none if the profile has no adapter. Throws like adapter_of().
    std::vector<std::unique_ptr<Component>> components(ComponentProfile const&, std::vector<ComponentProfile> const& known) const;

    Streams streams() const { return simulation::streams(media_); }

private:
    std::shared_ptr<Simulation> simulation_;
    std::shared_ptr<media::Media> media_;
    std::shared_ptr<xml::Schemas const> schemas_;
};

}  // namespace rois::simulation
