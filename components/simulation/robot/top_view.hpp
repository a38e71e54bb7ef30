// The hall seen from above, as a picture.
#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "basic/body/body.hpp"
#include "media/media.hpp"
#include "simulation/world/hall.hpp"

namespace rois::simulation {

struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0;
};

inline constexpr Colour floor_colour{236, 234, 226}, desk_colour{172, 138, 96}, wall_colour{60, 60, 66},
    robot_colour{24, 140, 70}, person_colour{40, 90, 200}, speaking_colour{230, 120, 20};

// The moving figures at one moment.
struct Scene {
    struct Figure {
        Pose pose;
        Metres radius = 0;
        Colour colour{};
    };
    std::vector<Figure> figures;
};

// Robots and people who speak have the speaking colour.
Scene scene_of(FloorPlan const&, std::span<Robot const>, std::span<Person const>);

// Draws the plan so that it fills the picture. North (y) is up; the longer side has at most `longest` pixels.
media::Picture top_view(FloorPlan const&, Scene const&, std::uint16_t longest);

// The pixel of a position in a picture of the plan.
struct Pixel {
    int column, row;
};
Pixel pixel_of(FloorPlan const&, media::Picture const&, Point const&);

// Films the hall from above. Passes the scene from the engine's thread to the drawing thread.
class Camera final : public basic::Camera {
public:
    // `hall` must exist during capture(); picture() does not need it.
    explicit Camera(Hall const& hall) : hall_{hall}, plan_{hall.plan()} {}

    void capture() override;
    std::optional<media::Picture> picture(std::uint16_t longest) const override;

private:
    Hall const& hall_;
    FloorPlan const plan_;
    mutable std::mutex mutex_;
    std::optional<Scene> scene_;
};

}  // namespace rois::simulation
