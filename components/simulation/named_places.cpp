#include "simulation/named_places.hpp"

#include "simulation/wire_units.hpp"

namespace rois::simulation {

Places named_places(FloorPlan const& plan) {
    Places places{.crs = plan.crs, .all = {{plan.name, area(plan.crs, plan.bounds)}}};
    for (Place const& place : plan.places) {
        Point const reach{place.width / 2, place.depth / 2};
        places.all.push_back({place.name, area(plan.crs, {place.pose.position - reach, place.pose.position + reach})});
    }
    return places;
}

}  // namespace rois::simulation
