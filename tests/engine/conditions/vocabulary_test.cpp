// Value references: their syntax, and the names that they can use (decision 18; the minimum XPath of ISO 19143).

#include <algorithm>

#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

using testing::SizeIs;

namespace {

struct References : testing::Test {
    World world{navigation, speech, named("lamp", desk_lamp), in_engine("sub1", speech)};
    Application desk = world.connect();

    std::vector<std::string> found(Condition condition) { return desk.search(std::move(condition)); }
    std::string reason(Condition condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

TEST_F(References, MayReferToComponents) {
    EXPECT_THAT(found(equal("component_ref", "speech")), ElementsAre("speech"));
    EXPECT_THAT(found(equal("Identifier", "speech")), ElementsAre("speech"));
    EXPECT_THAT(found(equal("Name", "speech")), ElementsAre("speech"));
    EXPECT_THAT(found(equal("engine", "sub1")), ElementsAre("sub1.speech"));
    EXPECT_THAT(found(equal("RobotId", "sub1")), ElementsAre("sub1.speech"));
    EXPECT_THAT(found(equal("status", "READY")), SizeIs(4));
    EXPECT_THAT(found(equal("Property/status", "READY")), SizeIs(4)) << "a word that is not a parameter keeps its meaning";
}

TEST_F(References, MayReferToParameters) {
    EXPECT_THAT(found(equal("Property/volume", "50")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("volume", "50")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("Property[@name='volume']", "50")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("parameter[@name=\"VOLUME\"]", "50")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("Property/languages", "en")), ElementsAre("speech", "sub1.speech")) << "in the published spelling";
    EXPECT_THAT(found(equal("Property/labels", "green")), ElementsAre("lamp"));
}

TEST_F(References, MayHavePrefixesAndAnyCase) {
    EXPECT_THAT(found(equal("rois:Property/rois:volume", "50")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("PROPERTY / Volume", "50")), ElementsAre("speech", "sub1.speech"));
}

TEST_F(References, MayEndInAnAttribute) {
    EXPECT_THAT(found(equal("component_ref/@code", "speech")), ElementsAre("speech"));
    EXPECT_THAT(found(equal("component_ref/@authority", "OMG")), SizeIs(4));
    EXPECT_THAT(found(equal("Property/volume/@data_type_ref", "INT")), ElementsAre("speech", "sub1.speech"));
    EXPECT_THAT(found(equal("Property/volume/@name", "volume")), ElementsAre("speech", "sub1.speech"));
}

TEST_F(References, HaveOneValueWhereThereIsOne) {
    for (auto const* path : {"name[2]", "component_ref[2]/@code", "status[7]", "engine[2]", "RobotId[2]", "bound[2]"}) {
        EXPECT_THAT(found(is_null(path)), SizeIs(4)) << path;
        EXPECT_THAT(found(contrary(is_null(path))), IsEmpty()) << path;
    }
    EXPECT_THAT(found(equal("name[1]", "speech")), ElementsAre("speech"));
}

TEST_F(References, ToAMissingAttributeNeverMatch) {
    EXPECT_THAT(found(is_null("component_ref/@version")), SizeIs(4));
    EXPECT_THAT(found(equal("component_ref/@version", "")), IsEmpty());
    EXPECT_THAT(found(not_equal("component_ref/@version", "1")), IsEmpty());
}

TEST_F(References, ToParametersFollowTheirComponents) {
    ASSERT_EQ(reason(equal("ratio", "1")), "");
    ASSERT_EQ(reason(equal("label", "x")), "");
    world.change({"lamp"}, {});
    EXPECT_THAT(reason(equal("ratio", "1")), HasSubstr("which is not known here; expected one of component_ref"));
    EXPECT_THAT(reason(equal("ratio", "1")), testing::Not(HasSubstr("labels")));
    auto lamp = named("lamp", desk_lamp);
    std::ranges::find(lamp.profile.parameters, "label", &ParameterProfile::name)->data_type_ref.code = "int";
    world.change({}, {lamp});
    EXPECT_THAT(reason(equal("label", "x")), HasSubstr("compares a number with 'x'"));
}

TEST_F(References, OfAnotherGrammarAreRefused) {
    for (auto const* path :
         {"", "/name", "//name", "name/", "name[", "name[0]", "name[last()]", "name[@a]", "name[1][2]", "../name", "*", "@code",
          "name/@code/x", "name | engine", "count(name)", "Property/volume['x']", "1name"})
        EXPECT_THAT(reason(equal(path, "x")), HasSubstr("minimum XPath")) << path;
}

TEST_F(References, OfAnUnknownStepAreRefused) {
    for (auto const* path :
         {"colour", "Property/colour", "Result/number", "Property/volume/unit", "Property", "located", "Property[2]/volume"})
        EXPECT_THAT(reason(equal(path, "x")), HasSubstr("is not known here; expected one of component_ref")) << path;
    EXPECT_THAT(reason(equal("component_ref/@colour", "x")), HasSubstr("attribute"));
    EXPECT_THAT(reason(equal("status/@code", "x")), HasSubstr("attribute"));
    EXPECT_THAT(reason(equal("status[@name='x']", "x")), HasSubstr("predicate"));
    EXPECT_THAT(reason(equal("volume[@ref='x']", "x")), HasSubstr("predicate"));
}

TEST_F(References, ToResultsAreKnownWhereThereAreSome) {
    EXPECT_EQ(desk.subscribe("reached_target", equal("Result/target", "desk")).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.subscribe("reached_target", equal("result[@name='target']", "desk")).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.subscribe("reached_target", equal("is_final_target", "1")).return_code, ReturnCode::ok);
    EXPECT_THAT(desk.subscribe("reached_target", equal("number", "1")).reason,
                HasSubstr("is_final_target, target, located, Property/"));
}

TEST_F(References, ToAComponentsWordsComeBeforeResultsOfTheSameName) {
    auto talker = speech;
    talker.ref = "talker";
    talker.profile.messages.push_back({.kind = MessageKind::event,
                                       .name = "stream_status",
                                       .results = {{"status", {"string", {}, {}, {}}, {}, {}}},
                                       .arguments = {},
                                       .timeout = {}});
    World streams{talker};
    auto viewer = streams.connect();
    auto const own = viewer.subscribe("stream_status", equal("status", "READY")).subscribe_id;
    auto const other = viewer.subscribe("stream_status", equal("Result/status", "RUNNING")).subscribe_id;
    EXPECT_NE(own, other);
    streams["talker"].fires("stream_status", {text("status", "RUNNING")});
    EXPECT_THAT(viewer.received(), SizeIs(2));
    streams["talker"].fires("stream_status", {text("status", "SUSPENDED")});
    EXPECT_THAT(viewer.received(), SizeIs(1));
}

TEST_F(References, ToParametersAlsoFilterEvents) {
    EXPECT_EQ(desk.subscribe("reached_target", equal("Property/routing_policy", "distance")).return_code, ReturnCode::ok);
    world["navigation"].fires("reached_target", {text("target", "desk"), boolean("is_final_target", true)});
    EXPECT_THAT(desk.received(), IsEmpty());
    desk.bind("navigation");
    desk.set_parameter("navigation", {text("routing_policy", "distance")});
    desk.received();
    world["navigation"].fires("reached_target", {text("target", "desk"), boolean("is_final_target", true)});
    EXPECT_THAT(desk.received(), SizeIs(1));
}

TEST_F(References, ToAPropertyThatACandidateNeverHasNeverMatch) {
    EXPECT_EQ(desk.bind_any(both({equal("component_ref", "navigation"), equal("Property/volume", "50")})), "UNSUPPORTED");
    EXPECT_EQ(desk.bind_any(equal("Property/volume", "99")), "OUT_OF_RESOURCES") << "a session may set it";
    EXPECT_EQ(desk.subscribe("reached_target", equal("Property/volume", "50")).return_code, ReturnCode::unsupported);
}

TEST_F(References, ResourcesAreNamedByTheirIds) {
    EXPECT_THAT(found({ResourceId{"speech"}}), ElementsAre("speech"));
    EXPECT_THAT(found(either({{ResourceId{"speech"}}, {ResourceId{"lamp"}}})), ElementsAre("lamp", "speech"));
    desk.subscribe("reached_target");
    world["navigation"].fires("reached_target", {text("target", "desk"), boolean("is_final_target", true)});
    desk.received();
    auto const id = desk.last_received<ReceiveEvent>().event_id;
    EXPECT_THAT(desk.detail_of(id, Condition{ResourceId{id.text}}).results.parameters, SizeIs(2));
    EXPECT_THAT(desk.detail_of(id, Condition{ResourceId{"e-99"}}).results.parameters, IsEmpty());
}

// --- Groups: components of one robot ---

ComponentGroup of_types(std::vector<std::string> types, std::vector<std::string> aliases = {}) {
    return {.types = std::move(types), .aliases = std::move(aliases), .filter = {}, .members = {}};
}

struct Groups : testing::Test {
    World world{navigation, speech, in_engine("sub1", navigation), in_engine("sub1", desk_lamp), in_engine("sub2", speech)};
    Application desk = world.connect();
    Condition drives = alike("component_type", "urn:x-rois:def:component:OMG::Navigation");
    Condition speaks = alike("component_type", "urn:x-rois:def:component:OMG::SpeechSynthesis");

    std::vector<std::string> found(ComponentGroup group) { return desk.search(Condition{std::move(group)}); }
};

TEST_F(Groups, WithoutAnythingAreAllComponents) { EXPECT_THAT(found({}), SizeIs(5)); }

TEST_F(Groups, HaveAComponentForEachOfTheirMembers) {
    EXPECT_THAT(found({.types = {}, .aliases = {}, .filter = {}, .members = {drives, speaks}}),
                ElementsAre("navigation", "speech"));
    EXPECT_THAT(found({.types = {}, .aliases = {}, .filter = {}, .members = {drives}}), ElementsAre("navigation"))
        << "of one robot";
    Condition const component{And{{group(of_types({"Navigation"}))}}};
    EXPECT_THAT(desk.search(component), ElementsAre("navigation", "sub1.navigation"))
        << "a ComponentCondition is about a component, whatever its robot";
}

TEST_F(Groups, AreRobotsThatHaveAllTheTypes) {
    EXPECT_THAT(found(of_types({"Navigation", "urn:x-rois:def:component:omg::lamp"})),
                ElementsAre("sub1.lamp", "sub1.navigation"));
    EXPECT_THAT(found(of_types({"sub2"})), ElementsAre("sub2.speech"));
    EXPECT_THAT(found(of_types({"urn:x-rois:def:HRIEngine:test.sub1"})), ElementsAre("sub1.lamp", "sub1.navigation"));
    EXPECT_THAT(found(of_types({"Robot", "Lamp"})), ElementsAre("sub1.lamp", "sub1.navigation"));
    EXPECT_THAT(found(of_types({"Toaster"})), IsEmpty());
}

TEST_F(Groups, HaveAFilterOnTheWholeRobot) {
    auto group = of_types({"Robot"});
    group.filter = {equal("Property/counts", "2")};
    group.members = {drives};
    EXPECT_THAT(found(group), ElementsAre("sub1.navigation")) << "its lamp has count 2";
}

TEST_F(Groups, AnAliasStandsForTheComponentsOfItsType) {
    auto group = of_types({"Navigation", "Lamp"}, {"a", "b"});
    group.filter = {both({equal("a/Identifier", "sub1.navigation"), equal("b/Property/labels", "red")})};
    group.members = {drives};
    EXPECT_THAT(found(group), ElementsAre("sub1.navigation"));
    group.filter = {equal("b/Identifier", "sub1.navigation")};
    EXPECT_THAT(found(group), IsEmpty()) << "that component is `a`";
    group.filter = {equal("c/Identifier", "sub1.navigation")};
    EXPECT_THAT(desk.ask(Search{Condition{group}}).reason, HasSubstr("'c/Identifier'"));
}

TEST_F(Groups, AreBoundOneByOne) {
    ComponentGroup const group{
        .types = {}, .aliases = {}, .filter = {}, .members = {both({drives, contrary(equal("status", "BUSY"))})}};
    auto hall = world.connect();
    EXPECT_EQ(desk.bind_any(Condition{group}), "navigation");
    EXPECT_EQ(hall.bind_any(Condition{group}), "sub1.navigation");
    EXPECT_EQ(world.connect().bind_any(Condition{group}), "OUT_OF_RESOURCES");
}

TEST_F(Groups, AreRefusedInConditionsOnResults) {
    auto group = of_types({"Robot"});
    group.members = {equal("target", "desk")};
    EXPECT_THAT(desk.subscribe("reached_target", Condition{group}).reason, HasSubstr("'target'"));
    desk.subscribe("reached_target");
    world["navigation"].fires("reached_target", {text("target", "desk"), boolean("is_final_target", true)});
    desk.received();
    EXPECT_THAT(desk.detail_of(desk.last_received<ReceiveEvent>().event_id, Condition{ComponentGroup{}}).results.parameters,
                IsEmpty());
    EXPECT_THAT(desk.ask(GetEventDetail{desk.last_received<ReceiveEvent>().event_id, Condition{ComponentGroup{}}}).reason,
                HasSubstr("ComponentGroupCondition"));
}

TEST_F(Groups, FilterEventsByTheirRobot) {
    auto group = of_types({"Robot", "Lamp"});
    EXPECT_EQ(desk.subscribe("reached_target", Condition{group}).return_code, ReturnCode::ok);
    ParameterList const arrival{text("target", "desk"), boolean("is_final_target", true)};
    world["navigation"].fires("reached_target", arrival);
    world["sub1.navigation"].fires("reached_target", arrival);
    EXPECT_THAT(desk.received(), ElementsAre("1 reached_target sub1.navigation"));
}

// --- The same meaning, the same subscription (decision 20) ---

struct Meanings : testing::Test {
    World world{named("lamp", desk_lamp), localization, detection};
    Application desk = world.connect();

    Meanings() { world.engine->describe({.frames = {"hall"}, .all = {{"desk", box(0, 0, 10, 10, "hall")}}}); }

    std::string id(std::string const& event, Condition condition) {
        auto const reply = desk.subscribe(event, std::move(condition));
        EXPECT_EQ(reply.return_code, ReturnCode::ok) << reply.reason;
        return reply.subscribe_id.text;
    }
    std::string localized(Condition condition) { return id("person_localized", std::move(condition)); }
    std::string detected(Condition condition) { return id("person_detected", std::move(condition)); }
};

TEST_F(Meanings, OfComparisonsDoNotDependOnTheirSpelling) {
    auto const more = detected(greater("number", "1"));
    EXPECT_EQ(detected({PropertyComparison{Comparator::less, literal(" 1.0 "), reference("Result/Number")}}), more);
    EXPECT_EQ(detected({PropertyComparison{Comparator::greater, reference("number"), literal("1e0"), false}}), more)
        << "numbers are not case-sensitive";
    EXPECT_NE(detected(greater("number", "2")), more);
    EXPECT_NE(detected(less("number", "1")), more);
    EXPECT_NE(detected(compared("number", Comparator::greater, "1", MatchAction::all)), more);
    EXPECT_NE(detected(compared("number", Comparator::greater_or_equal, "1")), more);
    EXPECT_EQ(detected(equal("timestamp", "2026-11-20T12:00:00Z")), detected(equal("timestamp", "2026-11-20T21:00:00+09:00")));
    EXPECT_EQ(detected(alike("component_ref", "DETECTION")), detected(alike("name", "detection")));
    EXPECT_NE(detected(alike("component_ref", "detection")), detected(equal("name", "detection")));
    EXPECT_EQ(detected(between("number", "1", "2")), detected(between("number", "+1", "2.0")));
    EXPECT_NE(detected(between("number", "1", "2")), detected(between("number", "1", "3")));
}

TEST_F(Meanings, OfLogicDoNotDependOnOrderAndNesting) {
    auto const a = greater("number", "1"), b = less("number", "9"), c = equal("bound", "true");
    auto const all = detected(both({a, b, c}));
    EXPECT_EQ(detected(both({c, both({b, a, a})})), all);
    EXPECT_EQ(detected(contrary(contrary(both({a, b, c})))), all);
    EXPECT_EQ(detected(both({either({a}), either({both({b, c})})})), all) << "a single operand stands for itself";
    EXPECT_NE(detected(either({a, b, c})), all);
    EXPECT_NE(detected(contrary(both({a, b, c}))), all);
    EXPECT_EQ(detected({And{{a}}}), detected(a));
}

TEST_F(Meanings, OfPatternsAndNullsDoNotDependOnTheirSpelling) {
    auto const pattern = detected(like("name", "d*n"));
    EXPECT_EQ(detected({PropertyIsLike{reference("component_ref"), literal("d%%n"), "%", "_", "\\"}}), pattern);
    EXPECT_EQ(detected({PropertyIsLike{literal("!d*n"), reference("name"), "*", "?", "!"}}), pattern);
    EXPECT_NE(detected(like("name", "d?*n")), pattern);
    EXPECT_NE(detected(like("name", "d*n", Letters::ignored)), pattern);
    EXPECT_EQ(detected(is_null("number")), detected(is_nil("number", "")));
    EXPECT_NE(detected(is_null("number")), detected(is_nil("number", "missing")));
    EXPECT_EQ(detected({ResourceId{"detection"}}), detected(equal("component_ref", "detection")));
}

TEST_F(Meanings, OfPlacesAndTimesDoNotDependOnTheirSpelling) {
    auto const at_desk = localized(within("position_data", literal("desk")));
    EXPECT_EQ(localized(within("Result/position_data", {box(0, 0, 10, 10)})), at_desk);
    EXPECT_EQ(localized(spatial(SpatialRelation::within, {{box(0, 0, 10, 10, "HALL")}, reference("position_data")})), at_desk);
    EXPECT_NE(localized(spatial(SpatialRelation::intersects, {reference("position_data"), literal("desk")})), at_desk);
    EXPECT_NE(localized(within("position_data[@ref='p']", literal("desk"))), at_desk);
    EXPECT_NE(localized(within("position_data[1]", literal("desk"))), at_desk);
    EXPECT_EQ(localized(near("position_data", {spot(1, 1)}, 1'500)), localized(near("position_data", {spot(1, 1)}, 1.5, "m")));
    EXPECT_NE(localized(near("position_data", {spot(1, 1)}, 1'500)), localized(beyond("position_data", {spot(1, 1)}, 1'500)));
    Expression const day{*to_period("2026-11-20")};
    EXPECT_EQ(localized(temporal(TemporalRelation::after, {reference("timestamp"), day})),
              localized(temporal(TemporalRelation::before, {literal("2026-11-20"), reference("timestamp")})));
    EXPECT_NE(localized(temporal(TemporalRelation::after, {reference("timestamp"), day})),
              localized(temporal(TemporalRelation::before, {reference("timestamp"), day})));
}

TEST_F(Meanings, OfConditionsThatAlwaysMatchAreEqual) {
    auto const all = desk.subscribe("person_detected").subscribe_id.text;
    Condition const everything{And{}};
    EXPECT_EQ(detected(everything), all);
    EXPECT_EQ(detected(Condition{ComponentGroup{}}), all);
    EXPECT_EQ(detected(either({greater("number", "1"), everything})), all);
    EXPECT_EQ(detected(both({everything, greater("number", "1")})), detected(greater("number", "1")));
    EXPECT_EQ(desk.subscribe("person_detected", contrary(everything)).return_code, ReturnCode::unsupported);
}

TEST_F(Meanings, OfGroupsAreEqualIfTheirPartsAre) {
    ComponentGroup robot{.types = {"Robot"}, .aliases = {"a"}, .filter = {equal("a/Name", "lamp")}, .members = {}};
    auto const one = detected(Condition{robot});
    EXPECT_EQ(detected(Condition{robot}), one);
    robot.types = {"Robot", "Lamp"};
    EXPECT_NE(detected(Condition{robot}), one);
}

}  // namespace
}  // namespace rois
