// Adapters: what of the simulation fulfils the components that users bring a profile of (docs/profiles.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "media/media.hpp"
#include "simulation/basic_components.hpp"
#include "simulation/simulation.hpp"
#include "xml/schemas.hpp"

namespace rois::simulation {

// The adapter that fulfils a profile: the one that its metaDataProperty refers to, urn:x-rois:def:adapter:simulation::<name>,
// else that of the first basic component whose profile it includes. Empty when it asks for none. `known` are the profiles among
// which sub components are looked up. Throws std::runtime_error for an adapter that there is not.
std::string adapter_of(ComponentProfile const&, std::vector<ComponentProfile> const& known, Streams);

class Adapters {
public:
    Adapters(std::shared_ptr<Simulation> simulation, std::shared_ptr<media::Media> media,
             std::shared_ptr<xml::Schemas const> schemas)
        : simulation_{std::move(simulation)}, media_{std::move(media)}, schemas_{std::move(schemas)} {}

    // The components that a profile makes, one for each robot, fulfilled by its adapter. None when it asks for none. Throws
    // std::runtime_error for an adapter that there is not.
    std::vector<std::unique_ptr<Component>> components(ComponentProfile const&, std::vector<ComponentProfile> const& known) const;

    Streams streams() const { return simulation::streams(media_); }

private:
    std::shared_ptr<Simulation> simulation_;
    std::shared_ptr<media::Media> media_;
    std::shared_ptr<xml::Schemas const> schemas_;
};

}  // namespace rois::simulation
