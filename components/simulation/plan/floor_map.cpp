#include "simulation/plan/floor_map.hpp"

#include <utility>
#include <vector>

#include "simulation/world/units.hpp"

namespace rois::simulation {
namespace {

using basic::degrees;
using basic::millimetres;
using basic::rows_of;

FloorMap::Box drawn(Box const& box) {
    Point const size = box.high - box.low;
    return {.x = millimetres(box.low.x()),
            .y = millimetres(box.low.y()),
            .width = millimetres(size.x()),
            .depth = millimetres(size.y())};
}

FloorMap::Wall drawn(Segment const& wall) {
    return {.x1 = millimetres(wall.from.x()),
            .y1 = millimetres(wall.from.y()),
            .x2 = millimetres(wall.to.x()),
            .y2 = millimetres(wall.to.y())};
}

FloorMap::Place drawn(Place const& place) {
    return {.name = place.name,
            .x = millimetres(place.pose.position.x()),
            .y = millimetres(place.pose.position.y()),
            .heading = degrees(place.pose.heading),
            .width = millimetres(place.width),
            .depth = millimetres(place.depth)};
}

FloorMap::Robot drawn(RobotPlan const& robot) {
    FloorMap::Robot drawn{.name = robot.name, .radius = millimetres(robot.radius), .frame = {}};
    if (!robot.frame) return drawn;
    auto const& [crs, origin, sigma, heading_sigma] = *robot.frame;
    drawn.frame = {.crs = crs,
                   .x = millimetres(origin.position.x()),
                   .y = millimetres(origin.position.y()),
                   .heading = degrees(origin.heading)};
    return drawn;
}

}  // namespace

FloorMap floor_map(FloorPlan const& plan) {
    FloorMap map{.name = plan.name,
                 .crs = plan.crs,
                 .bounds = drawn(plan.bounds),
                 .walls = {},
                 .furniture = {},
                 .places = {},
                 .robots = {}};
    for (Segment const& wall : plan.walls) map.walls.push_back(drawn(wall));
    for (Box const& desk : plan.desks) map.furniture.push_back(drawn(desk));
    for (Place const& place : plan.places) map.places.push_back(drawn(place));
    for (RobotPlan const& robot : plan.robots) map.robots.push_back(drawn(robot));
    return map;
}

namespace {

// Makes the frame `crs` that has this pose in `base`.
Frame placed(std::string crs, std::string base, Pose const& pose, Covariance const& covariance) {
    return {.crs = std::move(crs),
            .base = std::move(base),
            .position = {millimetres(pose.position.x()), millimetres(pose.position.y()), 0},
            .orientation = {0, 0, degrees(pose.heading)},
            .covariance = rows_of(covariance)};
}

// Makes the geometry of a box of the floor, for conditions.
Geometry area(std::string crs, Box const& box) {
    return {.crs = std::move(crs),
            .low = {millimetres(box.low.x()), millimetres(box.low.y()), 0},
            .high = {millimetres(box.high.x()), millimetres(box.high.y()), 0},
            .dimensions = 2};
}

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
