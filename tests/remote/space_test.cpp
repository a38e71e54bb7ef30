// The frames and named places of a sub engine, in the main engine.
#include "engine/conditions/conditions.hpp"
#include "remote/two_engines.hpp"

namespace rois {

namespace {

using testing::AllOf;
using testing::Contains;

constexpr auto floor_here = "urn:x:def:crs:map::hall.floor";
constexpr auto cart_here = "urn:x:def:crs:map::hall.cart";

// The place `lab` is a box from (0, 0) to (1000, 1000). The origin of the frame `floor` is at (2000, 0), and its x axis is the y
// axis of the hall. The frame `cart` is 500 mm along it, and has the orientation of the hall.
Places of_hall() {
    Frame const floor{.crs = "urn:x:def:crs:map::floor",
                      .base = "crs1",
                      .position = {2'000, 0, 0},
                      .orientation = {0, 0, 90},
                      .covariance = {}};
    Frame const cart{.crs = "urn:x:def:crs:map::cart",
                     .base = "urn:x:def:crs:map::floor",
                     .position = {500, 0, 0},
                     .orientation = {0, 0, -90},
                     .covariance = {}};
    return {.frames = {"crs1", {cart, floor}}, .all = {{"lab", box(0, 0, 1'000, 1'000, "crs1")}}};
}

// (x, y) in the hall is (1000 - y, x) in the main engine.
remote::SubEngine placed() {
    auto settings = TwoEngines::hall_settings();
    settings.placement = {.position = {1'000, 0, 0}, .orientation = {0, 0, 90}, .covariance = {}};
    return settings;
}

Part driver() {
    auto part = navigation;
    part.crs = "crs1";
    part.positions = {"target_position"};
    ParameterProfile const landmarks{
        .name = "landmarks", .data_type_ref = {.code = "string[]"}, .default_value = {}, .description = {}};
    part.profile.messages.push_back(
        {.kind = MessageKind::query, .name = "get_parameter", .results = {landmarks}, .arguments = {}, .timeout = {}});
    return part;
}

struct ASubEngineWithASpace : testing::Test {
    std::unique_ptr<TwoEngines> engines;
    std::optional<Application> desk;

    void begin(remote::SubEngine const& settings = placed(), std::vector<NamedPlace> const& places_of_main = {}) {
        engines = std::make_unique<TwoEngines>(std::vector{driver(), in_engine("robot2", driver())}, settings, of_hall(),
                                               places_of_main);
        desk = engines->main.connect();
    }
    // The robot's position, in the hall.
    void is_at(double x, double y) {
        auto& robot = engines->hall["navigation"];
        robot.where = Located{};
        robot.where->of = "robot";
        robot.where->ref = "robot1";
        robot.where->crs = "crs1";
        robot.where->position = {x, y, 0};
        engines->hall.connect();  // the engine looks
        engines->advance(500ms);
    }
    std::vector<std::string> target(std::string const& ref, std::string const& text, std::string const& crs = "") {
        engines->bind(*desk, "hall." + ref);
        auto const reply = engines->execute(*desk, start("hall." + ref, {positions("target_position", {text}, crs)}));
        if (reply.return_code != ReturnCode::ok) return {reply.reason};
        engines->advance(100ms);
        return find(engines->hall[ref].started_with, "target_position")->values;
    }
    std::string reason(Condition condition) { return desk->ask(Search{std::move(condition)}).reason; }
    void falsify(std::function<void(Space&)> const& change) {
        engines->falsify = [change](Reply& reply) {
            if (auto* profile = std::get_if<GetProfile::Reply>(&reply)) change(profile->space);
        };
        engines->hall.change({}, {detection});
        engines->advance(2s);
    }
};

}  // namespace

TEST_F(ASubEngineWithASpace, GivesConditionsItsPlacesWithItsName) {
    begin();
    is_at(200, 700);
    EXPECT_THAT(desk->search(within("location", {Literal{"hall.lab"}})), ElementsAre("hall.navigation"));
    EXPECT_THAT(desk->search(equal("location", "hall.lab")), ElementsAre("hall.navigation"));
    is_at(200, 1'700);
    EXPECT_THAT(desk->search(within("location", {Literal{"hall.lab"}})), IsEmpty());
    EXPECT_THAT(desk->search(equal("location", "hall.lab")), IsEmpty());
    EXPECT_THAT(reason(within("location", {Literal{"lab"}})), HasSubstr("expected one of 'hall.lab'"));
}

TEST_F(ASubEngineWithASpace, HidesItsSpaceFromClientsThatSeeNoneOfItsComponents) {
    begin();
    auto const with_pattern = [&](std::string const& pattern) {
        std::vector<std::string> const patterns{pattern};
        return engines->main.connect_as(std::make_shared<Rights const>("desk", patterns, patterns),
                                        {.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = true});
    };
    auto of_hall = with_pattern("hall.*"), other = with_pattern("room.*");
    auto const answer = [](Application& client, Expression const& where) {
        return client.ask(Search{within("location", where)});
    };
    for (auto const& where : {Expression{Literal{"hall.lab"}}, Expression{spot(0, 0, floor_here)}}) {
        EXPECT_EQ(answer(of_hall, where).return_code, ReturnCode::ok);
        EXPECT_EQ(answer(other, where).return_code, ReturnCode::bad_parameter);
    }
    for (auto const& where : {Expression{Literal{"nowhere"}}, Expression{spot(0, 0, "nowhere")}}) {
        EXPECT_THAT(answer(of_hall, where).reason, HasSubstr("hall."));
        EXPECT_THAT(answer(other, where).reason, testing::Not(HasSubstr("hall.")));
    }
    EXPECT_FALSE(of_hall.ask(GetProfile{}).space.places.empty());
    EXPECT_EQ(other.ask(GetProfile{}).space, Space{});
}

// The hall has a sub engine `robot2`.
TEST_F(ASubEngineWithASpace, HidesTheSpaceOfAnEngineOfWhichTheClientSeesNoComponent) {
    begin();
    Belongings of_robot{
        .profiles = {},
        .frames = {{.crs = "urn:x:def:crs:map::robot2.own", .base = "crs1", .position = {}, .orientation = {}, .covariance = {}}},
        .places = {{"robot2.lab", box(5'000, 0, 6'000, 1'000, "crs1")}}};
    of_robot.engines["robot2"];
    engines->hall.engine->change({{}, {}, std::move(of_robot), "robot2"}, engines->hall.now);
    engines->hall.change({}, {detection});
    engines->advance(2s);
    auto const seen_by = [&](std::string const& pattern) {
        std::vector<std::string> const patterns{pattern};
        auto client = engines->main.connect_as(std::make_shared<Rights const>("desk", patterns, patterns));
        std::string reasons;
        for (auto const& where : {Expression{Literal{"nowhere"}}, Expression{spot(0, 0, "nowhere")}})
            reasons += client.ask(Search{within("location", where)}).reason;
        return reasons;
    };
    EXPECT_THAT(seen_by("hall.robot2.*"), AllOf(HasSubstr("hall.robot2.lab"), HasSubstr("hall.robot2.own")));
    EXPECT_THAT(seen_by("hall.navigation"), AllOf(HasSubstr("hall.lab"), testing::Not(HasSubstr("robot2"))));
}

TEST_F(ASubEngineWithASpace, GivesConditionsItsPlacesAlsoWithoutAPlacement) {
    begin(TwoEngines::hall_settings());
    is_at(200, 700);
    EXPECT_THAT(desk->search(within("location", {Literal{"hall.lab"}})), ElementsAre("hall.navigation"));
    EXPECT_THAT(reason(within("location", {spot(0, 0, floor_here)})), HasSubstr("not known"));
    EXPECT_THAT(engines->reported, Contains(HasSubstr("which is unknown, and 1 more"))) << "the frames have no position here";
}

TEST_F(ASubEngineWithASpace, TakesItsPlacesWithAndWithoutItsName) {
    begin();
    EXPECT_THAT(target("navigation", "hall.lab"), ElementsAre("lab"));
    EXPECT_THAT(target("navigation", "lab"), ElementsAre("lab"));
    EXPECT_THAT(target("robot2.navigation", "hall.lab"), ElementsAre("lab"));
    EXPECT_THAT(target("navigation", "hall.nowhere"), ElementsAre("hall.nowhere"));
}

// The hall has a sub engine `robot2`, which has its own place `lab`.
TEST_F(ASubEngineWithASpace, TakesOnlyPlacesOfTheEngineOfTheComponent) {
    begin();
    Belongings of_robot{.profiles = {}, .frames = {}, .places = {{"robot2.lab", box(5'000, 0, 6'000, 1'000, "crs1")}}};
    engines->hall.engine->change({{}, {}, std::move(of_robot), "robot2"}, engines->hall.now);
    engines->hall.change({}, {detection});
    engines->advance(2s);
    EXPECT_THAT(target("robot2.navigation", "hall.robot2.lab"), ElementsAre("robot2.lab"));
    EXPECT_THAT(target("robot2.navigation", "hall.lab"), ElementsAre("hall.lab")) << "not the place `lab` of robot2";
}

TEST_F(ASubEngineWithASpace, HasItsFramesAtAllDepths) {
    begin();
    EXPECT_THAT(target("navigation", "100, 0", "hall.crs1"), ElementsAre("100, 0"));
    EXPECT_THAT(target("navigation", "100, 0", floor_here), ElementsAre("2000, 100"));
    EXPECT_THAT(target("navigation", "100, 0", cart_here), ElementsAre("2100, 500"));
    EXPECT_THAT(target("navigation", "500, 2100", "here"), ElementsAre("2100, 500"));
    is_at(2'100, 500);
    EXPECT_THAT(desk->search(near("location", {spot(100, 0, cart_here)}, 1)), ElementsAre("hall.navigation"));
    EXPECT_THAT(reason(within("location", {spot(0, 0, "urn:x:def:crs:map::cart")})), HasSubstr(cart_here));
}

// The frame of a sub engine of the sub engine.
TEST_F(ASubEngineWithASpace, HasKnownFramesInItsProfile) {
    begin();
    auto const crs = [](std::string value) {
        return ParameterProfile{
            .name = "crs", .data_type_ref = {.code = "string"}, .default_value = std::move(value), .description = {}};
    };
    Belongings of_robot;
    of_robot.engines["robot2"] = {crs("urn:x:def:crs:map::floor")};
    engines->hall.engine->change({{}, {}, std::move(of_robot), "robot2"}, engines->hall.now);
    engines->advance(2s);
    auto const profile = desk->ask(GetProfile{}).profile;
    auto const& hall = profile->sub_profiles.at(0);
    EXPECT_EQ(find_parameter(hall.parameters, "crs")->default_value, "hall.crs1");
    EXPECT_EQ(find_parameter(hall.sub_profiles.at(0).parameters, "crs")->default_value, floor_here);
}

TEST_F(ASubEngineWithASpace, HasItsParametersInOurFrame) {
    begin();
    engines->hall["navigation"].reads = ParameterList{positions("landmarks", {"0, 100"}, "crs1")};
    is_at(0, 0);
    engines->bind(*desk, "hall.navigation");
    auto const parameters = desk->get_parameter("hall.navigation").parameters;
    ASSERT_NE(find(parameters, "landmarks"), nullptr);
    EXPECT_THAT(find(parameters, "landmarks")->values, ElementsAre("900, 0"));
    EXPECT_EQ(find(parameters, "landmarks")->data_type_ref.codebook_ref, "here");
}

TEST_F(ASubEngineWithASpace, TakesItAlong) {
    begin();
    auto const at_the_lab = within("location", {Literal{"hall.lab"}});
    auto const on_the_cart = near("location", {spot(0, 0, cart_here)}, 1);
    engines->cut();
    engines->advance(31s);
    EXPECT_NE(reason(at_the_lab), "");
    EXPECT_NE(reason(on_the_cart), "");
    engines->repair();
    engines->advance(31s);
    EXPECT_EQ(reason(at_the_lab), "");
    EXPECT_EQ(reason(on_the_cart), "");
}

TEST_F(ASubEngineWithASpace, MayChangeIt) {
    begin();
    Belongings lift;
    lift.places = {{"lift", box(0, 0, 1, 1, "crs1")}};
    engines->hall.engine->change({{}, {}, std::move(lift), "building"}, engines->hall.now);
    engines->advance(2s);
    EXPECT_EQ(reason(within("location", {Literal{"hall.lift"}})), "");
    EXPECT_THAT(engines->reported, testing::Not(Contains(HasSubstr("left out"))));
}

TEST_F(ASubEngineWithASpace, LeavesOutNamesThatAreTaken) {
    begin(placed(), {{"hall.lab", box(0, 0, 1, 1, "here")}});
    EXPECT_THAT(desk->search(), Contains("hall.navigation"));
    EXPECT_THAT(engines->reported, Contains("left out: there are two places with the name 'hall.lab'"));
    is_at(200, 700);
    EXPECT_THAT(desk->search(within("location", {Literal{"hall.lab"}})), IsEmpty()) << "the place of the main engine";
}

TEST_F(ASubEngineWithASpace, LeavesOutWhatIsInvalid) {
    begin();
    falsify([](Space& space) {
        space.frames[0].position[0] = std::nan("");
        space.places[0].area.high[0] = -1;
        space.places.push_back({std::string(300, 'p'), box(0, 0, 1, 1, "crs1")});
        space.places.push_back({"door", box(0, 0, 1, 1, "crs1")});
        space.places.push_back({"cupboard", box(0, 0, 1, 1, space.frames[0].crs)});
    });
    EXPECT_THAT(desk->search(), Contains("hall.detection"));
    EXPECT_THAT(engines->reported, Contains(HasSubstr("has a name of 300 characters: expected 1 to 251, and 4 more")));
    EXPECT_EQ(reason(within("location", {Literal{"hall.door"}})), "");
    EXPECT_THAT(reason(within("location", {Literal{"hall.cupboard"}})), HasSubstr("expected one of 'hall.door'"));
}

TEST_F(ASubEngineWithASpace, HasAtMost500PlacesHere) {
    begin();
    falsify([](Space& space) {
        for (int i = 0; i < 600; ++i) space.places.push_back({"place" + std::to_string(i), box(0, 0, 1, 1, "crs1")});
    });
    EXPECT_THAT(engines->reported, Contains("left out: it has 601 places: expected at most 500"));
    EXPECT_EQ(reason(within("location", {Literal{"hall.place1"}})), "");
}

}  // namespace rois
