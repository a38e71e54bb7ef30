// One step of each kind of a visitor's actions.
#include <algorithm>
#include <cmath>

#include "simulation/scenario/visitor.hpp"
#include "simulation/world/visibility.hpp"

namespace rois::simulation {
namespace {

constexpr Seconds longest_walk = 60;
constexpr Seconds longest_turn = 2;
constexpr RadiansPerSecond turn_rate = 3.5;
constexpr Metres in_conversation = 1.8;
constexpr Metres nearby = 4;  // a visitor does not interrupt a robot within this hearing range
constexpr WorldTime conversation_lasts{8'000};

}  // namespace

std::optional<Point> Visitor::whereabouts(Whereabouts const& where, VisitorSurroundings const& around) const {
    if (auto const* point = std::get_if<Point>(&where.at)) return *point;
    auto const& name = std::get<std::string>(where.at);
    if (Place const* place = around.plan.place(name)) return place->pose.position;
    auto robot = std::ranges::find(around.robots, name, &Robot::name);
    return robot == around.robots.end() ? std::nullopt : std::optional{robot->pose.position};
}

// Returns a point in front of the robot, or the place itself; if the place is occupied, a point beside its occupant.
std::optional<Point> Visitor::standing_place(Whereabouts const& where, VisitorSurroundings const& around) {
    auto wanted = whereabouts(where, around);
    if (!wanted) return std::nullopt;
    auto const* name = std::get_if<std::string>(&where.at);
    auto const robot = name ? std::ranges::find(around.robots, *name, &Robot::name) : around.robots.end();
    if (robot != around.robots.end()) {
        return around.planner.beside(*wanted, 1.2, *wanted + unit(robot->pose.heading), around.obstacles);
    }
    if (around.planner.fits(*wanted, around.obstacles)) return wanted;
    return around.planner.beside(*wanted, 0.8, person_.pose.position, around.obstacles);
}

Walker::Step Visitor::walk(VisitorSurroundings& around) {
    return walker_.step(person_, role_.speed, around.obstacles, random_, around.dt);
}

Walker::Step Visitor::go(Whereabouts const& where, VisitorSurroundings& around) {
    if (!walker_.has_goal()) {
        auto const goal = standing_place(where, around);
        if (!goal) return Walker::Step::waiting;
        walker_.go(*goal);
    }
    auto const step = walk(around);
    // The place may be occupied by now.
    if (step == Walker::Step::waiting && distance(person_.pose.position, *walker_.goal()) < 1.2) walker_.stop();
    return step;
}

void Visitor::stand(std::optional<Radians> heading) {
    walker_.stop();
    heading_wanted_ = heading;
}

Visitor::Doing Visitor::act(Walk const& walk_to, VisitorSurroundings& around) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
    }
    if (in_seconds(around.now - action_began_) > longest_walk) return Doing::done;
    if (stays_for_robot(around)) return Doing::still;
    auto const step = go(walk_to.to, around);
    if (step == Walker::Step::walking || step == Walker::Step::waiting) return Doing::still;
    if (step == Walker::Step::no_way) return Doing::done;
    auto const* name = std::get_if<std::string>(&walk_to.to.at);
    Place const* place = name ? around.plan.place(*name) : nullptr;
    if (place) heading_wanted_ = place->pose.heading;
    return Doing::done;
}

Visitor::Doing Visitor::act(Face const& face, VisitorSurroundings& around) {
    if (action_fresh_) {
        faces_ = face.whom;
        ignores_ = false;
    }
    auto const whom = whereabouts(face.whom, around);
    bool const turned = whom && std::abs(bearing(person_.pose, *whom)) < from_degrees(5);
    return turned || in_seconds(around.now - action_began_) > longest_turn ? Doing::done : Doing::still;
}

Visitor::Doing Visitor::act(Ignore const&, VisitorSurroundings&) {
    ignores_ = true;
    faces_.reset();
    return Doing::done;
}

Visitor::Doing Visitor::act(Say const& words, VisitorSurroundings& around) {
    if (action_fresh_) {
        still_to_wait_ = 10;  // seconds to wait for other speech to end
        said_ = false;
    }
    if (said_) return person_.speaking ? Doing::still : Doing::done;
    still_to_wait_ -= around.dt;
    if (person_.speaking || (still_to_wait_ > 0 && robot_speaks_nearby(around))) return Doing::still;
    say(words.text, words.language, around);
    said_ = true;
    return Doing::still;
}

Visitor::Doing Visitor::act(Gesture const& gesture, VisitorSurroundings& around) {
    if (action_fresh_) said_ = false;
    if (said_) return person_.gesturing ? Doing::still : Doing::done;
    if (person_.gesturing) return Doing::still;
    make_gesture(gesture.id, around);
    said_ = true;
    return Doing::still;
}

