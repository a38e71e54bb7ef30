// A component of the benchmarks' own, which does nothing but answer: so that what is measured is the gateway.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "types/profiles.hpp"

namespace rois::bench {

// Probes have the query `reading` (value, label), the event `probed` (stamp, value), the parameter `label` and the command
// `fire` (burst), which makes as many events. Their `start` completes at once. The stamp is "t" and CLOCK_MONOTONIC in ns.
ComponentProfile probe_profile();

// The same with the query and the event of other names: what nobody asks for.
ComponentProfile bystander_profile();

// The profiles that both include.
std::vector<ComponentProfile> known_profiles();

std::unique_ptr<Component> probe(std::string ref, std::shared_ptr<ComponentProfile const> profile);

}  // namespace rois::bench
