#include "fuzzing/targets.hpp"

#include <array>

namespace rois::fuzzing {

std::span<Target const> targets() {
    static constexpr std::array<Target, 13> all{{{"answers", answers},
                                                 {"conditions", conditions},
                                                 {"configuration", configuration},
                                                 {"engines", engines},
                                                 {"http", http},
                                                 {"journals", journals},
                                                 {"messages", messages},
                                                 {"profiles", profiles},
                                                 {"records", records},
                                                 {"roles", roles},
                                                 {"speech", speech},
                                                 {"tokens", tokens},
                                                 {"websocket", websocket}}};
    return all;
}

}  // namespace rois::fuzzing
