#include "broken/rules.hpp"

namespace rois::broken {

namespace {

std::string data(std::string const& file) { return ROIS_SOURCE_DIR "/tests/broken/data/" + file; }

}  // namespace

Settings settings_of(World world) {
    switch (world) {
        case World::empty_hall:
            return {};
        case World::calm_hall:
            return {{"--sim-speed", "3"}, ""};
        case World::slow_hall:
            return {{"--sim-speed", "1"}, ""};
        case World::visitor:
            return {{"--sim-speed", "4", "--floor-plan", data("one_room.xml"), "--scenario", data("standing_visitor.xml")},
                    " --room 1500"};
        case World::strollers:
            return {{"--sim-speed", "4", "--floor-plan", data("one_room.xml"), "--scenario", data("strolling_visitors.xml")}, ""};
        case World::two_robots:
            return {{"--sim-speed", "4", "--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml"},
                    " --room 600"};
        case World::failed_functions:
            return {{"--start-timeout", "1", "--scenario", data("unwell_functions.xml")}, ""};
        case World::team:
            return {{}, " --patience 10"};
        case World::short_expiry:
            return {{"--event-details", "1"}, ""};
    }
    return {};
}

}  // namespace rois::broken
