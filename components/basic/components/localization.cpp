// Person, face and sound localization (7.6.3, 7.6.6, 7.6.8): reports positions when somebody is new or has moved,
// and who is left when a person or face is gone.
#include <algorithm>
#include <cmath>
#include <span>

#include "basic/base/codebooks.hpp"
#include "basic/base/movement.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// The sensor and the event of one kind of localization. `direction`: the heading of a sighting is only the direction to the
// sound, not an orientation.
struct Kind {
    enum class Heading : std::uint8_t { orientation, direction };
    std::string_view event_type;
    std::string_view refs;
    Heading heading;
    Sense sense;
};

constexpr std::string_view threshold_name = "detection_threshold";
constexpr std::int32_t usual_threshold = 200;   // mm, if the sensor's noise allows it
constexpr std::int32_t default_interval = 250;  // ms

// The lowest detection_threshold that the noise of the robot's sensor allows, in mm.
std::int32_t lowest_threshold(Kind const& kind, Context const& context) {
    Metres const sigma = context.body->perception().sigma(kind.sense);
    return static_cast<std::int32_t>(std::ceil(millimetres(Movement::least_movement(sigma))));
}

// Sets minimum and default of the threshold in the profile, for this robot's sensor.
void set_threshold_limits(ParameterProfile& parameter, std::int32_t lowest) {
    if (!equal_ignoring_case(parameter.name, threshold_name)) return;
    parameter.default_value = std::to_string(std::max(usual_threshold, lowest));
    parameter.description += " At least " + std::to_string(lowest) + ", because of the noise of this robot's sensor.";
}

Context with_threshold(Context context, std::int32_t lowest) {
    auto profile = std::make_shared<ComponentProfile>(*context.description.profile);
    for (auto& message : profile->messages)
        for (auto& argument : message.arguments) set_threshold_limits(argument, lowest);
    for (auto& parameter : profile->parameters) set_threshold_limits(parameter, lowest);
    context.description.profile = std::move(profile);
    return context;
}

// Removes the orientation, also from the covariance.
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
    Localization(Context context, Kind const& kind) : Localization{lowest_threshold(kind, context), std::move(context), kind} {}

private:
    Localization(std::int32_t lowest, Context context, Kind const& kind)
        : ContinuousFunction{with_threshold(std::move(context), lowest)}, kind_{kind}, lowest_{lowest} {}

    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        if (auto const threshold = integer_of(parameters, threshold_name); threshold && *threshold < lowest_)
            return "parameter 'detection_threshold': " + std::to_string(*threshold) + " mm is less than the minimum of " +
                   std::to_string(lowest_) + " mm, below which movement is lost in the noise of this robot's sensor";
        return negative(parameters, "minimum_interval");
    }

    void apply(ParameterList const& parameters) override {
        threshold_ = integer_of(parameters, threshold_name).value_or(std::max(usual_threshold, lowest_)) / 1000.0;
        interval_ = WorldTime{integer_of(parameters, "minimum_interval").value_or(default_interval)};
    }

    void begin() override {
        movement_.clear();
        reported_.clear();
        reported_at_.reset();
    }

    void sense(Instant when) override {
        WorldTime const now = body().now();
        auto const sightings = perception().sightings(kind_.sense);
        for (auto const& s : sightings) movement_.measured(s.ref, s.pose.position, s.covariance, now);
        movement_.forget_old(now);
        if (reported_at_ && now < *reported_at_ + interval_) return;
        auto const is_news = [&](Sighting const& s) { return movement_.worth_reporting(s.ref, threshold_); };
        auto const is_gone = [&](std::string const& ref) {
            return std::ranges::find(sightings, ref, &Sighting::ref) == sightings.end();
        };
        bool const somebody_is_gone = kind_.sense != Sense::sounds && std::ranges::any_of(reported_, is_gone);
        if (!somebody_is_gone && std::ranges::none_of(sightings, is_news)) return;
        reported_at_ = now;
        reported_.clear();
        for (auto const& s : sightings) {
            movement_.reported(s.ref);
            reported_.push_back(s.ref);
        }
        port().event(kind_.event_type, results(sightings, when));
    }

    Results results(std::span<Sighting const> sightings, Instant when) const {
        std::vector<std::string> refs;
        std::vector<std::string> points;
        Results results;
        for (auto const& s : sightings) {
            refs.push_back(s.ref);
            points.push_back(to_wire(s.pose));
            auto entity = located_entity("position_data", s.ref, s.pose, s.height, s.covariance);
            bool const oriented = kind_.heading == Kind::Heading::orientation;
            results.located.push_back(oriented ? std::move(entity) : without_orientation(std::move(entity)));
        }
        results.parameters = {date_time("timestamp", when.utc),
                              references(std::string{kind_.refs}, std::move(refs), std::string{codebook::track}),
                              positions("position_data", std::move(points), body().crs())};
        return results;
    }

    Kind kind_;
    std::int32_t lowest_;  // mm
    Metres threshold_ = 0;
    WorldTime interval_{};
    Movement movement_;
    std::optional<WorldTime> reported_at_;
    std::vector<std::string> reported_;  // refs of the last report
};

}  // namespace

std::unique_ptr<LocalComponent> person_localization(Context context) {
    return std::make_unique<Localization>(std::move(context),
                                          Kind{"person_localized", "person_ref", Kind::Heading::orientation, Sense::people});
}

std::unique_ptr<LocalComponent> face_localization(Context context) {
    return std::make_unique<Localization>(std::move(context),
                                          Kind{"face_localized", "face_ref", Kind::Heading::orientation, Sense::faces});
}

std::unique_ptr<LocalComponent> sound_localization(Context context) {
    return std::make_unique<Localization>(std::move(context),
                                          Kind{"sound_localized", "sound_ref", Kind::Heading::direction, Sense::sounds});
}

}  // namespace rois::basic
