// The hall as it is built: what never moves, and the robots that live in it. Plain values; read from a file by
// floor_plan_file.hpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/geometry.hpp"
#include "simulation/routing.hpp"

namespace rois::simulation {

// A position with a name, and how one stands there; around it, the area that conditions mean by the name.
struct Place {
    std::string name;
    Pose pose;
    Metres width = 2.0;  // along x
    Metres depth = 2.0;  // along y
};

// What a robot's sensors can do. Ranges in metres; a field of view is the whole angle, centred on the heading; sigmas are
// standard deviations of gaussian noise, independent for each axis. A heading noise is in radians.
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
        Radians turned_within = from_degrees(50);  // a face counts when it looks at the robot within this angle to either side
        Metres sigma = 0.03;
        Radians heading_sigma = from_degrees(5);
    } faces;
    struct Identification {
        Metres range = 3.0;
        Radians field_of_view = from_degrees(100);
        Radians turned_within = from_degrees(50);
    } identification;
    struct Sound {
        Metres range = 8.0;  // a wall between halves it
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
    Pose origin;  // in the hall, as the robot has it: in truth
    // How certain those who change between the frames are of that: standard deviations.
    Metres sigma = 0;
    Radians heading_sigma = 0;
};

// A robot with differential drive, round.
struct RobotPlan {
    std::string name;
    Pose start;
    Metres radius = 0.28;
    MetresPerSecond max_speed = 0.9;
    double max_acceleration = 0.8;  // m/s^2, also when it slows down on its way
    RadiansPerSecond max_turn_rate = 1.6;
    double max_turn_acceleration = 3.0;  // rad/s^2
    Sensors sensors;
    std::optional<RobotFrame> frame;  // in which its components tell and take positions; absent: the hall's

    // Within this time of the world's, brakes bring the robot to a stand, however fast it was.
    static constexpr Seconds time_to_stop = 0.3;

    Agility agility() const { return {max_speed, max_acceleration, max_turn_rate, max_turn_acceleration}; }
};

struct FloorPlan {
    std::string name;
    std::string crs = "urn:x-rois:def:crs:simulation::hall";
    Box bounds{Point{0, 0}, Point{20, 12}};  // its edges are walls
    std::vector<Segment> walls;              // inner ones; nothing is seen or heard clearly through them
    std::vector<Box> desks;                  // nobody walks through, everybody sees over
    std::vector<Place> places;               // "entrance" and "exit" are where people come in and go out
    std::vector<RobotPlan> robots;

    // Null when there is none of that name.
    Place const* place(std::string_view name_of_place) const;

    // Where people go out: "exit", or the entrance.
    Place const& exit() const;

    // Distance to the nearest wall, desk or edge; negative outside of the hall and 0 within a desk.
    Metres clearance(Point const&) const;

    // No wall between the two.
    bool in_sight(Point const& from, Point const& to) const;

    // A disc of this radius can go straight from one to the other without touching a wall, desk or edge.
    bool can_go_straight(Point const& from, Point const& to, Metres radius) const;
};

// What makes a plan unusable (no entrance, a place within a wall, two of one name, ...); nothing when it is fine.
struct PlanFlaw {
    enum class Of : std::uint8_t { plan, place, robot } of = Of::plan;
    std::size_t index = 0;  // of the place or robot
    std::string reason;
};
std::optional<PlanFlaw> flaw(FloorPlan const&);

}  // namespace rois::simulation
