// Person, face and sound detection (7.6.2, 7.6.5, 7.6.7): reports changes of their number.
#include "simulation/basic/basic_components.hpp"
#include "simulation/robot/senses.hpp"

namespace rois::simulation {
namespace {

using Count = std::size_t (*)(Hall const&, RobotId);

class Detection final : public ContinuousFunction {
public:
    Detection(Context context, std::string_view event_type, Count count)
        : ContinuousFunction{std::move(context)}, event_type_{event_type}, count_{count} {}

private:
    void begin() override { reported_.reset(); }

    void sense(Instant when) override {
        std::size_t const number = count_(hall(), robot());
        if (reported_ == number) return;
        reported_ = number;
        port().event(event_type_, {{date_time("timestamp", when.utc), integer("number", static_cast<std::int64_t>(number))}, {}});
    }

    std::string_view event_type_;
    Count count_;
    std::optional<std::size_t> reported_;
};

}  // namespace

std::unique_ptr<Component> person_detection(Context context) {
    Count const count = [](Hall const& hall, RobotId robot) { return people_seen(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(context), "person_detected", count);
}

std::unique_ptr<Component> face_detection(Context context) {
    Count const count = [](Hall const& hall, RobotId robot) { return faces_seen(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(context), "face_detected", count);
}

std::unique_ptr<Component> sound_detection(Context context) {
    Count const count = [](Hall const& hall, RobotId robot) { return sounds_heard(hall, robot).size(); };
    return std::make_unique<Detection>(std::move(context), "sound_detected", count);
}

}  // namespace rois::simulation
