#include "simulation/robot/senses.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/world/random.hpp"
#include "simulation/world/visibility.hpp"

namespace rois::simulation {
namespace {

using basic::Sighting;

constexpr Metres robot_mouth = 1.1;

enum class Sensor : std::uint64_t { people = 1, faces, sound, voice };  // voice: of another robot

// The noise of one measurement. It is the same for all calls within a step.
template <class Who>
Random noise(Hall const& hall, RobotId robot, Sensor sensor, Who who) {
    return Random{mixed({hall.seed(), 3, static_cast<std::uint64_t>(hall.now().count()), static_cast<std::uint64_t>(robot),
                         static_cast<std::uint64_t>(sensor), static_cast<std::uint64_t>(who)})};
}

Pose measured(Pose const& pose, Metres sigma, Radians heading_sigma, Random random) {
    Point const off{random.gaussian() * sigma, random.gaussian() * sigma};
    return {pose.position + off, wrapped(pose.heading + random.gaussian() * heading_sigma)};
}

Covariance covariance(Metres sigma, Radians heading_sigma) {
    return Eigen::Vector3d{sigma * sigma, sigma * sigma, heading_sigma * heading_sigma}.asDiagonal();
}

// Estimates the age. The estimate is the same during one visit.
std::optional<basic::AgeRange> estimated_age(Hall const& hall, RobotId robot, Person const& person) {
    constexpr double sigma = 3;  // years
    constexpr int margin = 6;    // years to either side of the estimate
    if (!person.age) return {};
    Random random{mixed({hall.seed(), 7, static_cast<std::uint64_t>(robot), static_cast<std::uint64_t>(person.id)})};
    auto const estimate = static_cast<int>(std::lround(*person.age + random.gaussian() * sigma));
    return basic::AgeRange{std::max(0, estimate - margin), std::max(0, estimate + margin)};
}

// Returns "face-3" for "person-3".
std::string renamed(std::string const& track, std::string_view kind) { return std::string{kind} + track.substr(track.find('-')); }

Sensors const& sensors_of(Hall const& hall, RobotId robot) {
    return hall.plan().robots.at(static_cast<std::size_t>(robot)).sensors;
}

// Returns the tracked people, nearest first.
std::vector<std::pair<Person const*, std::string>> tracked_people(Hall const& hall, RobotId robot) {
    std::vector<std::pair<Person const*, std::string>> tracked;
    for (Person const& person : hall.people()) {
        if (auto track = hall.track(person.id)) tracked.emplace_back(&person, *track);
    }
    Point const here = hall.robot(robot).pose.position;
    std::ranges::sort(tracked, {}, [&](auto const& each) { return distance(here, each.first->pose.position); });
    return tracked;
}

// Measures the tracked people with a sensor of this kind. `is_seen` sets the ref and the height.
template <class Abilities, class IsSeen>
std::vector<Sighting> seen_by(Hall const& hall, RobotId robot, Sensor kind, Abilities const& sensor, IsSeen is_seen) {
    std::vector<Sighting> all;
    for (auto const& [person, track] : tracked_people(hall, robot)) {
        Sighting seen{.who = entity_id(person->id), .ref = {}, .pose = {}};
        if (!is_seen(*person, track, seen)) continue;
        seen.pose = measured(person->pose, sensor.sigma, sensor.heading_sigma, noise(hall, robot, kind, person->id));
        seen.covariance = covariance(sensor.sigma, sensor.heading_sigma);
        all.push_back(std::move(seen));
    }
    return all;
}

}  // namespace

std::vector<Sighting> people_seen(Hall const& hall, RobotId robot) {
    Sensors::People const& sensor = sensors_of(hall, robot).people;
    return seen_by(hall, robot, Sensor::people, sensor, [&](Person const& person, std::string const& track, Sighting& seen) {
        seen.ref = track;
        return sees(hall.plan(), sensor, hall.robot(robot).pose, person);
    });
}

std::vector<Sighting> faces_seen(Hall const& hall, RobotId robot) {
    Sensors::Faces const& sensor = sensors_of(hall, robot).faces;
    return seen_by(hall, robot, Sensor::faces, sensor, [&](Person const& person, std::string const& track, Sighting& seen) {
        seen.ref = renamed(track, "face");
        seen.height = person.face_height();
        return sees_face(hall.plan(), sensor, hall.robot(robot).pose, person);
    });
}

std::vector<basic::RecognizedPerson> people_recognized(Hall const& hall, RobotId robot) {
    Sensors::Identification const& sensor = sensors_of(hall, robot).identification;
    std::vector<basic::RecognizedPerson> recognized;
    for (auto const& [person, track] : tracked_people(hall, robot)) {
        if (!recognizes(hall.plan(), sensor, hall.robot(robot).pose, *person)) continue;
        recognized.push_back({.who = entity_id(person->id),
                              .track = track,
                              .id = person->known ? std::optional{person->role} : std::nullopt,
                              .gender = person->gender,
                              .age = estimated_age(hall, robot, *person)});
    }
    return recognized;
}

std::vector<Sighting> sounds_heard(Hall const& hall, RobotId robot) {
    Sensors::Sound const& sensor = sensors_of(hall, robot).sound;
    Pose const& ears = hall.robot(robot).pose;
    std::vector<Sighting> heard;
    auto hear = [&](Entity who, std::string ref, Pose const& pose, Metres height, Random random) {
        Point const at = measured(pose, sensor.sigma, 0, random).position;
        Metres const apart = std::max(distance(ears.position, pose.position), sensor.sigma);
        heard.push_back({entity_id(who),
                         std::move(ref),
                         {at, direction(ears.position, at)},
                         height,
                         covariance(sensor.sigma, sensor.sigma / apart)});
    };
    for (auto const& [person, track] : tracked_people(hall, robot)) {
        if (!person->speaking || !hears(hall.plan(), ears.position, person->pose.position, sensor.range)) continue;
        hear(person->id, renamed(track, "sound"), person->pose, person->face_height(),
             noise(hall, robot, Sensor::sound, person->id));
    }
    for (Robot const& other : hall.robots()) {
        if (other.id == robot || !other.speaking || !hears(hall.plan(), ears.position, other.pose.position, sensor.range))
            continue;
        hear(other.id, "sound-" + other.name, other.pose, robot_mouth, noise(hall, robot, Sensor::voice, other.id));
    }
    std::ranges::sort(heard, {}, [&](Sighting const& sound) { return distance(ears.position, sound.pose.position); });
    return heard;
}

bool hears(Hall const& hall, RobotId robot, Point const& place) {
    return hears(hall.plan(), hall.robot(robot).pose.position, place, sensors_of(hall, robot).sound.range);
}

bool sees_gesture(Hall const& hall, RobotId robot, Point const& place) {
    Sensors::Gestures const& sensor = sensors_of(hall, robot).gestures;
    return reaches(hall.plan(), hall.robot(robot).pose, place, sensor.range, sensor.field_of_view);
}

}  // namespace rois::simulation
