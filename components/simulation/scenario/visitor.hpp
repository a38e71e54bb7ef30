// The behaviour of a person: plays a role, pays attention to robots and answers them.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "simulation/robot/robot.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/scenario/walker.hpp"
#include "simulation/world/chronicle.hpp"
#include "simulation/world/voice.hpp"

namespace rois::simulation {

// The world around one visitor in one step.
struct VisitorSurroundings {
    FloorPlan const& plan;
    Planner const& planner;  // for bodies of person_radius
    std::span<Robot const> robots;
    std::vector<Disc> obstacles;  // the other people, and the robots with the floor that they need to stop
    Chronicle& chronicle;
    WorldTime now;
    Seconds dt;
};

class Visitor {
public:
    // Enters at `pose`. `seed` seeds the visitor's own random numbers.
    Visitor(PersonId, Role, Pose const& pose, WorldTime now, FloorPlan const&, Planner const&, std::uint64_t seed);
    virtual ~Visitor() = default;
    Visitor(Visitor const&) = delete;
    Visitor& operator=(Visitor const&) = delete;

    Person const& person() const { return person_; }
    std::string const& role_id() const { return role_.id; }
    bool gone() const { return gone_; }

    // Notifies the visitor of a robot's completed speech or its reaction. Ignored unless the robot is near and the visitor looks
    // at it.
    void notice(Happening const&, Robot const&, double loudness, VisitorSurroundings const&);

    void step(VisitorSurroundings&);

protected:
    // Performs one step of the visitor's own actions.
    virtual void play(VisitorSurroundings&);

    Role const& role() const { return role_; }
    void say(std::string text, std::string language, VisitorSurroundings&);
    void make_gesture(std::string id, VisitorSurroundings&);
    // Walks one step towards a target, or beside it if it is occupied. Also returns `waiting` if there is no room.
    Walker::Step go(Whereabouts const&, VisitorSurroundings&);
    // Stops walking, and turns to `heading` while no robot attends to the visitor.
    void stand(std::optional<Radians> heading);
    void go_out() { gone_ = true; }

private:
    static constexpr Seconds usual_patience = 15;
    enum class Doing : std::uint8_t { still, done };
    static constexpr std::size_t most_pending = 8;
    struct Pending {
        std::size_t answer;  // index in the role
        WorldTime due;
    };

    Doing act(Walk const&, VisitorSurroundings&);
    Doing act(Face const&, VisitorSurroundings&);
    Doing act(Ignore const&, VisitorSurroundings&);
    Doing act(Say const&, VisitorSurroundings&);
    Doing act(Gesture const&, VisitorSurroundings&);
    Doing act(Wait const&, VisitorSurroundings&);
    Doing act(Wander const&, VisitorSurroundings&);
    Doing act(Leave const&, VisitorSurroundings&);

    void next_action(WorldTime now);
    void end_speech_and_gesture(VisitorSurroundings&);
    bool is_open(std::size_t answer) const;  // false if used up by `once`
    void answer(VisitorSurroundings&);
    void turn(VisitorSurroundings const&);
    void mind_robots(VisitorSurroundings const&);
    Robot const* attended_robot(VisitorSurroundings const&) const;
    bool robot_speaks_nearby(VisitorSurroundings const&) const;
    bool stays_for_robot(VisitorSurroundings const&);
    std::optional<Point> whereabouts(Whereabouts const&, VisitorSurroundings const&) const;
    std::optional<Point> standing_place(Whereabouts const&, VisitorSurroundings const&);
    Point somewhere(VisitorSurroundings const&);
    Walker::Step walk(VisitorSurroundings&);

    Person person_;
    Role role_;
    Voice voice_;
    Random random_;
    Walker walker_;
    WorldTime came_;
    std::size_t action_ = 0;
    WorldTime action_began_;
    bool action_fresh_ = true;
    bool gone_ = false;
    bool ignores_ = false;
    std::optional<Whereabouts> faces_;
    std::optional<Radians> heading_wanted_;
    std::deque<Pending> pending_;         // answers to give, in order
    std::vector<std::size_t> answered_;   // used answers with `once`
    Seconds still_to_wait_ = 0;           // in Wait, in a pause of Wander, or before Say while others speak
    bool said_ = false;                   // speech or gesture of this action has begun
    std::optional<RobotId> approaching_;  // the robot that approaches this visitor
    std::optional<RobotId> talks_with_;   // the robot nearby that faces this visitor or spoke to them recently
    WorldTime addressed_{-1'000'000};     // last speech or reaction of a robot to them
    Seconds patience_ = usual_patience;   // time left for robots; restored by their speech and while none attends
    int talks_left_ = 8;                  // how often a robot's speech can still restore patience_
};

}  // namespace rois::simulation
