// Person, face and sound localization (7.6.3, 7.6.6, 7.6.8): where they are, told when somebody is new or has moved.
#include <algorithm>
#include <ranges>
#include <span>

#include "simulation/basic_components.hpp"
#include "simulation/codebooks.hpp"
#include "simulation/movement.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/senses.hpp"

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
};

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
    static constexpr std::int32_t default_threshold = 200;  // mm
    static constexpr std::int32_t default_interval = 250;   // ms

    Localization(Fitting fitting, Kind const& kind) : ContinuousFunction{std::move(fitting)}, kind_{kind} {}

private:
    std::optional<std::string> unfit(ParameterList const& parameters) const override {
        if (auto problem = negative(parameters, "detection_threshold")) return problem;
        return negative(parameters, "minimum_interval");
    }

    void apply(ParameterList const& parameters) override {
        threshold_ = integer_of(parameters, "detection_threshold").value_or(default_threshold) / 1000.0;
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
    Metres threshold_ = 0;
    WorldTime interval_{};
    Movement movement_;
    std::optional<WorldTime> told_at_;
};

}  // namespace

std::unique_ptr<Component> person_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"person_localized", "person_ref", Kind::Heading::orientation, people});
}

std::unique_ptr<Component> face_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"face_localized", "face_ref", Kind::Heading::orientation, faces});
}

std::unique_ptr<Component> sound_localization(Fitting fitting) {
    return std::make_unique<Localization>(std::move(fitting),
                                          Kind{"sound_localized", "sound_ref", Kind::Heading::direction, sounds});
}

}  // namespace rois::simulation
