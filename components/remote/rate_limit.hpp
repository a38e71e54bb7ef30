// Limits how often something happens.
#pragma once

#include <algorithm>
#include <chrono>

#include "types/instant.hpp"

namespace rois::remote {

// A token bucket: allows `at_once` together, and then `a_second` in a second.
class RateLimit {
public:
    constexpr RateLimit(double at_once, double a_second) : at_once_{at_once}, a_second_{a_second} {}

    void count() { ++counted_; }
    bool is_exceeded(Steady now) {
        std::chrono::duration<double> const passed = now - since_;
        since_ = now;
        counted_ = std::max(0.0, counted_ - passed.count() * a_second_);
        return counted_ >= at_once_;
    }

private:
    double at_once_;
    double a_second_;
    double counted_ = 0;  // less those that the time until `since_` has allowed
    Steady since_{};
};

}  // namespace rois::remote
