// Person, face and sound localization (7.6.3, 7.6.6, 7.6.8): where they are, told when somebody is new or has moved.
#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>

#include "simulation/basic_components.hpp"
#include "simulation/codebooks.hpp"
#include "simulation/movement.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/senses.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

// One that is localized.
struct Sighting {
    std::string ref;
    Pose pose;
    Metres height;
    Covariance covariance;
};

// What a kind of localization senses, and how its message is named. `direction`: the heading of a sighting is only the direction
// in which it is heard, and no orientation.
struct Kind {
    enum class Heading : std::uint8_t { orientation, direction };
    std::string_view event_type;
    std::string_view refs;
    Heading heading;
    std::vector<Sighting> (*sense)(Hall const&, RobotId);
    Metres (*sigma)(Sensors const&);  // of the sensor's noise, for each axis
};

constexpr std::string_view threshold_name = "detection_threshold";
constexpr std::int32_t usual_threshold = 200;   // mm, where the sensor's noise allows it
constexpr std::int32_t default_interval = 250;  // ms

// The lowest detection_threshold that the sensor of a robot can keep, in mm.
std::int32_t lowest_threshold(Kind const& kind, Fitting const& fitting) {
    auto const& robot = fitting.simulation->hall().plan().robots.at(static_cast<std::size_t>(fitting.robot));
    return static_cast<std::int32_t>(std::ceil(millimetres(Movement::least_movement(kind.sigma(robot.sensors)))));
}

// A profile says how low the threshold may be with this robot's sensor, and what it is when it is not set.
void tell_threshold(ParameterProfile& parameter, std::int32_t lowest) {
    if (!equal_ignoring_case(parameter.name, threshold_name)) return;
    parameter.default_value = std::to_string(std::max(usual_threshold, lowest));
    parameter.description += " At least " + std::to_string(lowest) + ": less is the noise of this robot's sensor.";
}

Fitting with_threshold(Fitting fitting, std::int32_t lowest) {
    auto profile = std::make_shared<ComponentProfile>(*fitting.description.profile);
    for (auto& message : profile->messages)
        for (auto& argument : message.arguments) tell_threshold(argument, lowest);
    for (auto& parameter : profile->parameters) tell_threshold(parameter, lowest);
    fitting.description.profile = std::move(profile);
    return fitting;
}

// A person is where they stand: on the floor.
std::vector<Sighting> people(Hall const& hall, RobotId robot) {
    std::vector<Sighting> sightings;
    for (auto& seen : people_seen(hall, robot)) sightings.push_back({std::move(seen.ref), seen.pose, 0, seen.covariance});
    return sightings;
}

std::vector<Sighting> faces(Hall const& hall, RobotId robot) {
    std::vector<Sighting> sightings;
    for (auto& seen : faces_seen(hall, robot))
        sightings.push_back({std::move(seen.ref), seen.pose, seen.height, seen.covariance});
    return sightings;
}

std::vector<Sighting> sounds(Hall const& hall, RobotId robot) {
    std::vector<Sighting> sightings;
    for (auto& heard : sounds_heard(hall, robot))
        sightings.push_back({std::move(heard.ref), heard.pose, heard.height, heard.covariance});
    return sightings;
}

// Position alone, with the part of the covariance that is about it.
Located without_orientation(Located entity) {
    entity.orientation.clear();
    if (auto* covariance = std::get_if<Located::Covariance>(&entity.certainty)) {
        auto const& all = covariance->rows;
        covariance->rows = {all[0], all[1], all[3], all[4]};
    }
    return entity;
}

class Localization final : public ContinuousFunction {
public:
    Localization(Fitting fitting, Kind const& kind) : Localization{lowest_threshold(kind, fitting), std::move(fitting), kind} {}

private:
    Localization(std::int32_t lowest, Fitting fitting, Kind const& kind)
        : ContinuousFunction{with_threshold(std::move(fitting), lowest)}, kind_{kind}, lowest_{lowest} {}

    std::optional<std::string> unfit(ParameterList const& parameters) const override {
        if (auto const threshold = integer_of(parameters, threshold_name); threshold && *threshold < lowest_)
            return "parameter 'detection_threshold': " + std::to_string(*threshold) + " mm is less than the lowest that works, " +
                   std::to_string(lowest_) + " mm: this robot's sensor does not tell a smaller movement from its noise";
        return negative(parameters, "minimum_interval");
    }

    void apply(ParameterList const& parameters) override {
        threshold_ = integer_of(parameters, threshold_name).value_or(std::max(usual_threshold, lowest_)) / 1000.0;
        interval_ = WorldTime{integer_of(parameters, "minimum_interval").value_or(default_interval)};
    }

    void begin() override {
        movement_.clear();
        told_at_.reset();
    }

    void sense(Instant when) override {
        WorldTime const now = hall().now();
        auto const sightings = kind_.sense(hall(), robot());
        for (auto const& s : sightings) movement_.measured(s.ref, s.pose.position, s.covariance, now);
        movement_.forget_old(now);
        if (told_at_ && now < *told_at_ + interval_) return;
        auto const is_news = [&](Sighting const& s) { return movement_.worth_telling(s.ref, threshold_); };
        if (std::ranges::none_of(sightings, is_news)) return;
        told_at_ = now;
        for (auto const& s : sightings) movement_.told(s.ref);
        port().event(kind_.event_type, results(sightings, when));
    }

    Results results(std::span<Sighting const> sightings, Instant when) const {
        std::vector<std::string> refs;
        std::vector<std::string> points;
        Results results;
        for (auto const& s : sightings) {
            refs.push_back(s.ref);
            points.push_back(told(s.pose));
            auto entity = told_located("position_data", s.ref, s.pose, s.height, s.covariance);
            bool const oriented = kind_.heading == Kind::Heading::orientation;
            results.located.push_back(oriented ? std::move(entity) : without_orientation(std::move(entity)));
        }
        results.parameters = {date_time("timestamp", when.utc),
                              references(std::string{kind_.refs}, std::move(refs), std::string{codebook::track}),
                              positions("position_data", std::move(points), crs())};
        return results;
    }

    Kind kind_;
    std::int32_t lowest_;  // mm
    Metres threshold_ = 0;
    WorldTime interval_{};
    Movement movement_;
    std::optional<WorldTime> told_at_;
};

}  // namespace

std::unique_ptr<Component> person_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"person_localized", "person_ref", Kind::Heading::orientation, people,
                                               [](Sensors const& sensors) { return sensors.people.sigma; }});
}

std::unique_ptr<Component> face_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"face_localized", "face_ref", Kind::Heading::orientation, faces,
                                               [](Sensors const& sensors) { return sensors.faces.sigma; }});
}

std::unique_ptr<Component> sound_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"sound_localized", "sound_ref", Kind::Heading::direction, sounds,
                                               [](Sensors const& sensors) { return sensors.sound.sigma; }});
}

}  // namespace rois::simulation
