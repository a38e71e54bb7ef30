// Gesture recognition (7.6.10): reports gestures of people and other robots in view.
#include <utility>

#include "simulation/basic/basic_components.hpp"
#include "simulation/basic/codebooks.hpp"
#include "simulation/robot/reaction_types.hpp"
#include "simulation/robot/senses.hpp"

namespace rois::simulation {
namespace {

class GestureRecognition final : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

    ParameterList readable_parameters() const override {
        auto const all = gestures();
        return {references("recognizable_gestures", {all.begin(), all.end()}, std::string{codebook::gesture})};
    }

private:
    void begin() override { read_ = hall().chronicle().last(); }
    void resumed() override { read_ = hall().chronicle().last(); }

    void sense(Instant when) override {
        for (Happening const& happening : hall().chronicle().since(read_)) {
            read_ = happening.sequence;
            std::string gesture = gesture_in(happening);
            if (gesture.empty() || !sees_gesture(hall(), robot(), happening.place)) continue;
            port().event("gesture_recognized", {{date_time("timestamp", when.utc),
                                                 references("gesture_ref", {std::move(gesture)}, std::string{codebook::gesture})},
                                                {}});
        }
    }

    // Returns the gesture; empty if it is not a gesture or the robot's own.
    std::string gesture_in(Happening const& happening) const {
        if (happening.who == Entity{robot()}) return {};
        if (happening.kind == Happening::Kind::gesture_made) return happening.text;
        if (happening.kind == Happening::Kind::reaction_shown) return std::string{gesture_of(happening.text)};
        return {};
    }

    std::uint64_t read_ = 0;
};

}  // namespace

std::unique_ptr<Component> gesture_recognition(Context context) {
    return std::make_unique<GestureRecognition>(std::move(context));
}

}  // namespace rois::simulation
