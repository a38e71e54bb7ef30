// The mind of a person: plays a role, minds the robots, and answers them.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "simulation/chronicle.hpp"
#include "simulation/robot.hpp"
#include "simulation/scenario.hpp"
#include "simulation/walker.hpp"

namespace rois::simulation {

// What a visitor finds around them in a step.
struct Company {
    FloorPlan const& plan;
    Planner const& planner;  // for bodies of person_radius
    std::span<Robot const> robots;
    std::vector<Disc> others;  // robots with the floor they need to stop on, and the other people
    Chronicle& chronicle;
    WorldTime now;
    Seconds dt;
};

class Visitor {
public:
    // Comes in at `pose`; `seed` is this visitor's own.
    Visitor(PersonId, Role, Pose const& pose, WorldTime now, FloorPlan const&, Planner const&, std::uint64_t seed);
    virtual ~Visitor() = default;
    Visitor(Visitor const&) = delete;
    Visitor& operator=(Visitor const&) = delete;

    Person const& person() const { return person_; }
    std::string const& role_id() const { return role_.id; }
    bool gone() const { return gone_; }

    // A robot's speech that ended, or a reaction that it shows; minded when it is near and the visitor looks at it.
    void notice(Happening const&, Robot const&, double loudness, Company const&);

    void step(Company&);

protected:
    // What they do in a step, as their own mind has it.
    virtual void play(Company&);

    Role const& role() const { return role_; }
    void say(std::string text, std::string language, Company&);
    void make_gesture(std::string id, Company&);
    // A step on the way there, or beside it when somebody stands there. `waiting` also when there is no room.
    Walker::Step go(Whereabouts const&, Company&);
    // Goes nowhere, and is turned like this as long as no robot attends to them.
    void stand(std::optional<Radians> heading);
    void go_out() { gone_ = true; }

private:
    static constexpr Seconds usual_patience = 15;
    enum class Doing : std::uint8_t { still, done };
    static constexpr std::size_t most_pending = 8;
    struct Pending {
        std::size_t answer;  // its place in the role
        WorldTime due;
    };

    Doing act(Walk const&, Company&);
    Doing act(Face const&, Company&);
    Doing act(Ignore const&, Company&);
    Doing act(Say const&, Company&);
    Doing act(Gesture const&, Company&);
    Doing act(Wait const&, Company&);
    Doing act(Wander const&, Company&);
    Doing act(Leave const&, Company&);

    void next_action(WorldTime now);
    void end_speech_and_gesture(Company&);
    bool is_open(std::size_t answer) const;  // not used up by `once`
    void answer(Company&);
    void turn(Company const&);
    void mind_robots(Company const&);
    Robot const* attended_robot(Company const&) const;
    bool robot_speaks_nearby(Company const&) const;
    bool stays_for_robot(Company const&);
    std::optional<Point> whereabouts(Whereabouts const&, Company const&) const;
    std::optional<Point> standing_place(Whereabouts const&, Company const&);
    Point somewhere(Company const&);
    Walker::Step walk(Company&);

    Person person_;
    Role role_;
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
    std::deque<Pending> pending_;         // answers to give, one after the other
    std::vector<std::size_t> answered_;   // those of `once` that were given
    Seconds still_to_wait_ = 0;           // of a Wait, of a pause in wandering, or for others to end their speech
    bool said_ = false;                   // the words or the gesture of this action were begun
    std::optional<RobotId> approaching_;  // a robot that comes up to this visitor
    std::optional<RobotId> talks_with_;   // a robot nearby that has turned to this visitor, or spoken to them lately
    WorldTime addressed_{-1'000'000};     // when a robot last spoke or showed something to them
    Seconds patience_ = usual_patience;   // left for robots; comes back when none attends to the visitor, or one talks to them
    int talks_left_ = 8;                  // how often talking brings patience back in a visit
};

}  // namespace rois::simulation
