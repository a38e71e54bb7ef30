#include "simulation/robot/top_view.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {

namespace {

constexpr Metres wall_thickness = 0.12;
constexpr Metres nose = 0.08;  // half the thickness of the line that shows a heading

class Canvas {
public:
    Canvas(FloorPlan const& plan, std::uint16_t longest) : low_{plan.bounds.low} {
        Point const size = plan.bounds.high - low_;
        scale_ = longest / std::max(size.x(), size.y());
        auto const pixels = [&](Metres length) {
            return static_cast<std::uint16_t>(std::clamp(std::lround(length * scale_), 1L, long{longest}));
        };
        picture_.width = pixels(size.x());
        picture_.height = pixels(size.y());
        picture_.rgb.resize(std::size_t{picture_.width} * picture_.height * 3);
    }

    // Fills the pixels of the box whose centre `is_inside`.
    template <class Inside>
    void fill(Box const& around, Colour colour, Inside is_inside) {
        auto const first = at(Point{around.low.x(), around.high.y()}), last = at(Point{around.high.x(), around.low.y()});
        for (int row = std::max(first.row, 0); row <= std::min(last.row, picture_.height - 1); ++row)
            for (int column = std::max(first.column, 0); column <= std::min(last.column, picture_.width - 1); ++column)
                if (is_inside(centre(column, row))) set(column, row, colour);
    }

    void box(Box const& box, Colour colour) {
        fill(box, colour, [](Point const&) { return true; });
    }

    void disc(Point const& middle, Metres radius, Colour colour) {
        Point const reach{radius, radius};
        fill({middle - reach, middle + reach}, colour, [&](Point const& p) { return distance(p, middle) <= radius; });
    }

    void line(Segment const& segment, Metres half, Colour colour) {
        Point const reach{half, half};
        Box const around{segment.from.cwiseMin(segment.to) - reach, segment.from.cwiseMax(segment.to) + reach};
        fill(around, colour, [&](Point const& p) { return distance(segment, p) <= half; });
    }

    Pixel at(Point const& p) const {
        return {static_cast<int>(std::floor((p.x() - low_.x()) * scale_)),
                picture_.height - 1 - static_cast<int>(std::floor((p.y() - low_.y()) * scale_))};
    }

    media::Picture take() { return std::move(picture_); }

private:
    Point centre(int column, int row) const {
        return low_ + Point{(column + 0.5) / scale_, (picture_.height - 1 - row + 0.5) / scale_};
    }

    void set(int column, int row, Colour colour) {
        auto* pixel = &picture_.rgb[(static_cast<std::size_t>(row) * picture_.width + static_cast<std::size_t>(column)) * 3];
        pixel[0] = colour.red;
        pixel[1] = colour.green;
        pixel[2] = colour.blue;
    }

    Point low_;
    double scale_ = 1;  // pixels a metre
    media::Picture picture_;
};

void draw(Canvas& canvas, FloorPlan const& plan) {
    auto const& [low, high] = plan.bounds;
    canvas.box(plan.bounds, floor_colour);
    for (auto const& desk : plan.desks) canvas.box(desk, desk_colour);
    Point const east{high.x(), low.y()}, west{low.x(), high.y()};
    for (auto const& edge : {Segment{low, east}, Segment{east, high}, Segment{high, west}, Segment{west, low}})
        canvas.line(edge, wall_thickness, wall_colour);
    for (auto const& wall : plan.walls) canvas.line(wall, wall_thickness / 2, wall_colour);
}

void draw(Canvas& canvas, Scene::Figure const& figure) {
    auto const& middle = figure.pose.position;
    canvas.disc(middle, figure.radius, figure.colour);
    canvas.line({middle + unit(figure.pose.heading) * figure.radius * 0.5, middle + unit(figure.pose.heading) * figure.radius},
                nose, wall_colour);
}

}  // namespace

Scene scene_of(FloorPlan const& plan, std::span<Robot const> robots, std::span<Person const> people) {
    Scene scene;
    for (auto const& person : people)
        scene.figures.push_back({person.pose, person_radius, person.speaking ? speaking_colour : person_colour});
    for (auto const& robot : robots)
        scene.figures.push_back({robot.pose, plan.robots[static_cast<std::size_t>(robot.id)].radius,
                                 robot.speaking ? speaking_colour : robot_colour});
    return scene;
}

media::Picture top_view(FloorPlan const& plan, Scene const& scene, std::uint16_t longest) {
    Canvas canvas{plan, longest};
    draw(canvas, plan);
    for (auto const& figure : scene.figures) draw(canvas, figure);
    return canvas.take();
}

Pixel pixel_of(FloorPlan const& plan, media::Picture const& picture, Point const& point) {
    return Canvas{plan, std::max(picture.width, picture.height)}.at(point);
}

void Camera::capture() {
    auto scene = scene_of(hall_.plan(), hall_.robots(), hall_.people());
    std::lock_guard const lock{mutex_};
    scene_ = std::move(scene);
}

std::optional<media::Picture> Camera::picture(std::uint16_t longest) const {
    std::optional<Scene> scene;
    {
        std::lock_guard const lock{mutex_};
        scene = scene_;
    }
    if (!scene) return {};
    return top_view(plan_, *scene, longest);
}

}  // namespace rois::simulation
