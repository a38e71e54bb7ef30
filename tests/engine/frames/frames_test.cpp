// Conversions between frames, compared with cases worked out by hand. The dialogues are in frames_dialogue_test.cpp.
#include "engine/frames/frames.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

namespace rois {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

namespace {

// Its origin is at (1000, 2000) of the hall, and its x axis is the hall's y axis. So (x, y) in it is (1000 - y, 2000 + x) in the
// hall, and (x, y) in the hall is (y - 2000, 1000 - x) in it.
Frame map(std::vector<double> covariance = {}) {
    return {.crs = "map",
            .base = "hall",
            .position = {1'000, 2'000, 0},
            .orientation = {0, 0, 90},
            .covariance = std::move(covariance)};
}

// With standard deviations of 10 mm and 2 degrees.
Frame uncertain_map() { return map({100, 0, 0, 0, 100, 0, 0, 0, 4}); }

// A cart in the map: 500 mm along its x axis, turned by -90 degrees. So it has the orientation of the hall.
Frame cart() {
    return {.crs = "cart",
            .base = "map",
            .position = {500, 0, 0},
            .orientation = {0, 0, -90},
            .covariance = {1, 0, 0, 0, 1, 0, 0, 0, 0}};
}

Located entity(std::string crs, std::array<double, 3> position, std::vector<double> orientation, std::vector<double> rows = {}) {
    Located made{.of = "position_data",
                 .ref = "person-1",
                 .crs = std::move(crs),
                 .position = position,
                 .orientation = std::move(orientation),
                 .certainty = {}};
    if (!rows.empty()) made.certainty = Located::Covariance{std::move(rows)};
    return made;
}

Located changed(Frames const& frames, Located located, std::string_view to) {
    EXPECT_EQ(frames.change(located, to).value_or("fine"), "fine");
    return located;
}

std::vector<double> rows(Located const& located) { return std::get<Located::Covariance>(located.certainty).rows; }

std::string text_in(Frames const& frames, std::string text, std::string from, std::string_view to) {
    auto parameter = positions("target_position", {std::move(text)}, std::move(from));
    frames.change(parameter, to, Frames::Rounding::thousandth);
    EXPECT_EQ(parameter.data_type_ref.codebook_ref, to);
    return parameter.values.front();
}

// The names of the frames in `others`, in order.
std::vector<std::string> others_of(Frames const& frames) {
    std::vector<std::string> names;
    for (auto const& frame : frames.others()) names.push_back(frame.crs);
    return names;
}

std::string complaint(std::vector<Frame> others, std::string own = "hall") {
    try {
        Frames const frames{std::move(own), std::move(others)};
        return "fine";
    } catch (std::invalid_argument const& error) {
        return error.what();
    }
}

}  // namespace

// 3000 mm along the map's x axis: (1000 - 0, 2000 + 3000); 30 + 90 degrees.
TEST(Frames, ConvertTexts) {
    Frames const frames{"hall", {map()}};
    EXPECT_EQ(text_in(frames, "3000, 0, 30", "map", "hall"), "1000, 5000, 120");
    EXPECT_EQ(text_in(frames, "3000,0", "MAP", "hall"), "1000, 5000");
    EXPECT_EQ(text_in(frames, "1000, 5000, 120", "hall", "map"), "3000, 0, 30");
    EXPECT_EQ(text_in(frames, "0, 0, 180", "map", "hall"), "1000, 2000, -90") << "angles are in (-180, 180]";
    EXPECT_EQ(text_in(frames, "desk", "map", "hall"), "desk") << "a name is not a point";
}

TEST(Frames, LeavePositionsInUnknownFramesUnchanged) {
    Frames const frames{"hall", {map()}};
    auto parameter = positions("target_position", {"1, 2"}, "street");
    frames.change(parameter, "hall", Frames::Rounding::thousandth);
    EXPECT_EQ(parameter, positions("target_position", {"1, 2"}, "street"));
    auto const there = entity("street", {1, 2, 3}, {});
    EXPECT_EQ(changed(frames, there, "hall"), there);
    EXPECT_EQ(changed(Frames{}, there, ""), there);
}

TEST(Frames, TurnACovarianceWithThePosition) {
    Frames const frames{"hall", {map()}};
    auto const there = changed(frames, entity("map", {3'000, 0, 1'700}, {0, 0, 30}, {100, 7, 1, 7, 400, 2, 1, 2, 9}), "hall");
    EXPECT_EQ(there.crs, "hall");
    EXPECT_THAT(there.position, ElementsAre(1'000, 5'000, 1'700));
    EXPECT_THAT(there.orientation, ElementsAre(0, 0, 120));
    // x' = -y, y' = x: var x' = 400, var y' = 100, cov(x', y') = -7, cov(x', yaw) = -2, cov(y', yaw) = 1.
    EXPECT_THAT(rows(there), ElementsAre(400, -7, -2, -7, 100, 1, -2, 1, 9));
}

// The map is uncertain by 2 degrees. A degree moves a point that is 3000 mm away by 3000 * pi / 180 = 52.35988 mm, along the
// hall's x axis, backwards. var x = 400 + 100 + 52.35988^2 * 4 = 11466.227; var y = 100 + 100; cov(x, yaw) = -52.35988 * 4 =
// -209.440; var yaw = 9 + 4.
TEST(Frames, AddTheUncertaintyOfTheirPlacement) {
    Frames const frames{"hall", {uncertain_map()}};
    auto const there = changed(frames, entity("map", {3'000, 0, 0}, {0, 0, 30}, {100, 0, 0, 0, 400, 0, 0, 0, 9}), "hall");
    EXPECT_THAT(rows(there), ElementsAre(11'466.227, 0, -209.44, 0, 200, 0, -209.44, 0, 13));
}

// The inverse: x' = y, y' = -x. If the map turns to the left, the point moves to the right, as seen from the map: -52.35988 mm a
// degree along its y axis, and -1 degree. var x' = 100 + 100; var y' = 400 + 100 + 10966.227; cov(y', yaw') = +209.440.
TEST(Frames, AddTheUncertaintyOfTheirPlacementInBothDirections) {
    Frames const frames{"hall", {uncertain_map()}};
    auto const there = changed(frames, entity("hall", {1'000, 5'000, 0}, {0, 0, 120}, {400, 0, 0, 0, 100, 0, 0, 0, 9}), "map");
    EXPECT_THAT(there.position, ElementsAre(3'000, 0, 0));
    EXPECT_THAT(there.orientation, ElementsAre(0, 0, 30));
    EXPECT_THAT(rows(there), ElementsAre(200, 0, 0, 0, 11'466.227, 209.44, 0, 209.44, 13));
}

// (10, 20) in the cart is (500 + 20, 0 - 10) in the map, and (1000 + 10, 2000 + 520) in the hall.
TEST(Frames, MayBePlacedInOneAnother) {
    Frames const frames{"hall", {cart(), uncertain_map()}};
    EXPECT_EQ(text_in(frames, "10, 20, 5", "cart", "map"), "520, -10, -85");
    EXPECT_EQ(text_in(frames, "10, 20, 5", "cart", "hall"), "1010, 2520, 5");
    EXPECT_EQ(text_in(frames, "1010, 2520, 5", "hall", "cart"), "10, 20, 5");
    EXPECT_THAT(rows(changed(frames, entity("cart", {10, 20, 0}, {}, {4, 0, 0, 9}), "map")), ElementsAre(10, 0, 0, 5))
        << "the uncertainty of the map's placement does not matter within it";
    EXPECT_THAT(frames.names(), ElementsAre("hall", "cart", "map"));
}

// Rolled by 90 degrees about x: (x, y, z) is (x, -z, y) in the hall, plus the origin (10, 20, 30). A body pitched by 30 degrees
// has the axes of Rx(90) Ry(30) there, which are those of Rz(30) Rx(90): roll 90, pitch 0, yaw 30.
TEST(Frames, MayBeTiltedInSpace) {
    Frames const frames{"hall",
                        {{.crs = "wall", .base = "hall", .position = {10, 20, 30}, .orientation = {90, 0, 0}, .covariance = {}}}};
    auto const there = changed(frames, entity("wall", {1, 2, 3}, {0, 30, 0}), "hall");
    EXPECT_THAT(there.position, ElementsAre(11, 17, 32));
    EXPECT_THAT(there.orientation, ElementsAre(DoubleNear(90, 1e-9), DoubleNear(0, 1e-9), DoubleNear(30, 1e-9)));
    EXPECT_EQ(changed(frames, there, "wall"), entity("wall", {1, 2, 3}, {0, 30, 0}));
    // y' = -z and z' = y exchange their variances. A small pitch in it is a yaw in the hall, and a small yaw an inverse pitch.
    std::vector<double> all(36, 0.0);
    for (std::size_t i = 0; i < 6; ++i) all[i * 7] = static_cast<double>(i + 1);
    std::vector<double> expected(36, 0.0);
    for (std::size_t i = 0; i < 6; ++i) expected[i * 7] = std::vector<double>{1, 3, 2, 4, 6, 5}[i];
    EXPECT_THAT(rows(changed(frames, entity("wall", {1, 2, 3}, {0, 0, 0}, all), "hall")), ElementsAreArray(expected));
}

TEST(Frames, ConversionKeepsTheDimensionsOfACovariance) {
    Frames const frames{"hall", {map()}};
    EXPECT_THAT(rows(changed(frames, entity("map", {0, 0, 0}, {}, {1, 0, 0, 2}), "hall")), ElementsAre(2, 0, 0, 1)) << "x, y";
    EXPECT_THAT(rows(changed(frames, entity("map", {0, 0, 0}, {}, {1, 0, 0, 0, 2, 0, 0, 0, 3}), "hall")),
                ElementsAre(2, 0, 0, 0, 1, 0, 0, 0, 3))
        << "x, y, z";
    EXPECT_THAT(
        rows(changed(frames, entity("map", {0, 0, 0}, {0, 0, 0}, {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4}), "hall")),
        ElementsAre(2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4))
        << "x, y, z, yaw";
}

TEST(Frames, LeaveAReliabilityUnchanged) {
    Frames const frames{"hall", {uncertain_map()}};
    auto sure = entity("map", {0, 0, 0}, {});
    sure.certainty = Located::Reliability{0.9};
    EXPECT_EQ(changed(frames, sure, "hall").certainty, sure.certainty);
}

TEST(Frames, RefuseAnInvalidCovarianceOrOrientation) {
    Frames const frames{"hall", {map()}};
    auto refusal = [&](Located located) { return frames.change(located, "hall").value_or("fine"); };
    EXPECT_EQ(refusal(entity("map", {0, 0, 0}, {}, {1, 2, 3, 4, 5})),
              "the position of 'person-1' has a covariance of 5 numbers without an orientation");
    EXPECT_EQ(refusal(entity("map", {0, 0, 0}, {}, std::vector<double>(36, 0.0))),
              "the position of 'person-1' has a covariance of 36 numbers without an orientation");
    EXPECT_EQ(refusal(entity("map", {0, 0, 0}, {1, 2})), "the position of 'person-1' has an orientation of 2 numbers");
    EXPECT_EQ(refusal(entity("hall", {0, 0, 0}, {1, 2})), "fine") << "it is not converted";
}

// Rounding to a thousandth must not make a covariance invalid whose ellipse is a line.
TEST(Frames, KeepACovarianceValidWhenRounding) {
    for (int degrees = 1; degrees < 180; ++degrees) {
        Frames const frames{"hall", {{.crs = "map", .base = "hall", .orientation = {0, 0, degrees * 1.0}, .covariance = {}}}};
        auto const there = rows(changed(frames, entity("map", {0, 0, 0}, {}, {1, 0, 0, 0}), "hall"));
        EXPECT_GE(there[0] * there[3] - there[1] * there[2], -1e-9) << degrees;
    }
}

TEST(Frames, ConvertBackToTheTextThatAnApplicationWrote) {
    Frames const frames{
        "hall", {{.crs = "map", .base = "hall", .position = {123.4, -56.7, 0}, .orientation = {0, 0, 33.3}, .covariance = {}}}};
    for (auto const* text : {"9500, 6000, 90", "0.125, -7, -179.5", "1, 2"}) {
        auto parameter = positions("target_position", {text}, "hall");
        frames.change(parameter, "map", Frames::Rounding::millionth);
        EXPECT_NE(parameter.values.front(), text);
        frames.change(parameter, "hall", Frames::Rounding::thousandth);
        EXPECT_EQ(parameter.values.front(), text);
    }
}

TEST(Frames, ConvertPointsButNotBoxes) {
    Frames const frames{"hall", {map()}};
    Geometry const spot{.crs = "map", .low = {3'000, 0, 0}, .high = {3'000, 0, 0}, .dimensions = 2};
    Geometry const there{.crs = "hall", .low = {1'000, 5'000, 0}, .high = {1'000, 5'000, 0}, .dimensions = 2};
    EXPECT_EQ(frames.moved(spot, "hall"), there);
    auto box = spot;
    box.high = {4'000, 100, 0};
    EXPECT_FALSE(frames.moved(box, "hall"));
    EXPECT_FALSE(frames.moved(spot, "street"));
}

TEST(Frames, MustBePlaced) {
    EXPECT_EQ(complaint({map(), cart()}), "fine");
    EXPECT_EQ(complaint({cart()}), "the frame 'cart' is placed in 'map', which is unknown; expected one of hall, cart");
    EXPECT_EQ(complaint({map(), map()}), "the frame 'map' is given twice");
    auto hall = map();
    hall.crs = "HALL";
    EXPECT_EQ(complaint({hall}), "the frame 'HALL' is given twice");
    auto round = map();
    round.base = "cart";
    EXPECT_THAT(complaint({round, cart()}), HasSubstr("is placed in itself"));
    EXPECT_THAT(complaint({map()}, ""), HasSubstr("no name"));
}

TEST(Frames, MustHaveAValidPlacement) {
    auto const with = [](std::vector<double> covariance) { return complaint({map(std::move(covariance))}); };
    EXPECT_THAT(with({1, 2, 3}), HasSubstr("has 3 numbers; expected are 9 (x, y, yaw) or 36"));
    EXPECT_THAT(with({1, 5, 0, 0, 1, 0, 0, 0, 1}), HasSubstr("is not symmetric"));
    EXPECT_THAT(with({1, 0, 0, 0, -1, 0, 0, 0, 1}), HasSubstr("is not positive semi-definite"));
    EXPECT_THAT(with({1, 0, 0, 0, HUGE_VAL, 0, 0, 0, 1}), HasSubstr("is not finite"));
    auto nowhere = map();
    nowhere.position[0] = NAN;
    EXPECT_THAT(complaint({nowhere}), HasSubstr("the frame 'map': its position or orientation is not finite"));
}

TEST(Frames, AreListedAfterTheFrameThatTheyArePlacedIn) {
    Frames const frames{"hall", {cart(), map()}};
    EXPECT_THAT(others_of(frames), ElementsAre("map", "cart"));
}

TEST(Frames, AreIncludedOneByOne) {
    Frames frames{"hall"};
    EXPECT_EQ(frames.include(cart()), "the frame 'cart' is placed in 'map', which is unknown");
    EXPECT_EQ(frames.include(map()), std::nullopt);
    EXPECT_EQ(frames.include(cart()), std::nullopt);
    EXPECT_EQ(frames.include(map()), "the frame 'map' is given twice");
    EXPECT_THAT(others_of(frames), ElementsAre("map", "cart"));
}

}  // namespace rois
