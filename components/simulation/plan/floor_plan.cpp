#include "simulation/plan/floor_plan.hpp"

#include <algorithm>
#include <set>

#include "basic/base/component_names.hpp"
#include "basic/components/basic_components.hpp"
#include "simulation/world/person.hpp"
#include "types/text/texts.hpp"

namespace rois::simulation {
namespace {

Metres inside_margin(Box const& bounds, Point const& p) {
    return std::min((p - bounds.low).minCoeff(), (bounds.high - p).minCoeff());
}

std::optional<PlanFlaw> flaw_of_places(FloorPlan const& plan) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < plan.places.size(); ++i) {
        Place const& place = plan.places[i];
        if (!names.insert(place.name).second)
            return PlanFlaw{PlanFlaw::Of::place, i, "duplicate place name " + quoted(place.name)};
        if (plan.clearance(place.pose.position) < person_radius)
            return PlanFlaw{PlanFlaw::Of::place, i,
                            quoted(place.name) + " is too near to a wall or desk: people cannot stand there"};
    }
    if (!names.contains("entrance")) return PlanFlaw{PlanFlaw::Of::plan, 0, "the place 'entrance' is missing"};
    if (!names.contains("desk")) return PlanFlaw{PlanFlaw::Of::plan, 0, "the place 'desk' is missing"};
    return std::nullopt;
}

// Duplicate frame names, ignoring case.
std::optional<PlanFlaw> flaw_of_frames(FloorPlan const& plan) {
    std::set<std::string> names{lower_case(plan.crs)};
    for (std::size_t i = 0; i < plan.robots.size(); ++i) {
        auto const& frame = plan.robots[i].frame;
        if (frame && !names.insert(lower_case(frame->crs)).second)
            return PlanFlaw{PlanFlaw::Of::robot, i, "duplicate frame name " + quoted(frame->crs)};
    }
    return std::nullopt;
}

std::optional<PlanFlaw> flaw_of_robots(FloorPlan const& plan) {
    if (std::ranges::all_of(plan.robots, &RobotPlan::fixed))
        return PlanFlaw{PlanFlaw::Of::plan, 0, "the floor plan has no robot: expected at least one that is not fixed"};
    for (std::size_t i = 0; i < plan.robots.size(); ++i) {
        RobotPlan const& robot = plan.robots[i];
        if (robot.fixed && inside_margin(plan.bounds, robot.start.position) < 0)
            return PlanFlaw{PlanFlaw::Of::robot, i, quoted(robot.name) + " is outside of the hall"};
        if (!robot.fixed && plan.clearance(robot.start.position) < robot.radius)
            return PlanFlaw{PlanFlaw::Of::robot, i, quoted(robot.name) + " starts too near to a wall or desk"};
        if (plan.place(robot.name)) return PlanFlaw{PlanFlaw::Of::robot, i, quoted(robot.name) + " is also the name of a place"};
        for (std::size_t j = 0; j < i; ++j) {
            if (plan.robots[j].name == robot.name)
                return PlanFlaw{PlanFlaw::Of::robot, i, "duplicate robot name " + quoted(robot.name)};
            if (!robot.fixed && !plan.robots[j].fixed &&
                distance(plan.robots[j].start.position, robot.start.position) < plan.robots[j].radius + robot.radius)
                return PlanFlaw{PlanFlaw::Of::robot, i,
                                quoted(robot.name) + " touches " + quoted(plan.robots[j].name) + " at the start"};
        }
    }
    return std::nullopt;
}

}  // namespace

Place const* FloorPlan::place(std::string_view name_of_place) const {
    auto found = std::ranges::find(places, name_of_place, &Place::name);
    return found == places.end() ? nullptr : &*found;
}

Place const& FloorPlan::exit() const {
    auto const* const found = place("exit");
    return found != nullptr ? *found : *place("entrance");
}

Metres FloorPlan::clearance(Point const& p) const {
    Metres nearest = inside_margin(bounds, p);
    for (Segment const& wall : walls) nearest = std::min(nearest, distance(wall, p));
    for (Box const& desk : desks) nearest = std::min(nearest, distance(desk, p));
    return nearest;
}

bool FloorPlan::in_sight(Point const& from, Point const& to) const {
    return std::ranges::none_of(walls, [&](Segment const& wall) { return cross(wall, Segment{from, to}); });
}

bool FloorPlan::can_go_straight(Point const& from, Point const& to, Metres radius) const {
    Metres const length = distance(from, to);
    Point const along = length > 0 ? Point{(to - from) / length} : Point::Zero();
    for (Metres gone = 0;;) {
        Metres const free = clearance(from + gone * along) - radius;
        if (free < 0) return false;
        if (gone >= length) return true;
        gone = std::min(length, gone + std::max(free, 0.01));  // no wall is nearer than `free`, so this step skips none
    }
}

bool collides(FloorPlan const& plan, Disc const& body, Point const& to, std::span<Disc const> others, Metres gap) {
    Metres const clearance = plan.clearance(to);
    if (clearance < body.radius && clearance < plan.clearance(body.centre)) return true;
    return std::ranges::any_of(others, [&](Disc const& other) {
        Metres const apart = distance(to, other.centre);
        return apart < body.radius + other.radius + gap && apart < distance(body.centre, other.centre);
    });
}

std::vector<std::string> robot_names(FloorPlan const& plan) {
    std::vector<std::string> names;
    names.reserve(plan.robots.size());
    for (RobotPlan const& robot : plan.robots) names.push_back(robot.name);
    return names;
}

std::vector<std::string> component_refs(FloorPlan const& plan, std::vector<std::string> const& components) {
    std::vector<std::string> refs;
    for (RobotPlan const& robot : plan.robots) {
        bool const is_plain = &robot == &plan.robots.front() && !plan.prefix_first;
        auto const add = [&](std::string_view name) { refs.push_back(basic::component_ref(name, is_plain ? "" : robot.name)); };
        for (auto const& basic : basic::basic_components())
            if (!basic.acts || !robot.fixed) add(basic.ref);
        if (!robot.fixed) std::ranges::for_each(components, add);
    }
    return refs;
}

std::optional<PlanFlaw> flaw(FloorPlan const& plan) {
    Point const size = plan.bounds.high - plan.bounds.low;
    if (size.minCoeff() < 1 || size.maxCoeff() > 200)
        return PlanFlaw{PlanFlaw::Of::plan, 0, "the sides of the hall must be 1 to 200 m long"};
    if (auto found = flaw_of_places(plan)) return found;
    if (auto found = flaw_of_frames(plan)) return found;
    return flaw_of_robots(plan);
}

}  // namespace rois::simulation
