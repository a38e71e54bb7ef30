// The fixed parts of the hall and its robots. Plain values; floor_plan_file.hpp reads them from a file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/plan/geometry.hpp"
#include "simulation/plan/routing.hpp"

namespace rois::simulation {

// A named pose, and the area around it that conditions refer to by that name.
struct Place {
    std::string name;
    Pose pose;
    Metres width = 2.0;  // along x
    Metres depth = 2.0;  // along y
};

// The abilities of a robot's sensors. A field of view is the whole angle, centred on the heading. Sigmas are standard deviations
// of gaussian noise, independent for each axis.
struct Sensors {
    struct People {
        Metres range = 10.0;
        Radians field_of_view = from_degrees(240);
        Metres sigma = 0.05;
        Radians heading_sigma = from_degrees(8);
    } people;
    struct Faces {
        Metres range = 5.0;
        Radians field_of_view = from_degrees(100);
        Radians turned_within = from_degrees(50);  // a face counts if it looks at the robot within this angle to either side
        Metres sigma = 0.03;
        Radians heading_sigma = from_degrees(5);
    } faces;
    struct Identification {
        Metres range = 3.0;
        Radians field_of_view = from_degrees(100);
        Radians turned_within = from_degrees(50);
    } identification;
    struct Sound {
        Metres range = 8.0;  // halved by a wall in between
        Metres sigma = 0.25;
    } sound;
    struct Gestures {
        Metres range = 6.0;
        Radians field_of_view = from_degrees(100);
    } gestures;
};

// The frame of a robot's own map.
struct RobotFrame {
    std::string crs;
    Pose origin;  // the true origin, in the hall's frame
    // Standard deviations of the origin, for conversions between the frames.
    Metres sigma = 0;
    Radians heading_sigma = 0;
};

// A round robot with differential drive, or sensors with a fixed place.
struct RobotPlan {
    std::string name;
    Pose start;
    bool fixed = false;  // on a wall or ceiling: has neither wheels nor a voice, and robots drive past it freely
    Metres radius = 0.28;
    MetresPerSecond max_speed = 0.9;
    double max_acceleration = 0.8;  // m/s^2, also when braking on the way
    RadiansPerSecond max_turn_rate = 1.6;
    double max_turn_acceleration = 3.0;  // rad/s^2
    std::optional<double> battery;       // charge at the start, in percent; absent: it never gets empty
    Sensors sensors;
    std::optional<RobotFrame> frame;  // the frame of its components' positions; absent: the hall's frame

    // Braking takes at most this world time from any speed.
    static constexpr Seconds time_to_stop = 0.3;

    Agility agility() const { return {max_speed, max_acceleration, max_turn_rate, max_turn_acceleration}; }
};

struct FloorPlan {
    std::string name;
    std::string crs = "urn:x-rois:def:crs:simulation::hall";
    Box bounds{Point{0, 0}, Point{20, 12}};  // its edges are walls
    std::vector<Segment> walls;              // inner walls; they block sight and halve hearing
    std::vector<Box> desks;                  // they block ways, but not sight
    std::vector<Place> places;               // people come in at "entrance" and leave at "exit"
    std::vector<RobotPlan> robots;
    bool prefix_first = false;  // also the refs of the first robot's components begin with its name

    // Returns null if the name is unknown.
    Place const* place(std::string_view name_of_place) const;

    // The place "exit", else the entrance.
    Place const& exit() const;

    // Distance to the nearest wall, desk or edge; negative outside of the hall, 0 within a desk.
    Metres clearance(Point const&) const;

    // Whether no wall is between the two points.
    bool in_sight(Point const& from, Point const& to) const;

    // Whether a disc of this radius can move straight between the points without touching a wall, desk or edge.
    bool can_go_straight(Point const& from, Point const& to, Metres radius) const;
};

// Whether a body that moves to `to` touches a wall or desk, or comes nearer than `gap` to another body. A body that is too near
// already may move past or away.
bool collides(FloorPlan const&, Disc const& body, Point const& to, std::span<Disc const> others, Metres gap = 0);

// The names of the robots, in the plan's order.
std::vector<std::string> robot_names(FloorPlan const&);

// The refs of the basic components of all robots, the streaming components included, and of the user-defined components with
// these names.
std::vector<std::string> component_refs(FloorPlan const&, std::vector<std::string> const& components = {});

// The first error of a plan (no entrance, a place within a wall, a duplicate name, ...). flaw() returns nothing if the plan is
// valid.
struct PlanFlaw {
    enum class Of : std::uint8_t { plan, place, robot } of = Of::plan;
    std::size_t index = 0;  // of the place or robot
    std::string reason;
};
std::optional<PlanFlaw> flaw(FloorPlan const&);

}  // namespace rois::simulation
