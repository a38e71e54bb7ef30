#include "simulation/robot/robot_body.hpp"

#include <algorithm>
#include <utility>

#include "basic/components/reaction_types.hpp"
#include "simulation/robot/senses.hpp"
#include "simulation/robot/top_view.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {
namespace {

// Standard deviations of the robot's own position.
constexpr Metres own_sigma = 0.01;
constexpr Radians own_heading_sigma = from_degrees(0.5);

// Separates the random numbers of the own position from those of the sensors.
constexpr std::uint64_t own_position = 0x6f776e;

// Returns the gesture that others see; empty if they see none.
std::string_view gesture_in(Happening const& happening) {
    if (happening.kind == Happening::Kind::gesture_made) return happening.text;
    return happening.kind == Happening::Kind::reaction_shown ? basic::gesture_of(happening.text) : std::string_view{};
}

}  // namespace

RobotBody::RobotBody(std::shared_ptr<Simulation> simulation, RobotId robot)
    : simulation_{std::move(simulation)},
      robot_{robot},
      plan_{hall().plan().robots.at(static_cast<std::size_t>(robot))},
      camera_{std::make_shared<Camera>(hall())} {
    for (Place const& place : hall().plan().places) places_.push_back({place.name, reported(place.pose)});
}

Pose RobotBody::reported(Pose const& pose) const {
    if (!plan_.frame) return pose;
    auto const& origin = plan_.frame->origin;
    return {frame(origin).inverse() * pose.position, wrapped(pose.heading - origin.heading)};
}

Covariance RobotBody::reported(Covariance const& covariance) const {
    if (!plan_.frame) return covariance;
    Covariance turn = Covariance::Identity();
    turn.topLeftCorner<2, 2>() = frame(plan_.frame->origin).inverse().linear();
    return turn * covariance * turn.transpose();
}

basic::Sighting RobotBody::reported(basic::Sighting sighting) const {
    sighting.pose = reported(sighting.pose);
    sighting.covariance = reported(sighting.covariance);
    return sighting;
}

Target RobotBody::in_hall(Target target) const {
    if (!plan_.frame) return target;
    auto const& origin = plan_.frame->origin;
    target.position = frame(origin) * target.position;
    if (target.heading) target.heading = wrapped(*target.heading + origin.heading);
    return target;
}

// Returns the same for all calls within a step.
basic::PoseEstimate RobotBody::measured_pose() const {
    auto const step = static_cast<std::uint64_t>(hall().now() / Hall::step_length);
    Random random{mixed({hall().seed(), step, static_cast<std::uint64_t>(robot_), own_position})};
    Pose const& pose = state().pose;
    Point const error{random.gaussian() * own_sigma, random.gaussian() * own_sigma};
    Pose const measured{pose.position + error, wrapped(pose.heading + random.gaussian() * own_heading_sigma)};
    Covariance const covariance =
        Eigen::Vector3d{own_sigma * own_sigma, own_sigma * own_sigma, own_heading_sigma * own_heading_sigma}.asDiagonal();
    return {reported(measured), reported(covariance)};
}

std::variant<basic::MotionId, basic::Rejection> RobotBody::begin(std::string_view owner, basic::Motion motion) {
    if (auto* const way = std::get_if<GoTo>(&motion)) {
        for (auto& target : way->targets) target = in_hall(target);
        auto const is_impossible = [&](Target const& target) { return hall().plan().clearance(target.position) <= 0; };
        auto const impossible = std::ranges::find_if(way->targets, is_impossible);
        if (impossible != way->targets.end()) {
            drive().reject_target();
            return basic::Rejection{.reason = "is outside of the hall, in a wall or in furniture",
                                    .target = static_cast<std::size_t>(impossible - way->targets.begin())};
        }
    }
    if (auto const id = drive().begin(owner, std::move(motion))) return *id;
    return basic::Rejection{CompletedStatus::out_of_resources, "the wheels are busy with " + std::string{drive().owner()}};
}

// While no world time passes, the robot does not move.
basic::BaseStatus RobotBody::status() const {
    auto const current = drive().current();
    bool const time_passes = simulation_->runs_by_itself() || simulation_->goes_on();
    return {.motion = current ? std::optional{current->state} : std::nullopt,
            .last_outcome = drive().last_outcome(),
            .brakes = drive().brakes_are_on(),
            .stands = drive().stands(),
            .stopping = drive().is_stopping() && time_passes};
}

std::optional<std::string> RobotBody::speaking() const {
    auto const& speech = state().speaking;
    return speech ? std::optional{speech->character} : std::nullopt;
}

std::vector<basic::Sighting> RobotBody::sightings(basic::Sense sense) const {
    auto all = sense == basic::Sense::people  ? people_seen(hall(), robot_)
               : sense == basic::Sense::faces ? faces_seen(hall(), robot_)
                                              : sounds_heard(hall(), robot_);
    for (auto& each : all) each = reported(std::move(each));
    return all;
}

Metres RobotBody::sigma(basic::Sense sense) const {
    auto const& sensors = plan_.sensors;
    return sense == basic::Sense::people  ? sensors.people.sigma
           : sense == basic::Sense::faces ? sensors.faces.sigma
                                          : sensors.sound.sigma;
}

std::vector<basic::RecognizedPerson> RobotBody::recognized() const { return people_recognized(hall(), robot_); }

std::optional<basic::EntityId> RobotBody::find(std::string_view ref, std::string_view codebook) const {
    auto const found = hall().find(ref, codebook);
    return found && hall().pose_of(*found) ? std::optional{entity_id(*found)} : std::nullopt;
}

std::vector<basic::SpeechEvent> RobotBody::speech_since(std::uint64_t sequence) const {
    using Kind = basic::SpeechEvent::Kind;
    std::vector<basic::SpeechEvent> events;
    for (Happening const& happening : hall().chronicle().since(sequence)) {
        bool const begins = happening.kind == Happening::Kind::speech_started;
        bool const finishes = happening.kind == Happening::Kind::speech_finished;
        bool const breaks_off = happening.kind == Happening::Kind::speech_broken || happening.kind == Happening::Kind::left;
        if (happening.who == Entity{robot_} || !(begins || finishes || breaks_off)) continue;
        bool const is_heard = !breaks_off && hears(hall(), robot_, happening.place);
        if (begins && !is_heard) continue;
        basic::SpeechEvent event{.sequence = happening.sequence,
                                 .kind = begins     ? Kind::began
                                         : is_heard ? Kind::ended
                                                    : Kind::lost,
                                 .speaker = entity_id(happening.who),
                                 .place = reported(Pose{happening.place, 0}).position};
        if (begins) {
            auto const sounds = sightings(basic::Sense::sounds);
            auto const source = std::ranges::find(sounds, event.speaker, &basic::Sighting::who);
            if (source != sounds.end()) event.source = *source;
        } else if (is_heard) {
            event.text = happening.text;
            event.language = happening.language;
        }
        events.push_back(std::move(event));
    }
    return events;
}

std::vector<std::string> RobotBody::gestures_since(std::uint64_t sequence) const {
    std::vector<std::string> gestures;
    for (Happening const& happening : hall().chronicle().since(sequence)) {
        auto const gesture = gesture_in(happening);
        if (happening.who == Entity{robot_} || gesture.empty() || !sees_gesture(hall(), robot_, happening.place)) continue;
        gestures.emplace_back(gesture);
    }
    return gestures;
}

}  // namespace rois::simulation
