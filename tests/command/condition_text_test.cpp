// Conditions of the command line.
#include "command/input/condition_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rois/condition.hpp"

namespace rois::command {
namespace {

using namespace conditions;
using testing::HasSubstr;

Condition filter(std::string_view text) { return read_condition(text).filter.value(); }

TEST(AConditionThatIsTyped, MayBeEmpty) { EXPECT_EQ(read_condition("  "), QueryExpression{}); }

TEST(AConditionThatIsTyped, HasTheSixComparisons) {
    EXPECT_EQ(filter("number = 1"), Reference{"number"} == "1");
    EXPECT_EQ(filter("number==1"), Reference{"number"} == "1");
    EXPECT_EQ(filter("number!=1"), Reference{"number"} != "1");
    EXPECT_EQ(filter("number <> 1"), Reference{"number"} != "1");
    EXPECT_EQ(filter("number<1"), Reference{"number"} < "1");
    EXPECT_EQ(filter("number >1"), Reference{"number"} > "1");
    EXPECT_EQ(filter("number<=-1.5"), Reference{"number"} <= "-1.5");
    EXPECT_EQ(filter("Result/number >= 1"), result("number") >= "1");
}

TEST(AConditionThatIsTyped, KnowsTypesByTheirNames) {
    EXPECT_EQ(filter("type = Navigation"), type == "Navigation");
    EXPECT_EQ(filter("type != urn:x-rois:def:component:OMG::Navigation"), type != "urn:x-rois:def:component:OMG::Navigation");
    EXPECT_NE(filter("type = Navigation"), Reference{"component_type"} == "Navigation") << "by its URN";
}

TEST(AConditionThatIsTyped, AcceptsQuotedValues) {
    EXPECT_EQ(filter("text = \"Hello, (you)\""), Reference{"text"} == "Hello, (you)");
    EXPECT_EQ(filter("text='and'"), Reference{"text"} == "and");
}

TEST(AConditionThatIsTyped, BindsNotBeforeAndBeforeOr) {
    auto const a = Reference{"a"} == "1";
    auto const b = Reference{"b"} == "2";
    auto const c = Reference{"c"} == "3";
    EXPECT_EQ(filter("a=1 or b=2 and not c=3"), a || (b && !c));
    EXPECT_EQ(filter("(a=1 or b=2) AND NOT (c=3)"), (a || b) && !c);
}

TEST(AConditionThatIsTyped, HasLikeBetweenNullPlacesAndTimes) {
    EXPECT_EQ(filter("name like nav*"), Reference{"name"}.like("nav*"));
    EXPECT_EQ(filter("volume between 10 and 50 and number > 0"),
              Reference{"volume"}.between("10", "50") && Reference{"number"} > "0");
    EXPECT_EQ(filter("volume is null"), Reference{"volume"}.is_null());
    EXPECT_EQ(filter("volume is not null"), !Reference{"volume"}.is_null());
    EXPECT_EQ(filter("location within entrance"), location.within("entrance"));
    EXPECT_EQ(filter("position_data within 0,0 4000,3000.5"),
              position.within(Box{millimetres{0}, millimetres{0}, millimetres{4000}, millimetres{3000.5}, {}}));
    EXPECT_EQ(filter("location near desk 2m"), location.near("desk", millimetres{2000}));
    EXPECT_EQ(filter("location near desk 250mm"), location.near("desk", millimetres{250}));
    EXPECT_EQ(filter("location near 1000,-2000 500"),
              location.near(Pose{millimetres{1000}, millimetres{-2000}, {}, {}}, millimetres{500}));
    EXPECT_EQ(filter("timestamp after 2026-11-20T12:00:00Z"), timestamp.after(*to_utc("2026-11-20T12:00:00Z")));
    EXPECT_EQ(filter("timestamp before 2026-11-20T12:00:00Z"), timestamp.before(*to_utc("2026-11-20T12:00:00Z")));
    EXPECT_EQ(filter("timestamp during 2026-11"), timestamp.during(*to_period("2026-11")));
    EXPECT_EQ(filter("timestamp during 2026-11-20T12:00:00Z to 2026-11-20T13:00:00Z"),
              timestamp.during({*to_utc("2026-11-20T12:00:00Z"), *to_utc("2026-11-20T13:00:00Z")}));
}

TEST(AConditionThatIsTyped, OrdersAtTheEndOrAlone) {
    EXPECT_EQ(read_condition("type = Navigation nearest desk"), (QueryExpression{type == "Navigation", {nearest_to("desk")}}));
    QueryExpression alone;
    alone.sort_by = {descending(Reference{"volume"}), ascending(Reference{"name"})};
    EXPECT_EQ(read_condition("order by volume descending order by name"), alone);
}

struct Wrong {
    std::string text;
    std::size_t at;
    std::string says;
};

TEST(AConditionThatIsTyped, ReportsTheErrorAndItsPlace) {
    for (auto const& [text, at, says] : std::vector<Wrong>{
             {"number", 6, "expected =, !=, <"},
             {"number >", 8, "expected a value, not the end"},
             {"number > 1 and", 14, "expected a name"},
             {"number > 1 number < 3", 11, "expected 'and', 'or'"},
             {"(number > 1", 11, "expected ')'"},
             {"= 1", 0, "expected a name"},
             {"text = \"no end", 7, "this quote does not end"},
             {"a between 1 or 2", 12, "expected 'and'"},
             {"a is nothing", 5, "expected 'null'"},
             {"a within 0,0", 9, "a second corner"},
             {"a near desk far", 12, "a distance"},
             {"a near desk -1", 12, "a distance"},
             {"a after noon", 8, "a time"},
             {"a during ever", 9, "a period"},
             {"a ! 1", 2, "expected =, !=, <"},
         }) {
        try {
            read_condition(text);
            ADD_FAILURE() << text << " was accepted";
        } catch (BadCondition const& bad) {
            EXPECT_EQ(bad.at(), at) << text;
            EXPECT_THAT(bad.what(), HasSubstr(says)) << text;
        }
    }
    EXPECT_THROW(read_condition(std::string(10'000, '(')), BadCondition);
}

}  // namespace
}  // namespace rois::command
