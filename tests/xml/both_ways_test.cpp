// Round trips: requests that clients encode and the engine decodes, and answers in the other direction.
#include <gmock/gmock.h>

#include "xml/codec/decoding.hpp"
#include "xml/speaking.hpp"
#include "xml/validation/joining.hpp"

namespace rois::xml {
namespace {

using testing::Gt;
using testing::HasSubstr;

// Conditions are compared as values, everything else as encoded text.
QueryExpression const& condition_of(Request const& request) {
    static QueryExpression const none;
    return std::visit(
        [](auto const& operation) -> QueryExpression const& {
            if constexpr (requires { operation.condition; }) {
                return operation.condition;
            } else {
                return none;
            }
        },
        request.operation);
}

void expect_both_ways(Request const& first, std::string const& name) {
    auto const written = encode(first);
    auto const again = request(written);
    EXPECT_EQ(again.operation.index(), first.operation.index()) << name;
    EXPECT_EQ(condition_of(again), condition_of(first)) << name << "\n" << written;
    EXPECT_EQ(encode(again), written) << name;
}

std::vector<std::filesystem::path> valid_samples() {
    std::vector<std::filesystem::path> files;
    for (auto const& entry : std::filesystem::recursive_directory_iterator{samples() / "valid"})
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

TEST(BothWays, EverySampleRequestRoundTrips) {
    std::size_t count = 0;
    for (auto const& path : valid_samples()) {
        auto const answer = read(file(path));
        auto const* const asked = std::get_if<Request>(&answer);
        if (asked == nullptr) continue;
        try {
            expect_both_ways(*asked, path);
            ++count;
        } catch (std::invalid_argument const& problem) {
            EXPECT_THAT(problem.what(), HasSubstr("cannot be written")) << path;
        }
    }
    EXPECT_THAT(count, Gt(20));
}

// Answers, notifications and faults.
TEST(BothWays, EverySampleAnswerRoundTrips) {
    std::size_t count = 0;
    AnswerReader reader;
    for (auto const& path : valid_samples()) {
        auto const text = file(path);
        if (auto const response = read_join_response(text)) {
            EXPECT_EQ(encode(*response), encode(*read_join_response(encode(*response)))) << path;
            continue;
        }
        bool const expected = text.find("_response ") != text.npos || text.find("<fault ") != text.npos ||
                              (text.find(" sequence=") != text.npos && text.find("<notifications") == text.npos);
        auto const decoded = reader.read(text);
        EXPECT_EQ(decoded.has_value(), expected) << path;
        if (!decoded) continue;
        ++count;
        std::string written;
        if (auto const* const answered = std::get_if<Answered>(&*decoded)) {
            written = encode(answered->reply, answered->request_id);
        } else if (auto const* const fault = std::get_if<Fault>(&*decoded)) {
            written = encode(*fault);
        } else {
            auto const& [sequence, notification] = std::get<NumberedNotification>(*decoded);
            written = std::string{notification_head(notification)} + std::to_string(sequence) + notification_tail(notification);
        }
        EXPECT_EQ(problem(path, written), "") << written;
        auto const again = reader.read(written);
        ASSERT_TRUE(again) << written;
        EXPECT_EQ(again->index(), decoded->index()) << written;
    }
    EXPECT_THAT(count, Gt(15));
}

Request search(Condition condition, std::vector<SortProperty> order = {}) {
    return {Search{{std::move(condition), std::move(order)}}, "a \"request\""};
}

Expression reference(std::string path) { return {ValueReference{std::move(path)}}; }

TEST(BothWays, EveryPredicateRoundTrips) {
    auto const noon = *to_utc("2026-11-20T12:00:00Z");
    Expression const where = reference("location");
    Expression const box{Geometry{.crs = "hall", .low = {0, -1, 0}, .high = {5000, 8000.5, 0}, .dimensions = 2}};
    Expression const spot{Geometry{.crs = "", .low = {1, 2, 3}, .high = {1, 2, 3}, .dimensions = 3}};
    auto const shaped = [](Geometry::Shape shape, std::vector<Geometry::Points> paths, double radius = 0) {
        Geometry geometry{.crs = "hall", .shape = shape, .paths = std::move(paths), .radius = radius};
        geometry.fit_corners();
        return Expression{geometry};
    };
    auto const line = shaped(Geometry::Shape::line, {{{0, 1}, {2, 3.5}, {4, 0}}});
    auto const circle = shaped(Geometry::Shape::circle, {{{0, 1}}}, 1.25);
    auto const polygon = shaped(Geometry::Shape::polygon, {{{0, 0}, {9, 0}, {0, 9}, {0, 0}}, {{1, 1}, {2, 1}, {1, 2}, {1, 1}}});
    Expression const day{Period{noon, noon + std::chrono::hours{24}}};
    Condition const less{PropertyComparison{Comparator::less, where, {Literal{" <5> "}}, false, MatchAction::all}};
    std::vector<Condition> const predicates{
        less,
        {PropertyComparison{Comparator::greater_or_equal, spot, day, true, MatchAction::one}},
        {PropertyIsLike{where, {Literal{"a*"}}, "*", "?", "\\", false}},
        {PropertyIsNull{where}},
        {PropertyIsNil{where, "missing"}},
        {PropertyIsBetween{where, {Literal{"1"}}, {Function{"distance", {where, {Literal{"desk"}}}}}}},
        {SpatialComparison{SpatialRelation::within, {where, box}}},
        {SpatialComparison{SpatialRelation::disjoint, {spot}}},
        {SpatialComparison{SpatialRelation::equals, {where, spot}}},
        {SpatialComparison{SpatialRelation::touches, {where, box}}},
        {SpatialComparison{SpatialRelation::overlaps, {where, polygon}}},
        {SpatialComparison{SpatialRelation::crosses, {where, line}}},
        {SpatialComparison{SpatialRelation::contains, {circle, where}}},
        {DistanceComparison{DistanceRelation::beyond, {where, spot}, 1.5, "m"}},
        {TemporalComparison{TemporalRelation::during, {reference("timestamp"), day}}},
        {TemporalComparison{TemporalRelation::t_equals, {{Period{noon, noon}}}}},
        {TemporalComparison{TemporalRelation::begins, {day}}},
        {TemporalComparison{TemporalRelation::begun_by, {day}}},
        {TemporalComparison{TemporalRelation::t_contains, {day}}},
        {TemporalComparison{TemporalRelation::ended_by, {day}}},
        {TemporalComparison{TemporalRelation::ends, {day}}},
        {TemporalComparison{TemporalRelation::meets, {day}}},
        {TemporalComparison{TemporalRelation::met_by, {day}}},
        {TemporalComparison{TemporalRelation::t_overlaps, {day}}},
        {TemporalComparison{TemporalRelation::overlapped_by, {day}}},
        {TemporalComparison{TemporalRelation::any_interacts, {day}}},
        {ResourceId{"navigation"}},
        {And{{less, less}}},
        {Or{{less, {Not{{less}}}}}},
    };
    for (auto const& predicate : predicates) expect_both_ways(search(predicate), encode(search(predicate)));
    expect_both_ways(search(less, {{where, SortOrder::ascending}, {{Function{"distance", {where}}}, SortOrder::descending}}),
                     "sorted");
    expect_both_ways({Search{}, {}}, "nothing");
}

// Decoding the wrapper puts all conditions into an Or, and those of each component into an And.
TEST(BothWays, GroupsOfComponentsRoundTrip) {
    auto const text = document("search", R"(<condition><unr:SearchCondition>
        <unr:ComponentGroupCondition types="Robot urn:x:place" aliases="a b"><fes:Filter><fes:PropertyIsNull>
          <fes:ValueReference>a/location</fes:ValueReference></fes:PropertyIsNull></fes:Filter>
          <unr:ComponentCondition type="Navigation" mode="exclusive"/></unr:ComponentGroupCondition>
        <unr:ComponentCondition type="Move"/><unr:ComponentCondition><fes:Filter><fes:ResourceId rid="move"/></fes:Filter>
        </unr:ComponentCondition></unr:SearchCondition></condition>)");
    expect_both_ways(request(text), text);
}

TEST(BothWays, ThrowsForConditionsThatXmlCannotExpress) {
    ComponentGroup const group{.types = {"Robot"}, .aliases = {}, .filter = {}, .members = {}};
    EXPECT_THROW(encode(search({NotUnderstood{"what"}})), std::invalid_argument);
    EXPECT_THROW(encode(search({PropertyIsNull{{NotUnderstood{"what"}}}})), std::invalid_argument);
    EXPECT_THROW(encode(search({Not{{{group}}}})), std::invalid_argument);
    EXPECT_THROW(encode(search({Not{}})), std::invalid_argument);
    EXPECT_THROW(encode(search({And{}})), std::invalid_argument);
}

TEST(AnswerReader, RejectsDocumentsThatAreNotAnswers) {
    AnswerReader reader;
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "<a>";
    for (auto const& strange :
         {std::string{}, std::string{"text"}, std::string{"<a/>"}, std::string{"<connect_response return_code=\"OK\"/>"},
          document("connect_response", "", " return_code=\"OK\""), document("connect_response", "<session>1</session>"),
          document("connect_response", "<session>1</session>", " return_code=\"FINE\""), document("fault", "", " code=\"odd\""),
          document("completed", "<command_id>1</command_id><status>OK</status>"), document("completed", "", " sequence=\"1\""),
          document("search_response", "", " return_code=\"OK\""), document("query_response", "<results/>", " return_code=\"OK\""),
          document("get_profile_response", "<components/>", " return_code=\"OK\""),
          document("receive_event", "", " sequence=\"1\""), document("unknown_response", "", " return_code=\"OK\""), deep})
        EXPECT_FALSE(reader.read(strange)) << strange.substr(0, 200);
}

}  // namespace
}  // namespace rois::xml
