// The implementation of the Hall.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scenario/crowd.hpp"
#include "simulation/scenario/steered_visitor.hpp"
#include "simulation/scenario/visitor.hpp"
#include "simulation/world/hall.hpp"
#include "simulation/world/tracks.hpp"
#include "simulation/world/voice.hpp"

namespace rois::simulation {

class Hall::World : public Surroundings {
public:
    World(FloorPlan, Scenario, std::uint64_t seed);

    FloorPlan const& plan() const override { return plan_; }
    std::optional<Pose> pose_of(Entity) const override;
    std::vector<Disc> obstacles(RobotId robot) const override { return others(robot, Room::of_bodies); }
    std::vector<Disc> obstacles_with_stopping_room(RobotId robot) const override { return others(robot, Room::to_stop); }
    std::vector<Disc> standing_obstacles(RobotId) const override;

    void step();
    Robot& robot(RobotId id) { return robots.at(static_cast<std::size_t>(id)); }
    Person const* person(PersonId) const;

    SharedOrderStatus let_in(Role);
    SteeredVisitor* steered(std::string_view ref);  // null if no such visitor is in the hall
    void stop_steering();
    bool is_inside(std::string_view role) const;
    bool is_known(std::string_view role) const { return known_.contains(role); }  // also before the person enters

    std::uint64_t seed;
    WorldTime now{0};
    Chronicle chronicle;
    Tracks tracks{Hall::track_memory};
    std::vector<Robot> robots;
    std::vector<Drive> drives;
    std::vector<Voice> voices;
    std::vector<Person> people;  // copies of the visitors' persons after the last step

private:
    // A steered visitor who waits at the entrance.
    struct Waiting {
        Role role;
        std::shared_ptr<OrderStatus> status;
    };

    // The floor that each robot occupies: its body, or also the room that it needs to stop.
    enum class Room : std::uint8_t { of_bodies, to_stop };
    std::vector<Disc> others(Entity self, Room) const;

    void admit();
    void admit_steered(Pose const& entrance);
    void enter(std::unique_ptr<Visitor>);
    void notify_visitors();
    void step_visitors();
    void step_robots();
    void track();
    VisitorSurroundings surroundings_of(PersonId);
    Disc disc(Person const&) const;

    FloorPlan plan_;
    Planner walkways_;
    std::set<std::string, std::less<>> known_;  // roles of known people
    Crowd crowd_;
    std::vector<std::unique_ptr<Visitor>> visitors_;
    std::uint32_t last_person_ = 0;  // of the scenario and the arrivals
    std::uint32_t last_steered_ = first_steered - 1;
    std::deque<Waiting> waiting_;
    std::uint64_t reported_ = 0;  // the last sequence that visitors were notified of
};

}  // namespace rois::simulation
