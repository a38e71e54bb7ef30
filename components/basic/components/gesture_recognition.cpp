// Gesture recognition (7.6.10): reports gestures of people and other robots in view.
#include <utility>

#include "basic/base/codebooks.hpp"
#include "basic/components/basic_components.hpp"
#include "basic/components/reaction_types.hpp"

namespace rois::basic {
namespace {

class GestureRecognition final : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

    ParameterList readable_parameters() const override {
        auto const all = gestures();
        return {references("recognizable_gestures", {all.begin(), all.end()}, std::string{codebook::gesture})};
    }

private:
    void begin() override { read_ = perception().last_sequence(); }
    void resumed() override { read_ = perception().last_sequence(); }

    void sense(Instant when) override {
        for (auto& gesture : perception().gestures_since(std::exchange(read_, perception().last_sequence()))) {
            port().event("gesture_recognized", {{date_time("timestamp", when.utc),
                                                 references("gesture_ref", {std::move(gesture)}, std::string{codebook::gesture})},
                                                {}});
        }
    }

    std::uint64_t read_ = 0;
};

}  // namespace

std::unique_ptr<LocalComponent> gesture_recognition(Context context) {
    return std::make_unique<GestureRecognition>(std::move(context));
}

}  // namespace rois::basic
