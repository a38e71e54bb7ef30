// A name whose look-up takes as long as a test wants.
#pragma once

#include <latch>
#include <memory>

namespace rois::test {

// All names that end with ".slow" are looked up until they are allowed to be unknown.
class SlowName {
public:
    SlowName();

    void await_lookup() { state_->asked.wait(); }
    void end_lookup() { state_->answered.count_down(); }

    struct State {
        std::latch asked{1};
        std::latch answered{1};
    };

private:
    std::shared_ptr<State> state_;
};

}  // namespace rois::test
