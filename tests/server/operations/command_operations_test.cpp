// Command interface (table 3): search, bind, bind_any, release, get_parameter, set_parameter.
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Pair;
using testing::SizeIs;

constexpr auto navigation_type = "urn:x-rois:def:component:OMG::Navigation";

struct CommandOperations : Conversation {
    Application rival{GetParam(), empty_hall()};
    CommandOperations() { rival.connect(); }

    Document bind_any(Application& application, Xml const& filter = {}) {
        return application.ask("bind_any", filter.empty() ? Xml{} : where(filter));
    }
};
ROIS_OVER_BOTH_WAYS(CommandOperations);

TEST_P(CommandOperations, SearchFindsAll) {
    auto const answer = desk.ask("search");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("component_ref_list"));
    EXPECT_THAT(desk.search(), SizeIs(15));
}

TEST_P(CommandOperations, SearchFindsComponentsThatSatisfyTheCondition) {
    EXPECT_THAT(desk.search(where(equal("component_ref", "navigation"))), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(where(literal_first("navigation", "component_ref"))), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(where(equal("component_type", navigation_type))), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(where(literal_first("URN:X-ROIS:DEF:COMPONENT:OMG::NAVIGATION", "component_type"))),
                ElementsAre("navigation"));
    EXPECT_THAT(desk.search(where(equal("name", "move"))), ElementsAre("move"));
    EXPECT_THAT(desk.search(where(either(equal("name", "move"), literal_first("follow", "component_ref")))),
                ElementsAre("follow", "move"));
    EXPECT_THAT(desk.search(where(both(equal("name", "move"), equal("component_type", navigation_type)))), IsEmpty());
    EXPECT_THAT(desk.search(where(both(equal("name", "navigation"), equal("component_type", navigation_type)))),
                ElementsAre("navigation"));
    EXPECT_THAT(desk.search(where(equal("name", "dishwasher"))), IsEmpty());
}

TEST_P(CommandOperations, SearchUsesTheStatusThatTheCallerSees) {
    rival.bind("reaction");
    EXPECT_THAT(desk.search(where(equal("status", "BUSY"))), ElementsAre("reaction"));
    EXPECT_THAT(rival.search(where(equal("status", "BUSY"))), IsEmpty());
    EXPECT_THAT(rival.search(where(both(equal("status", "READY"), literal_first("reaction", "name")))), ElementsAre("reaction"));
}

TEST_P(CommandOperations, SearchRefusesAnInvalidCondition) {
    EXPECT_THAT(desk.ask("search", where(undefined_function("name"))), IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(desk.ask("search", where(both(equal("name", "move"), undefined_function("name")))),
                IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(desk.ask("search", where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
}

TEST_P(CommandOperations, BindIsExclusive) {
    auto const answer = desk.bind("navigation");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), IsEmpty());
    EXPECT_THAT(desk.bind("navigation"), IsOk()) << "mine already";
    EXPECT_THAT(rival.bind("navigation"), IsRefused("OUT_OF_RESOURCES", "navigation"));
    desk.release("navigation");
    EXPECT_THAT(rival.bind("navigation"), IsOk());
}

TEST_P(CommandOperations, BindRefusesAnUnknownComponent) {
    EXPECT_THAT(desk.bind("dishwasher"), IsRefused("BAD_PARAMETER", "dishwasher"));
}

TEST_P(CommandOperations, BindAnyTakesTheLowestFreeMatch) {
    auto const any = either(equal("name", "navigation"), equal("name", "move"));
    auto const answer = bind_any(desk, any);
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("component_ref"));
    EXPECT_EQ(answer.ref(), "move");
    EXPECT_EQ(bind_any(rival, any).ref(), "navigation");
    EXPECT_EQ(bind_any(desk, any).ref(), "move") << "none is free, one is mine";
    EXPECT_EQ(bind_any(desk).ref(), "face_detection") << "without a condition";
}

TEST_P(CommandOperations, BindAnyWhenAllMatchesAreTaken) {
    rival.bind("navigation");
    EXPECT_THAT(bind_any(desk, equal("component_type", navigation_type)), IsRefused("OUT_OF_RESOURCES", "free"));
}

TEST_P(CommandOperations, BindAnyRefusesAConditionWithoutMatches) {
    EXPECT_THAT(bind_any(desk, equal("name", "dishwasher")), IsRefused("UNSUPPORTED", "match"));
    EXPECT_THAT(bind_any(desk, undefined_function("name")), IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(bind_any(desk, equal("colour", "red")), IsRefused("BAD_PARAMETER", "colour"));
}

TEST_P(CommandOperations, ReleaseRefusesComponentsOfOtherSessions) {
    desk.bind("navigation");
    EXPECT_THAT(rival.release("navigation"), IsOk()) << "nothing to do";
    EXPECT_THAT(rival.bind("navigation"), IsRefused("OUT_OF_RESOURCES", "navigation")) << "still bound";
    auto const answer = desk.release("navigation");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), IsEmpty());
    EXPECT_THAT(desk.get_parameter("navigation"), IsRefused("ERROR", "not bound"));
    EXPECT_THAT(desk.release("dishwasher"), IsRefused("BAD_PARAMETER", "dishwasher"));
}

