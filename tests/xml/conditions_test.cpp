// Conditions: what is understood, and what is given back as not understood.
#include <gmock/gmock.h>

#include "speaking.hpp"

namespace rois::xml {
namespace {

using testing::HasSubstr;

constexpr std::string_view is_ready =
    "<fes:PropertyIsEqualTo><fes:ValueReference> "
    "status\n</fes:ValueReference><fes:Literal>READY</fes:Literal></fes:PropertyIsEqualTo>";
constexpr std::string_view is_one =
    "<fes:PropertyIsEqualTo matchCase='false'><fes:Literal> 1 "
    "</fes:Literal><fes:ValueReference>Property/x</fes:ValueReference></fes:PropertyIsEqualTo>";

PropertyIsEqualTo const ready{ValueReference{"status"}, Literal{"READY"}, true};
PropertyIsEqualTo const one{Literal{" 1 "}, ValueReference{"Property/x"}, false};

MaybeCondition condition(std::string_view inside) {
    return operation<Search>(document("search", "<condition>" + std::string{inside} + "</condition>")).condition;
}

MaybeCondition filter(std::string_view predicate) { return condition("<fes:Filter>" + std::string{predicate} + "</fes:Filter>"); }

std::string not_understood(MaybeCondition const& given) {
    auto const* told = given ? std::get_if<NotUnderstood>(&given->predicate) : nullptr;
    return told == nullptr ? "" : told->reason;
}

TEST(Condition, Equality) {
    EXPECT_EQ(filter(is_ready), Condition{ready});
    EXPECT_EQ(filter(is_one), Condition{one});
    EXPECT_EQ(filter("<fes:PropertyIsEqualTo matchAction='Any' "
                     "matchCase='1'><fes:ValueReference>status</fes:ValueReference><fes:Literal>READY</fes:Literal></"
                     "fes:PropertyIsEqualTo>"),
              Condition{ready});
}

TEST(Condition, AndWithOr) {
    auto const both = std::string{is_ready} + std::string{is_one};
    EXPECT_EQ(filter("<fes:And>" + both + "</fes:And>"), (Condition{And{{Condition{ready}, Condition{one}}}}));
    EXPECT_EQ(filter("<fes:Or>" + both + "<fes:And>" + both + "</fes:And></fes:Or>"),
              (Condition{Or{{Condition{ready}, Condition{one}, Condition{And{{Condition{ready}, Condition{one}}}}}}}));
}

TEST(Condition, AnEmptySearchConditionIsNone) {
    EXPECT_FALSE(condition("<unr:SearchCondition/>"));
    EXPECT_FALSE(condition("<unr:SearchCondition><!-- nothing --></unr:SearchCondition>"));
    EXPECT_FALSE(condition("<unr:SearchCondition>\n</unr:SearchCondition>"));
}

TEST(Condition, WhatIsNotUnderstoodIsNamed) {
    auto const two = "<fes:ValueReference>a</fes:ValueReference><fes:Literal>b</fes:Literal>";
    EXPECT_THAT(not_understood(filter(std::string{"<fes:PropertyIsLessThan>"} + two + "</fes:PropertyIsLessThan>")),
                HasSubstr("'PropertyIsLessThan'"));
    EXPECT_THAT(not_understood(filter("<fes:Not>" + std::string{is_ready} + "</fes:Not>")), HasSubstr("'Not'"));
    EXPECT_THAT(not_understood(filter("<fes:ResourceId rid='a'/>")), HasSubstr("'ResourceId'"));
    EXPECT_THAT(not_understood(filter(
                    "<fes:PropertyIsEqualTo><fes:Function name='f'/><fes:Literal>b</fes:Literal></fes:PropertyIsEqualTo>")),
                HasSubstr("'Function'"));
    EXPECT_THAT(
        not_understood(filter("<fes:PropertyIsEqualTo matchAction='All'>" + std::string{two} + "</fes:PropertyIsEqualTo>")),
        HasSubstr("'matchAction'"));
    EXPECT_THAT(not_understood(condition("<unr:SearchCondition><unr:ComponentCondition type='t'/></unr:SearchCondition>")),
                HasSubstr("'SearchCondition'"));
}

TEST(Condition, WhatIsNotUnderstoodInsideMakesTheWholeSo) {
    EXPECT_THAT(not_understood(filter(
                    "<fes:And>" + std::string{is_ready} + "<fes:Or>" + std::string{is_ready} +
                    "<fes:PropertyIsNull><fes:ValueReference>a</fes:ValueReference></fes:PropertyIsNull></fes:Or></fes:And>")),
                HasSubstr("'PropertyIsNull'"));
}

}  // namespace
}  // namespace rois::xml
