#include "simulation/adapters/robots.hpp"

#include <utility>

#include "simulation/robot/robot_body.hpp"

namespace rois::simulation {

basic::Robots robots(std::shared_ptr<Simulation> const& simulation, std::shared_ptr<media::Media> media) {
    basic::Robots robots{.bodies = {}, .media = std::move(media)};
    for (Robot const& robot : simulation->hall().robots())
        robots.bodies.push_back(std::make_shared<RobotBody>(simulation, robot.id));
    robots.wrap = [simulation](std::unique_ptr<Component> component) { return with_faults(std::move(component), simulation); };
    robots.prefix_first = simulation->hall().plan().prefix_first;
    return robots;
}

}  // namespace rois::simulation
