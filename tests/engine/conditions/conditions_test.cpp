// The meaning of conditions (decisions 18 and 19), tested through search.
#include "engine/world.hpp"

namespace rois {

namespace {

struct Conditions : testing::Test {
    World world{navigation, speech, in_engine("sub1", speech)};
    Application desk = world.connect();

    std::vector<std::string> found(Condition condition) { return desk.search(std::move(condition)); }
    std::string reason(Condition condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

}  // namespace

TEST_F(Conditions, EqualComparesTwoReferencesOrTwoLiterals) {
    auto const equal_sides = [](Expression left, Expression right) {
        return Condition{PropertyComparison{Comparator::equal, std::move(left), std::move(right)}};
    };
    EXPECT_THAT(found(equal_sides({ValueReference{"component_ref"}}, {ValueReference{"name"}})),
                ElementsAre("navigation", "speech", "sub1.speech"));
    EXPECT_THAT(found(equal_sides({ValueReference{"component_ref"}}, {ValueReference{"engine"}})), IsEmpty());
    EXPECT_THAT(found(equal_sides({Literal{"a"}}, {Literal{"b"}})), IsEmpty());
    EXPECT_THAT(found(equal_sides({Literal{"a"}}, {Literal{" a "}})), testing::SizeIs(3));
}

TEST_F(Conditions, WithAnUnknownReferenceAreRefusedWithTheKnownOnes) {
    EXPECT_EQ(
        reason(equal("colour", "red")),
        "the condition refers to 'colour', which is not known here; expected one of component_ref, component_type, name, engine, "
        "status, bound, location, Identifier, RobotId, Property/language, Property/routing_policy, Property/speech_text, "
        "Property/SSML_text, Property/synthesizable_languages, Property/target_position, Property/time_limit, "
        "Property/volume");
    EXPECT_THAT(reason(equal_reversed("red", "colour")), HasSubstr("'colour'"));
    EXPECT_THAT(reason(either({equal("name", "speech"), both({equal("name", "x"), equal("colour", "red")})})),
                HasSubstr("'colour'"));
}

TEST_F(Conditions, ThatAreNotSupportedAreRefusedWithAReason) {
    EXPECT_EQ(reason(not_understood("PropertyIsLike is not supported")), "PropertyIsLike is not supported");
    EXPECT_EQ(reason(both({equal("name", "speech"), not_understood("nor is this")})), "nor is this");
    EXPECT_EQ(desk.ask(Search{not_understood("x")}).return_code, ReturnCode::bad_parameter);
}

}  // namespace rois
