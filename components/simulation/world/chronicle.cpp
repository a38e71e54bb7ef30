#include "simulation/world/chronicle.hpp"

namespace rois::simulation {

void Chronicle::add(Happening happening) {
    happening.sequence = ++last_;
    happenings_.push_back(std::move(happening));
    if (happenings_.size() > capacity) happenings_.pop_front();
}

}  // namespace rois::simulation
