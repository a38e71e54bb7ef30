// A program with a robot of plain fakes that may block, like most robots. Each of its motions arrives after three ticks.
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "basic/fake_body.hpp"
#include "sdk/cpp/component_program.hpp"

namespace {

using rois::basic::MotionState;
using rois::basic::WorldTime;
using rois::basic::stage::FakeBody;

class Clock final : public rois::Device {
public:
    explicit Clock(std::shared_ptr<FakeBody> body) : body_{std::move(body)} {}

    void advance(rois::Instant now) override {
        auto& motion = body_->wheels.now;
        moved_ = motion.state == MotionState::moving ? moved_ + 1 : 0;
        if (moved_ == 3) motion = {MotionState::arrived, 1};
        auto const last = std::exchange(last_, now.steady).value_or(now.steady);
        body_->step(now, std::chrono::duration_cast<WorldTime>(now.steady - last));
    }

private:
    std::shared_ptr<FakeBody> body_;
    std::optional<rois::Steady> last_;
    int moved_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    return rois::sdk::serve_robot(argc, argv, "robots", [] {
        auto const body = std::make_shared<FakeBody>("tiny");
        body->may_block = true;
        return rois::sdk::Robot{body, std::make_shared<Clock>(body)};
    });
}
