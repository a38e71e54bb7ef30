// The map of an engine's floor, for clients that draw it (schemas/map.xsd). Lengths in mm, angles in degrees counter-clockwise,
// x to the right, y up.
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
        double width, depth;  // along x and y, of the area around it that conditions refer to by the name
    };
    struct Frame {
        std::string crs;
        double x, y, heading;  // of its origin, in `FloorMap::crs`
    };
    struct Robot {
        std::string name;
        double radius;
        std::optional<Frame> frame;  // of the robot's own map
    };

    std::string name;
    std::string crs;  // the frame of all coordinates
    Box bounds;
    std::vector<Wall> walls;
    std::vector<Box> furniture;
    std::vector<Place> places;
    std::vector<Robot> robots;
};

}  // namespace rois
