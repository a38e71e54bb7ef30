// Conditions that cost much: their session waits, and the others do not.
#include "engine/conditions/effort.hpp"

#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

// 100,000 steps in a tenth of a second. Comparing one pattern with the text of `speech`, or with all people of an event, takes
// 80,000 steps.
struct CostlyConditions : testing::Test {
    static EngineSettings settings() {
        EngineSettings settings;
        settings.max_condition_steps = 1'000'000;
        return settings;
    }

    CostlyConditions() {
        desk.bind("speech");
        EXPECT_EQ(desk.set_parameter("speech", {text("speech_text", std::string(10'000, 'x'))}).return_code, ReturnCode::ok);
        desk.received();
    }

    static Condition costly(int patterns, std::string const& path = "Property/speech_text") {
        std::vector<Condition> operands{equal("component_ref", "nobody")};
        for (int i = 0; i < patterns; ++i) operands.push_back(like(path, "*no" + std::to_string(i)));
        return either(std::move(operands));
    }
    void locate_a_crowd() {
        std::vector<std::string> people, positions;
        for (int i = 100; i < 200; ++i) {
            people.push_back(std::string(97, 'x') + std::to_string(i));
            positions.emplace_back("0, 0, 0");
        }
        world["localization"].fires("person_localized",
                                    {value("timestamp", "DateTime", {"2026-11-20T12:00:00Z"}), references("person_ref", people),
                                     rois::positions("position_data", positions, "hall")});
    }

    World world{{detection, localization, speech}, settings()};
    Application desk = world.connect(), hall = world.connect();
};

}  // namespace

TEST_F(CostlyConditions, OfSubscriptionsAreStoredOnlySoFast) {
    world.keep_journal();
    auto stored = world.connect();
    auto const subscribe = [](Application& application, int number) {
        auto const name = std::string(10'000, 'x') + std::to_string(number);
        return application.subscribe("person_localized", either({equal("component_ref", "localization"), equal("name", name)}))
            .return_code;
    };
    for (int i = 0; i < 10; ++i) EXPECT_EQ(subscribe(stored, 1), ReturnCode::ok) << "it is stored once";
    EXPECT_EQ(subscribe(stored, 2), ReturnCode::ok);
    EXPECT_EQ(subscribe(stored, 3), ReturnCode::out_of_resources);
    world.advance(100ms);
    EXPECT_EQ(subscribe(stored, 3), ReturnCode::ok);
}

TEST_F(CostlyConditions, OfRequestsAreRefusedForATenthOfASecond) {
    EXPECT_EQ(desk.ask(Search{costly(1)}).return_code, ReturnCode::ok);
    auto const refused = desk.ask(Search{costly(1)});
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, HasSubstr("need too many comparisons"));
    EXPECT_EQ(desk.ask(BindAny{costly(1)}).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.query("component_status", costly(1)).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.ask(GetProfile{costly(1)}).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(hall.ask(Search{equal("component_ref", "speech")}).return_code, ReturnCode::ok) << "it has its share";
    EXPECT_EQ(desk.ask(Search{}).return_code, ReturnCode::ok) << "nothing is compared";
    world.advance(100ms);
    EXPECT_EQ(desk.ask(Search{costly(1)}).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.ask(Search{costly(20)}).return_code, ReturnCode::out_of_resources) << "also at the first attempt";
    EXPECT_EQ(world.engine->statistics().limits[5].of, "condition_steps");
    EXPECT_EQ(world.engine->statistics().limits[5].reached, 5U);
}

TEST_F(CostlyConditions, OfSubscriptionsMissEventsAndSaySo) {
    EXPECT_EQ(hall.subscribe("person_localized", equal("component_ref", "localization")).return_code, ReturnCode::ok);
    for (int i = 1; i <= 3; ++i)
        EXPECT_EQ(desk.subscribe("person_localized", costly(i, "person_ref")).return_code, ReturnCode::ok);
    world.advance(100ms);
    locate_a_crowd();
    locate_a_crowd();
    EXPECT_THAT(hall.received(), ElementsAre("1 person_localized localization", "2 person_localized localization"));
    EXPECT_THAT(desk.received(), ElementsAre("3 lost 2"));
    EXPECT_EQ(world.engine->statistics().notifications_lost, 2U);
    desk.subscribe("person_localized");
    locate_a_crowd();
    EXPECT_THAT(desk.received(), ElementsAre("4 lost 1", "5 person_localized localization"))
        << "nothing is compared with a subscription without a condition";
}

TEST_F(CostlyConditions, ThatOthersShareArePaidByOneOfThem) {
    auto const shared = either({equal("component_ref", "localization"), costly(1, "person_ref")});
    desk.subscribe("person_localized", shared);
    hall.subscribe("person_localized", shared);
    desk.ask(Search{costly(20)});
    locate_a_crowd();
    EXPECT_THAT(hall.received(), ElementsAre("1 person_localized localization"));
    EXPECT_THAT(desk.received(), ElementsAre("2 person_localized localization"));
}

namespace {

// A polygon like a comb, whose teeth all lie across one another's bounding boxes.
Geometry comb(int teeth, double from) {
    Geometry polygon;
    polygon.shape = Geometry::Shape::polygon;
    auto& border = polygon.paths.emplace_back();
    for (int tooth = 0; tooth < teeth; ++tooth) {
        border.push_back({from + tooth * 10, 0});
        border.push_back({50'000 - from + tooth * 10, 90'000});
    }
    border.insert(border.end(), {{95'000, -10}, {-10, -10}, border.front()});
    polygon.fit_corners();
    return polygon;
}

}  // namespace

TEST_F(CostlyConditions, HaveAreasWhoseEdgesCannotBeToldApart) {
    EXPECT_EQ(desk.ask(Search{within("location", {comb(5, 0)})}).return_code, ReturnCode::ok);
    world.advance(100ms);
    EXPECT_EQ(desk.ask(Search{within("location", {comb(100, 0)})}).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.query("component_status", within("location", {comb(100, 0)})).return_code, ReturnCode::out_of_resources);
    world.advance(100ms);
    EXPECT_EQ(desk.ask(Search{spatial(SpatialRelation::intersects, {{comb(6, 0)}, {comb(6, 50'000)}})}).return_code,
              ReturnCode::out_of_resources)
        << "valid, but too much to compare";
}

TEST_F(CostlyConditions, CountHolesTypesAndSortKeys) {
    auto ring = [](double x) { return Geometry::Points{{x, 1}, {x, 2}, {x + 1, 2}, {x + 1, 1}, {x, 1}}; };
    Geometry holes;
    holes.shape = Geometry::Shape::polygon;
    holes.paths.push_back({{0, 0}, {0, 9}, {9'999, 9}, {9'999, 0}, {0, 0}});
    for (int hole = 0; hole < 256; ++hole) holes.paths.push_back(ring(10 + 2 * hole));
    holes.fit_corners();
    ComponentGroup types;
    for (int type = 0; type < 256; ++type) types.types.push_back("type" + std::to_string(type));
    QueryExpression keys;
    for (int key = 0; key < 257; ++key) keys.sort_by.push_back({reference("component_type"), SortOrder::ascending});
    for (auto const& [query, what] : {std::pair{QueryExpression{within("location", {holes})}, "as does a hole"},
                                      {QueryExpression{Condition{types}}, "each type and each alias counts as one"},
                                      {keys, "more than 256 sort keys"}}) {
        auto const refused = desk.ask(Search{query});
        EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
        EXPECT_THAT(refused.reason, HasSubstr(what));
    }
}

TEST_F(CostlyConditions, AreGroupsOfManyTypes) {
    ComponentGroup types;
    for (int type = 0; type < 200; ++type) types.types.push_back("type" + std::to_string(type));
    auto reply = desk.ask(Search{Condition{types}});
    for (int i = 0; i < 10 && reply.return_code == ReturnCode::ok; ++i) reply = desk.ask(Search{Condition{types}});
    EXPECT_EQ(reply.return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(hall.ask(Search{equal("component_ref", "speech")}).return_code, ReturnCode::ok) << "it has its share";
}

// Each of many subscriptions to one event receives it.
TEST_F(CostlyConditions, AreManySubscriptionsToOneEvent) {
    constexpr int many = 5'000;
    hall.subscribe("person_localized", equal("component_ref", "localization"));
    for (int i = 0; i < many; ++i) {
        EXPECT_EQ(desk.subscribe("person_localized", not_equal("component_ref", "x" + std::to_string(i))).return_code,
                  ReturnCode::ok);
        if (i % 50 == 0) world.advance(100ms);
    }
    world.advance(100ms);
    locate_a_crowd();
    EXPECT_THAT(hall.received(), ElementsAre("1 person_localized localization"));
    auto const received = desk.received();
    EXPECT_LT(received.size(), many);
    EXPECT_THAT(received.back(), HasSubstr(" lost 1"));
}

TEST_F(CostlyConditions, DoNotKeepErrorsAway) {
    hall.subscribe("person_localized", costly(3, "person_ref"));
    hall.ask(Search{costly(20)});
    world["localization"].reports(ErrorType::component_internal_error, "blind");
    EXPECT_THAT(hall.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR localization"));
}

}  // namespace rois
