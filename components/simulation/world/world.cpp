#include "simulation/world/world.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "simulation/world/visibility.hpp"

namespace rois::simulation {
namespace {

constexpr Agility on_foot{.speed = 1.1, .acceleration = 3.0, .turn_rate = 3.0, .turn_acceleration = 12.0};
constexpr Metres free_entrance = 0.15;  // gap around a person who enters
constexpr WorldTime tracking_period{100};
constexpr Metres metres_per_percent = 10;  // of a battery

FloorPlan checked(FloorPlan plan) {
    if (auto found = flaw(plan)) throw std::invalid_argument(found->reason);
    return plan;
}

std::set<std::string, std::less<>> known_roles(Scenario const& scenario) {
    std::set<std::string, std::less<>> known;
    for (Role const& role : scenario.roles)
        if (role.known) known.insert(role.id);
    return known;
}

std::string already_inside(std::string const& visitor) { return visitor + " is in the hall already"; }

bool is_for_visitors(Happening const& happening) {
    return std::holds_alternative<RobotId>(happening.who) &&
           (happening.kind == Happening::Kind::speech_finished || happening.kind == Happening::Kind::reaction_shown);
}

}  // namespace

Hall::World::World(FloorPlan plan, Scenario scenario, std::uint64_t hall_seed)
    : seed(hall_seed),
      plan_(checked(std::move(plan))),
      walkways_(plan_, person_radius, on_foot),
      known_(known_roles(scenario)),
      crowd_(std::move(scenario), plan_, mixed({hall_seed, 1})) {
    for (std::size_t i = 0; i < plan_.robots.size(); ++i) {
        RobotId const id{static_cast<std::uint32_t>(i)};
        drives.emplace_back(id, plan_.robots[i], plan_);
        voices.emplace_back(id);
        robots.push_back({id, plan_.robots[i].name, plan_.robots[i].start, {}, {}, {}, plan_.robots[i].battery});
    }
}

std::optional<Pose> Hall::World::pose_of(Entity entity) const {
    if (auto const* id = std::get_if<RobotId>(&entity)) return robots.at(static_cast<std::size_t>(*id)).pose;
    Person const* found = person(std::get<PersonId>(entity));
    return found ? std::optional{found->pose} : std::nullopt;
}

Person const* Hall::World::person(PersonId id) const {
    auto found = std::ranges::find(people, id, &Person::id);
    return found == people.end() ? nullptr : &*found;
}

Disc Hall::World::disc(Person const& who) const { return {who.pose.position, person_radius}; }

std::vector<Disc> Hall::World::others(Entity self, Room room) const {
    std::vector<Disc> discs;
    discs.reserve(people.size() + drives.size());
    for (Person const& who : people)
        if (self != Entity{who.id}) discs.push_back(disc(who));
    for (Drive const& drive : drives)
        if (self != Entity{drive.robot()} && !drive.plan().fixed)
            discs.push_back(room == Room::to_stop ? drive.stopping_disc() : drive.disc());
    return discs;
}

std::vector<Disc> Hall::World::standing_obstacles(RobotId robot) const {
    std::vector<Disc> discs;
    for (Person const& who : people) {
        if (who.velocity.isZero(1e-6)) discs.push_back(disc(who));
    }
    for (Drive const& drive : drives) {
        bool const stands = drive.twist().linear == 0;
        if (drive.robot() != robot && stands && !drive.plan().fixed) discs.push_back(drive.disc());
    }
    return discs;
}

void Hall::World::step() {
    now += Hall::step_length;
    for (Robot const& each : robots) voices[static_cast<std::size_t>(each.id)].step(now, each.pose.position, chronicle);
    admit();
    notify_visitors();
    step_visitors();
    step_robots();
    if (now % tracking_period == WorldTime{0}) track();
}

void Hall::World::admit() {
    Pose const& entrance = plan_.place("entrance")->pose;
    auto in_the_door = [&](Disc const& body) {
        return distance(body.centre, entrance.position) < person_radius + body.radius + free_entrance;
    };
    if (std::ranges::any_of(people, [&](Person const& who) { return in_the_door(disc(who)); })) return;
    auto const blocks = [&](Drive const& drive) { return !drive.plan().fixed && in_the_door(drive.stopping_disc()); };
    if (std::ranges::any_of(drives, blocks)) return;
    auto const of_the_scenario = std::ranges::count_if(people, [](Person const& who) { return !is_steered(who.id); });
    auto role = crowd_.next(now, static_cast<std::size_t>(of_the_scenario), [&](auto role_id) { return is_inside(role_id); });
    if (!role) return admit_steered(entrance);
    PersonId const id{++last_person_};
    enter(std::make_unique<Visitor>(id, std::move(*role), entrance, now, plan_, walkways_, mixed({seed, 2, last_person_})));
}

// Steered visitors enter after those of the scenario, with separate ids and random numbers, so that the scenario is unaffected.
void Hall::World::admit_steered(Pose const& entrance) {
    if (waiting_.empty()) return;
    auto [role, status] = std::move(waiting_.front());
    waiting_.pop_front();
    if (is_inside(role.id)) return status->fail(already_inside(role.id));
    PersonId const id{++last_steered_};
    enter(
        std::make_unique<SteeredVisitor>(id, std::move(role), entrance, now, plan_, walkways_, mixed({seed, 3, last_steered_})));
    status->state = OrderStatus::State::done;
}

void Hall::World::enter(std::unique_ptr<Visitor> visitor) {
    auto const& person = people.emplace_back(visitor->person());
    if (person.known) known_.insert(person.role);
    chronicle.add({0, now, Happening::Kind::entered, person.id, person.pose.position, {}, {}, 0, {}});
    visitors_.push_back(std::move(visitor));
}

bool Hall::World::is_inside(std::string_view role) const {
    return std::ranges::any_of(visitors_, [&](auto const& visitor) { return visitor->role_id() == role; });
}

SharedOrderStatus Hall::World::let_in(Role role) {
    auto status = std::make_shared<OrderStatus>();
    bool const waits = std::ranges::any_of(waiting_, [&](Waiting const& other) { return other.role.id == role.id; });
    if (waits || is_inside(role.id)) {
        status->fail(already_inside(role.id));
    } else {
        waiting_.push_back({std::move(role), status});
    }
    return status;
}

SteeredVisitor* Hall::World::steered(std::string_view ref) {
    for (auto const& visitor : visitors_) {
        auto* const found = dynamic_cast<SteeredVisitor*>(visitor.get());
        if (found != nullptr && found->role_id() == ref) return found;
    }
    return nullptr;
}

void Hall::World::stop_steering() {
    waiting_.clear();
    for (auto const& visitor : visitors_)
        if (auto* const steered = dynamic_cast<SteeredVisitor*>(visitor.get())) steered->stand_still();
}

VisitorSurroundings Hall::World::surroundings_of(PersonId self) {
    return {plan_, walkways_, robots, others(self, Room::to_stop), chronicle, now, in_seconds(Hall::step_length)};
}

// Notifies visitors of the speech and reactions of robots since the last step.
void Hall::World::notify_visitors() {
    std::vector<Happening> news;
    for (Happening const& happening : chronicle.since(reported_)) {
        if (is_for_visitors(happening)) news.push_back(happening);
    }
    reported_ = chronicle.last();
    for (Happening const& happening : news) {
        RobotId const id = std::get<RobotId>(happening.who);
        double const loudness = voices[static_cast<std::size_t>(id)].loudness();
        for (auto const& visitor : visitors_)
            visitor->notice(happening, robot(id), loudness, surroundings_of(visitor->person().id));
    }
}

// In order of arrival. Each visitor sees the new positions of earlier ones.
void Hall::World::step_visitors() {
    for (std::size_t i = 0; i < visitors_.size(); ++i) {
        VisitorSurroundings around = surroundings_of(people[i].id);
        visitors_[i]->step(around);
        people[i] = visitors_[i]->person();
    }
    for (auto const& visitor : visitors_) {
        if (!visitor->gone()) continue;
        PersonId const id = visitor->person().id;
        tracks.leave(id);
        chronicle.add({0, now, Happening::Kind::left, id, visitor->person().pose.position, {}, {}, 0, {}});
    }
    std::erase_if(visitors_, [](auto const& visitor) { return visitor->gone(); });
    people.clear();
    for (auto const& visitor : visitors_) people.push_back(visitor->person());
}

void Hall::World::step_robots() {
    for (Robot& each : robots) {
        auto const i = static_cast<std::size_t>(each.id);
        drives[i].step(*this, in_seconds(Hall::step_length));
        auto const before = std::exchange(each.pose, drives[i].pose()).position;
        if (each.battery) each.battery = std::max(1.0, *each.battery - distance(before, each.pose.position) / metres_per_percent);
        each.twist = drives[i].twist();
        each.speaking = voices[i].speech();
        if (each.showing && now >= each.showing->ends) each.showing.reset();
    }
}

void Hall::World::track() {
    for (Robot const& each : robots) {
        Sensors const& sensors = plan_.robots[static_cast<std::size_t>(each.id)].sensors;
        for (Person const& who : people) {
            bool const heard = who.speaking && hears(plan_, each.pose.position, who.pose.position, sensors.sound.range);
            bool const recognized = recognizes(plan_, sensors.identification, each.pose, who);
            if (heard || recognized || sees(plan_, sensors.people, each.pose, who) ||
                sees_face(plan_, sensors.faces, each.pose, who))
                tracks.see(who.id, now);
            if (recognized && who.known) tracks.identify(who.id);
        }
    }
    tracks.forget_lost(now);
}

}  // namespace rois::simulation