TEST_P(CommandOperations, GetParameterReturnsTheSetValues) {
    desk.bind("navigation");
    desk.set_parameter("navigation", {time_limit("4000"), {"Routing_Policy", "String", {"distance"}}});
    auto const answer = desk.get_parameter("navigation");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("parameters"));
    auto const values = answer.values("parameters");
    EXPECT_THAT(values, Contains(Pair("time_limit", ElementsAre("4000"))));
    EXPECT_THAT(values, Contains(Pair("routing_policy", ElementsAre("distance"))));
}

TEST_P(CommandOperations, GetParameterNeedsTheBinding) {
    EXPECT_THAT(desk.get_parameter("navigation"), IsRefused("ERROR", "not bound"));
    EXPECT_THAT(desk.get_parameter("dishwasher"), IsRefused("BAD_PARAMETER", "dishwasher"));
}

TEST_P(CommandOperations, SetParameterStoresAndCompletes) {
    desk.bind("navigation");
    auto const answer = desk.set_parameter("navigation", {target_position({"7000, 6000, 0", "desk"})});
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("command_id"));
    EXPECT_EQ(desk.status_of(answer.text("command_id")), "OK");
    EXPECT_THAT(desk.get_parameter("navigation").values("parameters"),
                Contains(Pair("target_position", ElementsAre("7000, 6000, 0", "desk"))));
}

TEST_P(CommandOperations, ParametersEndWithTheirBinding) {
    auto const defaults = desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values();
    EXPECT_EQ(defaults.count("speech_text"), 0u);
    for (auto const* end : {"release", "disconnect"}) {
        for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) desk.bind(ref);
        desk.set_parameter("speech_synthesis", {speech_text("a secret"), {"volume", "int", {"7"}}});
        desk.set_parameter("navigation", {target_position({"desk"})});
        desk.set_parameter("move", {{"line", "int[]", {"1000 0"}}});
        desk.set_parameter("reaction", {{"reaction_ref", "RoISIdentifier", {"1"}}});
        EXPECT_THAT(desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values(),
                    Contains(Pair("speech_text", ElementsAre("a secret"))));
        EXPECT_EQ(rival.query("get_parameter", where(equal("name", "speech_synthesis"))).values(), defaults);
        EXPECT_THAT(rival.search(where(equal("Property/speech_text", "a secret"))), IsEmpty());
        if (std::string{end} == "disconnect") {
            desk.disconnect();
            desk.connect();
        } else {
            for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) desk.release(ref);
        }
        for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) {
            rival.bind(ref);
            EXPECT_THAT(rival.execute(Command{.component = ref}), IsRefused("BAD_PARAMETER", "command_unit_list[1]")) << ref;
            rival.release(ref);
        }
        EXPECT_EQ(desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values(), defaults) << end;
    }
}

TEST_P(CommandOperations, SetParameterTakesThePublishedSpellings) {
    desk.bind("navigation");
    EXPECT_THAT(desk.set_parameter("navigation", {{"target_positions", "string[]", {"start"}}}), IsOk());
    EXPECT_THAT(desk.get_parameter("navigation").values("parameters"), Contains(Pair("target_position", ElementsAre("start"))));
}

TEST_P(CommandOperations, SetParameterNeedsTheBinding) {
    rival.bind("navigation");
    EXPECT_THAT(desk.set_parameter("navigation", {time_limit("1")}), IsRefused("ERROR", "not bound"));
    EXPECT_THAT(desk.set_parameter("dishwasher", {time_limit("1")}), IsRefused("BAD_PARAMETER", "dishwasher"));
}

TEST_P(CommandOperations, SetParameterRefusesParametersOutsideTheProfile) {
    desk.bind("navigation");
    auto const before = desk.get_parameter("navigation").values("parameters");
    auto const refused = [&](Argument const& argument, std::string const& words) {
        EXPECT_THAT(desk.set_parameter("navigation", {argument}), IsRefused("BAD_PARAMETER", words));
    };
    refused({"colour", "string", {"red"}}, "colour");
    refused(time_limit("soon"), "time_limit");
    refused(time_limit("99999999999"), "time_limit");
    refused({"time_limit", "string", {"1"}}, "time_limit");
    refused({"time_limit", "int", {"1", "2"}}, "time_limit");
    refused({"time_limit", "int", {}}, "time_limit");
    refused({"routing_policy", "string", {"scenic"}}, "routing_policy");
    EXPECT_THAT(desk.set_parameter("navigation", {time_limit("7"), time_limit("8")}), IsRefused("BAD_PARAMETER", "time_limit"));
    EXPECT_EQ(desk.get_parameter("navigation").values("parameters"), before) << "nothing changed";
}

}  // namespace
}  // namespace rois::test
