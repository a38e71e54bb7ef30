#include "simulation/plan/geometry.hpp"

#include <gtest/gtest.h>

#include "basic/body/wire_units.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {

using namespace basic;
namespace {

TEST(Pose, AnglesAreWrappedIntoAHalfTurnToEitherSide) {
    EXPECT_NEAR(wrapped(from_degrees(190)), from_degrees(-170), 1e-12);
    EXPECT_NEAR(wrapped(from_degrees(-540)), from_degrees(180), 1e-12);
    EXPECT_NEAR(wrapped(from_degrees(720)), 0, 1e-12);
}

TEST(Pose, BearingIsRelativeToTheHeading) {
    Pose const north{Point{1, 1}, from_degrees(90)};
    EXPECT_NEAR(bearing(north, Point{1, 5}), 0, 1e-12);
    EXPECT_NEAR(bearing(north, Point{0, 1}), from_degrees(90), 1e-12);
    EXPECT_NEAR(bearing(north, Point{2, 1}), from_degrees(-90), 1e-12);
}

TEST(Pose, AFrameConvertsFromTheBodyToTheHall) {
    Point const ahead = frame({Point{2, 3}, from_degrees(90)}) * Point{1, 0};
    EXPECT_NEAR(ahead.x(), 2, 1e-12);
    EXPECT_NEAR(ahead.y(), 4, 1e-12);
}

TEST(Segments, CrossAlsoWhenTheyOnlyTouch) {
    Segment const wall{Point{0, 0}, Point{0, 4}};
    EXPECT_TRUE(cross(wall, {Point{-1, 2}, Point{1, 2}}));
    EXPECT_TRUE(cross(wall, {Point{-1, 4}, Point{1, 4}}));
    EXPECT_TRUE(cross(wall, {Point{0, 3}, Point{0, 9}}));
    EXPECT_FALSE(cross(wall, {Point{-1, 5}, Point{1, 5}}));
    EXPECT_FALSE(cross(wall, {Point{0, 5}, Point{0, 9}}));
    EXPECT_FALSE(cross(wall, {Point{1, 0}, Point{1, 4}}));
}

TEST(Boxes, AreAsFarAsTheirNearestSide) {
    Box const desk{Point{1, 1}, Point{3, 2}};
    EXPECT_DOUBLE_EQ(distance(desk, Point{2, 5}), 3);
    EXPECT_DOUBLE_EQ(distance(desk, Point{2, 1.5}), 0);
}

TEST(FreeWay, EndsWhereTwoDiscsTouch) {
    Disc const robot{Point{0, 0}, 0.3}, person{Point{2, 0}, 0.2};
    EXPECT_NEAR(free_way(robot, 0, person, 5), 1.5, 1e-12);
    EXPECT_DOUBLE_EQ(free_way(robot, from_degrees(180), person, 5), 5);
    EXPECT_DOUBLE_EQ(free_way(robot, from_degrees(30), person, 5), 5);
    EXPECT_DOUBLE_EQ(free_way(robot, 0, person, 1), 1);
}

TEST(WireUnits, AreWholeMillimetresAndDegrees) {
    EXPECT_EQ(to_wire({Point{12.5, 3}, from_degrees(-90)}), "12500, 3000, -90");
    EXPECT_EQ(to_wire({Point{-0.0004, 0.0006}, from_degrees(359.9)}), "0, 1, 0");
}

TEST(WireUnits, TargetsHaveAHeadingOrNot) {
    auto const posed = target_from_wire(" 1500,-200 , 450");
    ASSERT_TRUE(posed);
    EXPECT_EQ(posed->position, Point(1.5, -0.2));
    ASSERT_TRUE(posed->heading);
    EXPECT_NEAR(*posed->heading, from_degrees(90), 1e-12);
    auto const place = target_from_wire("1500, 2000");
    ASSERT_TRUE(place);
    EXPECT_FALSE(place->heading);
}

TEST(WireUnits, InvalidPositionsAreRejected) {
    for (auto text : {"", "1", "1, 2, 3, 4", "1, two", "1,, 2", "nan, 1", "1, inf", "1, 2,", "desk", "1e400, 0"})
        EXPECT_FALSE(target_from_wire(text)) << text;
}

TEST(WireUnits, CovarianceIsInMillimetresAndDegrees) {
    Covariance covariance = Eigen::Vector3d{0.0025, 0.0025, 0.01}.asDiagonal();
    covariance(0, 2) = covariance(2, 0) = 0.001;
    Located const made = located("position_data", "person-1", "the hall", {Point{1, 2}, from_degrees(90)}, 1.7, covariance);
    EXPECT_EQ(made.position, (std::array<double, 3>{1000, 2000, 1700}));
    auto const& rows = std::get<Located::Covariance>(made.certainty).rows;
    ASSERT_EQ(rows.size(), 9u);
    EXPECT_EQ(rows[0], 2500);
    EXPECT_EQ(rows[2], 57.296) << "a radian, to a thousandth of a degree";
    EXPECT_EQ(rows[8], 32.828) << "0.01 of its square";
}

// The numbers that the standard prescribes for its engine, and the numbers of Random made from them.
TEST(RandomNumbers, AreTheSameEverywhere) {
    Random random{5489};
    for (int i = 0; i < 9'999; ++i) random.uniform();
    EXPECT_DOUBLE_EQ(random.uniform(), static_cast<double>(9981545732273789042u >> 11) * 0x1.0p-53);
    EXPECT_NE(mixed({1, 2}), mixed({2, 1}));
    EXPECT_NE(mixed({1, 2}), mixed({1, 3}));
}

TEST(RandomNumbers, GaussianOnesHaveMeanZeroAndDeviationOne) {
    Random random{7};
    double sum = 0, squares = 0;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        double const x = random.gaussian();
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / count, 0, 0.03);
    EXPECT_NEAR(squares / count, 1, 0.05);
}

}  // namespace
}  // namespace rois::simulation
