// The floor that an engine's robots live on, for those who draw it (schemas/map.xsd). Lengths in mm, angles in degrees
// counter-clockwise, x to the right, y up.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rois {

struct FloorMap {
    struct Box {
        double x, y;  // the lower left corner
        double width, depth;
    };
    struct Wall {
        double x1, y1, x2, y2;
    };
    struct Place {
        std::string name;
        double x, y, heading;
        double width, depth;  // around it, of the area that conditions mean by the name
    };
    struct Frame {
        std::string crs;
        double x, y, heading;  // of its origin
    };
    struct Robot {
        std::string name;
        double radius;
        std::optional<Frame> frame;  // of its own map
    };

    std::string name;
    std::string crs;  // the frame of all this
    Box bounds;
    std::vector<Wall> walls;
    std::vector<Box> furniture;
    std::vector<Place> places;
    std::vector<Robot> robots;
};

}  // namespace rois
