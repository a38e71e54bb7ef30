// Person, face and sound detection (7.6.2, 7.6.5, 7.6.7): reports changes of their number.
#include "basic/components/basic_components.hpp"

namespace rois::basic {
namespace {

class Detection final : public ContinuousFunction {
public:
    Detection(Context context, std::string_view event_type, Sense sense)
        : ContinuousFunction{std::move(context)}, event_type_{event_type}, sense_{sense} {}

private:
    void begin() override { reported_.reset(); }

    void sense(Instant when) override {
        std::size_t const number = perception().sightings(sense_).size();
        if (reported_ == number) return;
        reported_ = number;
        port().event(event_type_, {{date_time("timestamp", when.utc), integer("number", static_cast<std::int64_t>(number))}, {}});
    }

    std::string_view event_type_;
    Sense sense_;
    std::optional<std::size_t> reported_;
};

}  // namespace

std::unique_ptr<LocalComponent> person_detection(Context context) {
    return std::make_unique<Detection>(std::move(context), "person_detected", Sense::people);
}

std::unique_ptr<LocalComponent> face_detection(Context context) {
    return std::make_unique<Detection>(std::move(context), "face_detected", Sense::faces);
}

std::unique_ptr<LocalComponent> sound_detection(Context context) {
    return std::make_unique<Detection>(std::move(context), "sound_detected", Sense::sounds);
}

}  // namespace rois::basic
