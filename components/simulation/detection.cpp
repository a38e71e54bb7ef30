// Person, face and sound detection (7.6.2, 7.6.5, 7.6.7): how many there are, told when the number changes.
#include "simulation/basic_components.hpp"
#include "simulation/senses.hpp"

namespace rois::simulation {
namespace {

using Count = std::size_t (*)(Hall const&, RobotId);

class Detection final : public ContinuousFunction {
public:
    Detection(Fitting fitting, std::string_view event_type, Count count)
        : ContinuousFunction{std::move(fitting)}, event_type_{event_type}, count_{count} {}

private:
    void begin() override { told_.reset(); }

    void sense(Instant when) override {
        std::size_t const number = count_(hall(), robot());
        if (told_ == number) return;
        told_ = number;
        port().event(event_type_, {{date_time("timestamp", when.utc), integer("number", static_cast<std::int64_t>(number))}, {}});
    }

    std::string_view event_type_;
    Count count_;
    std::optional<std::size_t> told_;
};

}  // namespace

std::unique_ptr<Component> person_detection(Fitting fitting) {
    Count const count = [](Hall const& hall, RobotId robot) { return people_seen(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(fitting), "person_detected", count);
}

std::unique_ptr<Component> face_detection(Fitting fitting) {
    Count const count = [](Hall const& hall, RobotId robot) { return faces_seen(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(fitting), "face_detected", count);
}

std::unique_ptr<Component> sound_detection(Fitting fitting) {
    Count const count = [](Hall const& hall, RobotId robot) { return sounds_heard(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(fitting), "sound_detected", count);
}

}  // namespace rois::simulation
