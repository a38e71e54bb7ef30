#include "simulation/robot/top_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/world_stage.hpp"

namespace rois::simulation {
namespace {

std::string colour_at(FloorPlan const& plan, media::Picture const& picture, Point const& point) {
    auto const [column, row] = pixel_of(plan, picture, point);
    auto const* pixel = &picture.rgb.at((static_cast<std::size_t>(row) * picture.width + static_cast<std::size_t>(column)) * 3);
    auto const is = [&](Colour const& c) { return pixel[0] == c.red && pixel[1] == c.green && pixel[2] == c.blue; };
    if (is(floor_colour)) return "floor";
    if (is(desk_colour)) return "desk";
    if (is(wall_colour)) return "wall";
    if (is(robot_colour)) return "robot";
    if (is(person_colour)) return "person";
    return is(speaking_colour) ? "speaking" : "something else";
}

TEST(TopView, ShowsWallsAndDesks) {
    auto const plan = shipped_plan("reception-hall.xml");
    auto const picture = top_view(plan, {}, 640);
    EXPECT_EQ(picture.width, 640);
    EXPECT_EQ(picture.height, 384);
    EXPECT_EQ(picture.rgb.size(), std::size_t{640} * 384 * 3);
    EXPECT_EQ(colour_at(plan, picture, {6, 6}), "floor");
    EXPECT_EQ(colour_at(plan, picture, {9.5, 10.6}), "desk");
    EXPECT_EQ(colour_at(plan, picture, {17, 7}), "wall");
    EXPECT_EQ(colour_at(plan, picture, {15, 8.5}), "floor") << "the door of the meeting room";
    EXPECT_EQ(colour_at(plan, picture, {0.03, 6}), "wall") << "the hall's edge";
}

TEST(TopView, HasNorthAbove) {
    auto const plan = shipped_plan("reception-hall.xml");
    auto const picture = top_view(plan, {}, 640);
    EXPECT_EQ(pixel_of(plan, picture, {0, 0}).column, 0);
    EXPECT_EQ(pixel_of(plan, picture, {0, 0}).row, 383);
    EXPECT_EQ(pixel_of(plan, picture, {19.99, 11.99}).column, 639);
    EXPECT_EQ(pixel_of(plan, picture, {19.99, 11.99}).row, 0);
}

TEST(TopView, ShowsFiguresAndTheirHeadings) {
    auto const plan = plain_hall();
    auto const picture =
        top_view(plan, {{{{Point{2, 4}, 0}, 0.3, robot_colour}, {{Point{6, 4}, from_degrees(90)}, 0.25, person_colour}}}, 1'000);
    EXPECT_EQ(colour_at(plan, picture, {2, 4}), "robot");
    EXPECT_EQ(colour_at(plan, picture, {2, 4.25}), "robot");
    EXPECT_EQ(colour_at(plan, picture, {2, 4.35}), "floor");
    EXPECT_EQ(colour_at(plan, picture, {2.2, 4}), "wall") << "its heading is marked";
    EXPECT_EQ(colour_at(plan, picture, {6, 4}), "person");
    EXPECT_EQ(colour_at(plan, picture, {6, 4.2}), "wall");
}

TEST(TopView, CutsOffTheOutside) {
    auto const plan = plain_hall();
    auto const picture = top_view(plan, {{{{Point{0, 0}, 0}, 1.0, robot_colour}, {{Point{-5, 30}, 1}, 1.0, robot_colour}}}, 100);
    EXPECT_EQ(colour_at(plan, picture, {0.05, 0.5}), "robot");
}

TEST(TopView, FitsIntoItsSizeWhateverTheShape) {
    auto plan = plain_hall();
    plan.bounds = {Point{-3, 0}, Point{-2, 50}};
    auto const picture = top_view(plan, {}, 100);
    EXPECT_EQ(picture.width, 2);
    EXPECT_EQ(picture.height, 100);
}

TEST(TopView, SceneHasTheRobotsAndThePeopleOfTheHall) {
    Role guest = tanaka({{Say{"Hello, hello, hello.", "en"}, {}}, {Wait{60}, {}}});
    Hall hall{plain_hall(), only(guest), 1};
    ASSERT_TRUE(runs_until(hall, 10, [&] { return !hall.people().empty() && hall.people()[0].speaking; }));
    auto const scene = scene_of(hall.plan(), hall.robots(), hall.people());
    ASSERT_EQ(scene.figures.size(), 2u);
    EXPECT_EQ(scene.figures[0].colour.red, speaking_colour.red);
    EXPECT_EQ(scene.figures[1].radius, hall.plan().robots[0].radius);
    EXPECT_EQ(scene.figures[1].colour.green, robot_colour.green);
}

TEST(TopView, CameraHasNoPictureBeforeTheFirstScene) {
    Hall const hall{plain_hall(), nobody(), 1};
    Camera camera{hall};
    EXPECT_FALSE(camera.picture(100));
    camera.capture();
    ASSERT_TRUE(camera.picture(100));
    EXPECT_EQ(camera.picture(100)->width, 100);
}

}  // namespace
}  // namespace rois::simulation