Visitor::Doing Visitor::act(Wait const& wait, VisitorSurroundings& around) {
    if (action_fresh_) {
        still_to_wait_ = wait.duration;
    }
    still_to_wait_ -= around.dt;
    if (still_to_wait_ > 0) return Doing::still;
    return !pending_.empty() || person_.speaking || stays_for_robot(around) ? Doing::still : Doing::done;
}

Visitor::Doing Visitor::act(Wander const& wander, VisitorSurroundings& around) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
        still_to_wait_ = 0;
    }
    if (stays_for_robot(around)) return Doing::still;
    if (in_seconds(around.now - action_began_) > wander.duration) return Doing::done;
    still_to_wait_ -= around.dt;
    if (still_to_wait_ > 0) return Doing::still;
    if (!walker_.has_goal()) walker_.go(somewhere(around));
    Walker::Step const step = walk(around);
    if (step == Walker::Step::arrived || step == Walker::Step::no_way) {
        walker_.stop();
        still_to_wait_ = random_.uniform(2, 5);
    }
    return Doing::still;
}

Visitor::Doing Visitor::act(Leave const&, VisitorSurroundings& around) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
    }
    if (!pending_.empty() || person_.speaking || stays_for_robot(around)) return Doing::still;
    Point const exit = around.plan.exit().pose.position;
    if (distance(person_.pose.position, exit) < 0.5) return Doing::done;
    walker_.go(exit);
    walk(around);
    return Doing::still;
}

Point Visitor::somewhere(VisitorSurroundings const& around) {
    for (int tries = 0; tries < 20; ++tries) {
        Box const& bounds = around.plan.bounds;
        Point const p{random_.uniform(bounds.low.x(), bounds.high.x()), random_.uniform(bounds.low.y(), bounds.high.y())};
        if (around.planner.fits(p, around.obstacles) && around.plan.clearance(p) > 0.6) return p;
    }
    return person_.pose.position;
}

// Updates approaching_ and talks_with_.
void Visitor::mind_robots(VisitorSurroundings const& around) {
    approaching_.reset();
    talks_with_.reset();
    if (ignores_) return;
    Point const here = person_.pose.position;
    for (Robot const& robot : around.robots) {
        if (around.plan.robots[static_cast<std::size_t>(robot.id)].fixed) continue;
        Metres const apart = distance(here, robot.pose.position);
        if (apart > 3.5 || !around.plan.in_sight(here, robot.pose.position)) continue;
        Radians const aside = std::abs(bearing(robot.pose, here));
        if (robot.twist.linear > 0.1 && aside < from_degrees(20)) approaching_ = robot.id;
        bool const attends = apart < in_conversation && aside < from_degrees(30) && std::abs(robot.twist.linear) < 0.05;
        bool const talks = around.now - addressed_ < conversation_lasts || robot.speaking.has_value();
        if (attends || (talks && apart < 3)) talks_with_ = robot.id;
    }
}

// Whether the visitor waits for a robot that approaches, attends to or talks with them. patience_ limits the wait.
bool Visitor::stays_for_robot(VisitorSurroundings const& around) {
    if (!approaching_ && !talks_with_) {
        patience_ = std::min(usual_patience, patience_ + around.dt / 4);
        return false;
    }
    if (patience_ <= 0) return false;
    bool const listens = talks_with_ && around.robots[static_cast<std::size_t>(*talks_with_)].speaking;
    if (!listens) patience_ -= around.dt;
    return true;
}

bool Visitor::robot_speaks_nearby(VisitorSurroundings const& around) const {
    return std::ranges::any_of(around.robots, [&](Robot const& robot) {
        return robot.speaking && hears(around.plan, person_.pose.position, robot.pose.position, nearby);
    });
}

Robot const* Visitor::attended_robot(VisitorSurroundings const& around) const {
    auto const wanted = talks_with_ ? talks_with_ : approaching_;
    return wanted ? &around.robots[static_cast<std::size_t>(*wanted)] : nullptr;
}

void Visitor::turn(VisitorSurroundings const& around) {
    std::optional<Radians> wanted;
    Point const here = person_.pose.position;
    if (!person_.velocity.isZero(1e-6)) {
        wanted = std::atan2(person_.velocity.y(), person_.velocity.x());
    } else if (auto const whom = faces_ ? whereabouts(*faces_, around) : std::nullopt) {
        wanted = direction(here, *whom);
    } else if (Robot const* robot = attended_robot(around)) {
        wanted = direction(here, robot->pose.position);
    } else {
        wanted = heading_wanted_;
    }
    if (!wanted) return;
    Radians const left = wrapped(*wanted - person_.pose.heading);
    person_.pose.heading = wrapped(person_.pose.heading + std::clamp(left, -turn_rate * around.dt, turn_rate * around.dt));
}

}  // namespace rois::simulation
