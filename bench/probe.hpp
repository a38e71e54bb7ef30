// A component for benchmarks. It answers with constant values, so that the benchmark measures the gateway.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/local_component.hpp"
#include "types/profiles.hpp"

namespace rois::bench {

// A probe has the query `reading` (value, label), the event `probed` (stamp, value), the parameter `label` and the command
// `fire` (burst), which fires `burst` events. Its `start` completes at once. The stamp is "t" and CLOCK_MONOTONIC in ns.
ComponentProfile probe_profile();

// The same profile with other names for the query and the event. No benchmark uses them.
ComponentProfile bystander_profile();

// The profiles that probe and bystander include as sub components.
std::vector<ComponentProfile> known_profiles();

// `engine`: name of the sub engine that it belongs to; empty: the main engine.
std::unique_ptr<Component> probe(std::string ref, std::shared_ptr<ComponentProfile const> profile, std::string engine = {});

}  // namespace rois::bench
