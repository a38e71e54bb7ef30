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

TEST_F(CostlyConditions, DoNotKeepErrorsAway) {
    hall.subscribe("person_localized", costly(3, "person_ref"));
    hall.ask(Search{costly(20)});
    world["localization"].reports(ErrorType::component_internal_error, "blind");
    EXPECT_THAT(hall.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR localization"));
}

}  // namespace rois
