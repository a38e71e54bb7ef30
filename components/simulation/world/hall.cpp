#include "simulation/world/hall.hpp"

#include <algorithm>

#include "basic/base/codebooks.hpp"
#include "simulation/world/world.hpp"
#include "types/text/texts.hpp"

namespace rois::simulation {
namespace {

std::size_t index(RobotId id) { return static_cast<std::size_t>(id); }

}  // namespace

Hall::Hall(FloorPlan plan, Scenario scenario, std::uint64_t seed)
    : world_(std::make_unique<World>(std::move(plan), std::move(scenario), seed)) {}
Hall::~Hall() = default;

WorldTime Hall::now() const { return world_->now; }

void Hall::step() { world_->step(); }

void Hall::advance(WorldTime until) {
    while (world_->now + step_length <= until) step();
}

std::uint64_t Hall::seed() const { return world_->seed; }

FloorPlan const& Hall::plan() const { return world_->plan(); }

std::span<Person const> Hall::people() const { return world_->people; }

Person const* Hall::person(PersonId id) const { return world_->person(id); }

std::span<Robot const> Hall::robots() const { return world_->robots; }

Robot const& Hall::robot(RobotId id) const { return world_->robot(id); }

std::optional<RobotId> Hall::find_robot(std::string_view name) const {
    auto found = std::ranges::find(world_->robots, name, &Robot::name);
    return found == world_->robots.end() ? std::nullopt : std::optional{found->id};
}

Drive& Hall::drive(RobotId id) { return world_->drives.at(index(id)); }

Drive const& Hall::drive(RobotId id) const { return world_->drives.at(index(id)); }

Chronicle const& Hall::chronicle() const { return world_->chronicle; }

std::optional<std::string> Hall::track(PersonId id) const { return world_->tracks.name(id); }

std::optional<Entity> Hall::find(std::string_view ref) const { return find(ref, {}); }

std::optional<Entity> Hall::find(std::string_view ref, std::string_view codebook) const {
    auto const is_from = [&](std::string_view names) {
        return codebook.empty() || equal_ignoring_case(codebook, basic::codebook::entity) || equal_ignoring_case(codebook, names);
    };
    if (auto robot = find_robot(ref); robot && is_from(basic::codebook::robot)) return *robot;
    if (auto person = world_->tracks.find(ref); person && is_from(basic::codebook::track)) return *person;
    if (!is_from(basic::codebook::visitor)) return std::nullopt;
    for (Person const& person : people()) {
        if (person.known && person.role == ref && world_->tracks.identified(person.id)) return person.id;
    }
    return std::nullopt;
}

bool Hall::knows(std::string_view ref) const { return find_robot(ref) || world_->tracks.was_given(ref) || world_->is_known(ref); }

std::optional<Pose> Hall::pose_of(Entity entity) const { return world_->pose_of(entity); }

std::optional<Target> Hall::target(std::string_view text) const {
    if (auto target = basic::target_from_wire(text)) return target;
    Place const* place = plan().place(text);
    return place ? std::optional{Target{place->pose.position, place->pose.heading}} : std::nullopt;
}

UtteranceId Hall::speak(RobotId id, Utterance utterance) {
    Robot& robot = world_->robot(id);
    UtteranceId const said = world_->voices[index(id)].speak(std::move(utterance), now(), robot.pose.position, world_->chronicle);
    robot.speaking = world_->voices[index(id)].speech();
    return said;
}

SpeechState Hall::speech_state(RobotId id, UtteranceId utterance) const { return world_->voices.at(index(id)).state(utterance); }

void Hall::break_off(RobotId id, UtteranceId utterance) {
    Robot& robot = world_->robot(id);
    world_->voices[index(id)].break_off(utterance, now(), robot.pose.position, world_->chronicle);
    robot.speaking = world_->voices[index(id)].speech();
}

void Hall::hold_speech(RobotId id, UtteranceId utterance) {
    world_->voices.at(index(id)).hold(utterance, now());
    world_->robot(id).speaking = world_->voices[index(id)].speech();
}

void Hall::go_on_speaking(RobotId id, UtteranceId utterance) {
    world_->voices.at(index(id)).go_on(utterance, now());
    world_->robot(id).speaking = world_->voices[index(id)].speech();
}

void Hall::show(RobotId id, std::string reaction, Seconds duration) {
    Robot& robot = world_->robot(id);
    world_->chronicle.add({0, now(), Happening::Kind::reaction_shown, id, robot.pose.position, reaction, {}, 0, {}});
    robot.showing = Showing{std::move(reaction), now() + world_time(duration)};
}

void Hall::stop_showing(RobotId id) { world_->robot(id).showing.reset(); }

SharedOrderStatus Hall::let_in(Role role) { return world_->let_in(std::move(role)); }

SharedOrderStatus Hall::steer(std::string_view visitor, Order order) {
    if (auto* const steered = world_->steered(visitor)) return steered->obey(std::move(order));
    auto status = std::make_shared<OrderStatus>();
    status->fail(world_->is_inside(visitor) ? std::string{visitor} + " belongs to the scenario and cannot be steered"
                                            : "visitor " + std::string{visitor} + " is not in the hall");
    return status;
}

void Hall::stop_steering() { world_->stop_steering(); }

}  // namespace rois::simulation
