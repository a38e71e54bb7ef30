// What a visitor does in each kind of action, a step at a time.
#include <algorithm>
#include <cmath>

#include "simulation/visitor.hpp"

namespace rois::simulation {
namespace {

constexpr Seconds longest_walk = 60;
constexpr Seconds longest_turn = 2;
constexpr RadiansPerSecond turn_rate = 3.5;
constexpr Metres in_conversation = 1.8;
constexpr WorldTime conversation_lasts{8'000};

}  // namespace

std::optional<Point> Visitor::whereabouts(Whereabouts const& where, Company const& company) const {
    if (auto const* point = std::get_if<Point>(&where.at)) return *point;
    auto const& name = std::get<std::string>(where.at);
    if (Place const* place = company.plan.place(name)) return place->pose.position;
    auto robot = std::ranges::find(company.robots, name, &Robot::name);
    return robot == company.robots.end() ? std::nullopt : std::optional{robot->pose.position};
}

// A place that somebody stands at is shared; before a robot one stands in front of it.
std::optional<Point> Visitor::standing_place(Whereabouts const& where, Company const& company) {
    auto wanted = whereabouts(where, company);
    if (!wanted) return std::nullopt;
    auto const* name = std::get_if<std::string>(&where.at);
    auto const robot = name ? std::ranges::find(company.robots, *name, &Robot::name) : company.robots.end();
    if (robot != company.robots.end()) {
        return company.planner.beside(*wanted, 1.2, *wanted + unit(robot->pose.heading), company.others);
    }
    if (company.planner.fits(*wanted, company.others)) return wanted;
    return company.planner.beside(*wanted, 0.8, person_.pose.position, company.others);
}

Walker::Step Visitor::walk(Company& company) { return walker_.step(person_, role_.speed, company.others, random_, company.dt); }

Walker::Step Visitor::go(Whereabouts const& where, Company& company) {
    if (!walker_.has_goal()) {
        auto const goal = standing_place(where, company);
        if (!goal) return Walker::Step::waiting;
        walker_.go(*goal);
    }
    auto const step = walk(company);
    // Somebody else may have taken the place.
    if (step == Walker::Step::waiting && distance(person_.pose.position, *walker_.goal()) < 1.2) walker_.stop();
    return step;
}

void Visitor::stand(std::optional<Radians> heading) {
    walker_.stop();
    heading_wanted_ = heading;
}

Visitor::Doing Visitor::act(Walk const& walk_to, Company& company) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
    }
    if (in_seconds(company.now - action_began_) > longest_walk) return Doing::done;
    if (stays_for_robot(company)) return Doing::still;
    auto const step = go(walk_to.to, company);
    if (step == Walker::Step::walking || step == Walker::Step::waiting) return Doing::still;
    if (step == Walker::Step::no_way) return Doing::done;
    auto const* name = std::get_if<std::string>(&walk_to.to.at);
    Place const* place = name ? company.plan.place(*name) : nullptr;
    if (place) heading_wanted_ = place->pose.heading;
    return Doing::done;
}

Visitor::Doing Visitor::act(Face const& face, Company& company) {
    if (action_fresh_) {
        faces_ = face.whom;
        ignores_ = false;
    }
    auto const whom = whereabouts(face.whom, company);
    bool const turned = whom && std::abs(bearing(person_.pose, *whom)) < from_degrees(5);
    return turned || in_seconds(company.now - action_began_) > longest_turn ? Doing::done : Doing::still;
}

Visitor::Doing Visitor::act(Ignore const&, Company&) {
    ignores_ = true;
    faces_.reset();
    return Doing::done;
}

Visitor::Doing Visitor::act(Say const& words, Company& company) {
    if (action_fresh_) {
        still_to_wait_ = 10;  // for the others to end
        said_ = false;
    }
    if (said_) return person_.speaking ? Doing::still : Doing::done;
    still_to_wait_ -= company.dt;
    if (person_.speaking || (still_to_wait_ > 0 && robot_speaks_nearby(company))) return Doing::still;
    say(words.text, words.language, company);
    said_ = true;
    return Doing::still;
}

Visitor::Doing Visitor::act(Gesture const& gesture, Company& company) {
    if (action_fresh_) said_ = false;
    if (said_) return person_.gesturing ? Doing::still : Doing::done;
    if (person_.gesturing) return Doing::still;
    make_gesture(gesture.id, company);
    said_ = true;
    return Doing::still;
}

