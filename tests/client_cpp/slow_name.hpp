// Host names with a slow lookup.
#pragma once

#include <latch>
#include <memory>

namespace rois::test {

// The lookup of a name that ends with ".slow" blocks until `end_lookup`; then the name is unknown.
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
