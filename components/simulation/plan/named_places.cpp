#include "simulation/plan/named_places.hpp"

#include <utility>
#include <vector>

#include "simulation/world/wire_units.hpp"

namespace rois::simulation {
namespace {

Frames frames(FloorPlan const& plan) {
    std::vector<Frame> others;
    for (RobotPlan const& robot : plan.robots) {
        if (!robot.frame) continue;
        auto const& [crs, origin, sigma, heading_sigma] = *robot.frame;
        Eigen::Vector3d const variances{sigma * sigma, sigma * sigma, heading_sigma * heading_sigma};
        others.push_back(placed(crs, plan.crs, origin, variances.asDiagonal().toDenseMatrix()));
    }
    return {plan.crs, std::move(others)};
}

}  // namespace

Places named_places(FloorPlan const& plan) {
    Places places{.frames = frames(plan), .all = {{plan.name, area(plan.crs, plan.bounds)}}};
    for (Place const& place : plan.places) {
        Point const reach{place.width / 2, place.depth / 2};
        places.all.push_back({place.name, area(plan.crs, {place.pose.position - reach, place.pose.position + reach})});
    }
    return places;
}

}  // namespace rois::simulation