Visitor::Doing Visitor::act(Wait const& wait, Company& company) {
    if (action_fresh_) {
        still_to_wait_ = wait.duration;
    }
    still_to_wait_ -= company.dt;
    if (still_to_wait_ > 0) return Doing::still;
    return !pending_.empty() || person_.speaking || stays_for_robot(company) ? Doing::still : Doing::done;
}

Visitor::Doing Visitor::act(Wander const& wander, Company& company) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
        still_to_wait_ = 0;
    }
    if (stays_for_robot(company)) return Doing::still;
    if (in_seconds(company.now - action_began_) > wander.duration) return Doing::done;
    still_to_wait_ -= company.dt;
    if (still_to_wait_ > 0) return Doing::still;
    if (!walker_.has_goal()) walker_.go(somewhere(company));
    Walker::Step const step = walk(company);
    if (step == Walker::Step::arrived || step == Walker::Step::no_way) {
        walker_.stop();
        still_to_wait_ = random_.uniform(2, 5);
    }
    return Doing::still;
}

Visitor::Doing Visitor::act(Leave const&, Company& company) {
    if (action_fresh_) {
        faces_.reset();
        heading_wanted_.reset();
    }
    if (!pending_.empty() || person_.speaking || stays_for_robot(company)) return Doing::still;
    Point const exit = company.plan.exit().pose.position;
    if (distance(person_.pose.position, exit) < 0.5) return Doing::done;
    walker_.go(exit);
    walk(company);
    return Doing::still;
}

Point Visitor::somewhere(Company const& company) {
    for (int tries = 0; tries < 20; ++tries) {
        Box const& bounds = company.plan.bounds;
        Point const p{random_.uniform(bounds.low.x(), bounds.high.x()), random_.uniform(bounds.low.y(), bounds.high.y())};
        if (company.planner.fits(p, company.others) && company.plan.clearance(p) > 0.6) return p;
    }
    return person_.pose.position;
}

// Which robot comes up to this visitor, and which one attends to them.
void Visitor::mind_robots(Company const& company) {
    approaching_.reset();
    talks_with_.reset();
    if (ignores_) return;
    Point const here = person_.pose.position;
    for (Robot const& robot : company.robots) {
        Metres const apart = distance(here, robot.pose.position);
        if (apart > 3.5 || !company.plan.in_sight(here, robot.pose.position)) continue;
        Radians const aside = std::abs(bearing(robot.pose, here));
        if (robot.twist.linear > 0.1 && aside < from_degrees(20)) approaching_ = robot.id;
        bool const attends = apart < in_conversation && aside < from_degrees(30) && std::abs(robot.twist.linear) < 0.05;
        bool const talks = company.now - addressed_ < conversation_lasts || robot.speaking.has_value();
        if (attends || (talks && apart < 3)) talks_with_ = robot.id;
    }
}

// What the visitor is about is put off for a robot that comes up, attends to them or talks with them, but not for ever.
bool Visitor::stays_for_robot(Company const& company) {
    if (!approaching_ && !talks_with_) {
        patience_ = std::min(usual_patience, patience_ + company.dt / 4);
        return false;
    }
    if (patience_ <= 0) return false;
    bool const listens = talks_with_ && company.robots[static_cast<std::size_t>(*talks_with_)].speaking;
    if (!listens) patience_ -= company.dt;
    return true;
}

bool Visitor::robot_speaks_nearby(Company const& company) const {
    return std::ranges::any_of(company.robots, [&](Robot const& robot) {
        return robot.speaking && distance(robot.pose.position, person_.pose.position) < 4;
    });
}

Robot const* Visitor::attended_robot(Company const& company) const {
    auto const wanted = talks_with_ ? talks_with_ : approaching_;
    return wanted ? &company.robots[static_cast<std::size_t>(*wanted)] : nullptr;
}

void Visitor::turn(Company const& company) {
    std::optional<Radians> wanted;
    Point const here = person_.pose.position;
    if (!person_.velocity.isZero(1e-6)) {
        wanted = std::atan2(person_.velocity.y(), person_.velocity.x());
    } else if (auto const whom = faces_ ? whereabouts(*faces_, company) : std::nullopt) {
        wanted = direction(here, *whom);
    } else if (Robot const* robot = attended_robot(company)) {
        wanted = direction(here, robot->pose.position);
    } else {
        wanted = heading_wanted_;
    }
    if (!wanted) return;
    Radians const left = wrapped(*wanted - person_.pose.heading);
    person_.pose.heading = wrapped(person_.pose.heading + std::clamp(left, -turn_rate * company.dt, turn_rate * company.dt));
}

}  // namespace rois::simulation
