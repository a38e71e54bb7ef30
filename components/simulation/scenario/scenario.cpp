#include "simulation/scenario/scenario.hpp"

#include <array>

namespace rois::simulation {

std::span<std::string_view const> gestures() {
    static constexpr std::array<std::string_view, 8> all{"wave",  "nod",        "shake_head", "bow",
                                                         "point", "raise_hand", "clap",       "thumbs_up"};
    return all;
}

}  // namespace rois::simulation
