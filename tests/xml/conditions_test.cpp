// Decoding of conditions: every operator, geometry and time, and the reasons for unsupported parts.
#include <gmock/gmock.h>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string const status = "<fes:ValueReference> status\n</fes:ValueReference>";
std::string const ready = "<fes:Literal>READY</fes:Literal>";
std::string const is_ready = "<fes:PropertyIsEqualTo>" + status + ready + "</fes:PropertyIsEqualTo>";
std::string const where = "<fes:ValueReference>location</fes:ValueReference>";
std::string const box =
    "<gml:Envelope srsName='hall'><gml:lowerCorner>0 -1</gml:lowerCorner><gml:upperCorner>5e3 "
    "8000.5</gml:upperCorner></gml:Envelope>";
std::string const spot = "<gml:Point><gml:pos>1 2 3</gml:pos></gml:Point>";
std::string const noon = "<gml:TimeInstant><gml:timePosition>2026-11-20T12:00:00Z</gml:timePosition></gml:TimeInstant>";

QueryExpression query(std::string const& inside) {
    return operation<Search>(document("search", "<condition>" + inside + "</condition>")).condition;
}

std::optional<Condition> condition(std::string const& inside) { return query(inside).filter; }

Condition filter(std::string const& predicate) { return condition("<fes:Filter>" + predicate + "</fes:Filter>").value(); }

template <class Kind>
Kind the(Condition const& given) {
    return std::get<Kind>(given.predicate);
}

Expression reference(std::string path) { return {ValueReference{std::move(path)}}; }
Expression literal(std::string text) { return {Literal{std::move(text)}}; }

Condition equal(std::string path, std::string text) {
    return {PropertyComparison{Comparator::equal, reference(std::move(path)), literal(std::move(text))}};
}

Geometry const the_box{.crs = "hall", .low = {0, -1, 0}, .high = {5000, 8000.5, 0}, .dimensions = 2};
Geometry const the_spot{.crs = "", .low = {1, 2, 3}, .high = {1, 2, 3}, .dimensions = 3};
Utc const twelve = *to_utc("2026-11-20T12:00:00Z");

std::string reason_in(Expression const& expression) { return std::get<NotUnderstood>(expression.value).reason; }
std::string reason_in(Condition const& given) { return the<NotUnderstood>(given).reason; }

// Returns the geometry as decoded in an operand of a spatial operator.
Expression geometry(std::string const& gml) {
    return the<SpatialComparison>(filter("<fes:Within>" + where + gml + "</fes:Within>")).operands.at(1);
}

Expression time(std::string const& gml) {
    return the<TemporalComparison>(filter("<fes:During>" + where + gml + "</fes:During>")).operands.at(1);
}

TEST(Condition, ReadsTheSixComparisons) {
    auto const read = [](std::string const& name) {
        return the<PropertyComparison>(filter("<fes:" + name + ">" + status + ready + "</fes:" + name + ">")).comparator;
    };
    EXPECT_EQ(read("PropertyIsEqualTo"), Comparator::equal);
    EXPECT_EQ(read("PropertyIsNotEqualTo"), Comparator::not_equal);
    EXPECT_EQ(read("PropertyIsLessThan"), Comparator::less);
    EXPECT_EQ(read("PropertyIsGreaterThan"), Comparator::greater);
    EXPECT_EQ(read("PropertyIsLessThanOrEqualTo"), Comparator::less_or_equal);
    EXPECT_EQ(read("PropertyIsGreaterThanOrEqualTo"), Comparator::greater_or_equal);
}

TEST(Condition, KeepsTheOrderOfOperandsAndTheTextOfLiterals) {
    EXPECT_EQ(filter(is_ready), equal("status", "READY"));
    EXPECT_EQ(filter("<fes:PropertyIsLessThan><fes:Literal> 1 </fes:Literal>" + status + "</fes:PropertyIsLessThan>"),
              (Condition{PropertyComparison{Comparator::less, literal(" 1 "), reference("status")}}));
}

TEST(Condition, ReadsMatchCaseAndMatchAction) {
    auto const read = [](std::string const& attributes) {
        return the<PropertyComparison>(
            filter("<fes:PropertyIsEqualTo " + attributes + ">" + status + ready + "</fes:PropertyIsEqualTo>"));
    };
    EXPECT_TRUE(read("").match_case);
    EXPECT_TRUE(read("matchCase='1'").match_case);
    EXPECT_FALSE(read("matchCase=' false'").match_case);
    EXPECT_EQ(read("").match_action, MatchAction::any);
    EXPECT_EQ(read("matchAction='Any'").match_action, MatchAction::any);
    EXPECT_EQ(read("matchAction='All'").match_action, MatchAction::all);
    EXPECT_EQ(read("matchAction='One'").match_action, MatchAction::one);
}

TEST(Condition, ReadsTheSpecialCharactersOfPatterns) {
    auto const like =
        the<PropertyIsLike>(filter("<fes:PropertyIsLike wildCard='*' singleChar='?' escapeChar='\\' matchCase='false'>" + status +
                                   "<fes:Literal>R*</fes:Literal></fes:PropertyIsLike>"));
    EXPECT_EQ(like, (PropertyIsLike{reference("status"), literal("R*"), "*", "?", "\\", false}));
}

TEST(Condition, ReadsNullAndNil) {
    EXPECT_EQ(filter("<fes:PropertyIsNull>" + status + "</fes:PropertyIsNull>"), Condition{PropertyIsNull{reference("status")}});
    EXPECT_EQ(filter("<fes:PropertyIsNil nilReason='missing'>" + status + "</fes:PropertyIsNil>"),
              (Condition{PropertyIsNil{reference("status"), "missing"}}));
}

TEST(Condition, ReadsBoundaries) {
    EXPECT_EQ(filter("<fes:PropertyIsBetween>" + status +
                     "<fes:LowerBoundary><fes:Literal>1</fes:Literal></fes:LowerBoundary>"
                     "<fes:UpperBoundary><fes:Literal>2</fes:Literal></fes:UpperBoundary></fes:PropertyIsBetween>"),
              (Condition{PropertyIsBetween{reference("status"), literal("1"), literal("2")}}));
}

TEST(Condition, ReadsNestedAndOrNot) {
    auto const ready_now = equal("status", "READY");
    EXPECT_EQ(filter("<fes:And>" + is_ready + is_ready + "</fes:And>"), (Condition{And{{ready_now, ready_now}}}));
    EXPECT_EQ(filter("<fes:Or>" + is_ready + "<fes:Not>" + is_ready + "</fes:Not></fes:Or>"),
              (Condition{Or{{ready_now, Condition{Not{{ready_now}}}}}}));
}

TEST(Condition, ReadsResourceIds) {
    EXPECT_EQ(filter("<fes:ResourceId rid='a'/>"), Condition{ResourceId{"a"}});
    EXPECT_EQ(filter("<fes:ResourceId rid='a'/><fes:ResourceId rid='b'/>"),
              (Condition{Or{{Condition{ResourceId{"a"}}, Condition{ResourceId{"b"}}}}}));
    for (auto const* version : {"version='LAST'", "previousRid='b'", "startDate='2026-11-20T12:00:00Z'"})
        EXPECT_THAT(reason_in(filter("<fes:ResourceId rid='a' " + std::string{version} + "/>")),
                    HasSubstr(std::string{version}.substr(0, std::string{version}.find('='))));
}

TEST(Condition, ReadsSpatialRelations) {
    auto const read = [](std::string const& name) {
        return the<SpatialComparison>(filter("<fes:" + name + ">" + where + box + "</fes:" + name + ">"));
    };
    EXPECT_EQ(read("Within").relation, SpatialRelation::within);
    EXPECT_EQ(read("Intersects").relation, SpatialRelation::intersects);
    EXPECT_EQ(read("BBOX").relation, SpatialRelation::intersects);
    EXPECT_EQ(read("Disjoint").relation, SpatialRelation::disjoint);
    EXPECT_EQ(read("Equals").relation, SpatialRelation::equals);
    EXPECT_EQ(read("Touches").relation, SpatialRelation::touches);
    EXPECT_EQ(read("Overlaps").relation, SpatialRelation::overlaps);
    EXPECT_EQ(read("Crosses").relation, SpatialRelation::crosses);
    EXPECT_EQ(read("Contains").relation, SpatialRelation::contains);
    EXPECT_THAT(read("Within").operands, ElementsAre(reference("location"), Expression{the_box}));
    EXPECT_THAT(the<SpatialComparison>(filter("<fes:BBOX>" + box + "</fes:BBOX>")).operands, ElementsAre(Expression{the_box}));
}

TEST(Condition, ReadsDistanceRelations) {
    auto const read = [](std::string const& name) {
        return the<DistanceComparison>(
            filter("<fes:" + name + ">" + where + spot + "<fes:Distance uom='m'>1.5</fes:Distance></fes:" + name + ">"));
    };
    EXPECT_EQ(read("DWithin"), (DistanceComparison{DistanceRelation::d_within, {reference("location"), {the_spot}}, 1.5, "m"}));
    EXPECT_EQ(read("Beyond").relation, DistanceRelation::beyond);
}

TEST(Condition, ReadsBoxesAndPoints) {
    EXPECT_EQ(geometry(box), Expression{the_box});
    EXPECT_EQ(geometry(spot), Expression{the_spot});
    EXPECT_EQ(geometry("<fes:Literal>" + spot + "</fes:Literal>"), Expression{the_spot});
    EXPECT_EQ(geometry("<gml:Envelope srsName='hall'><gml:pos>5000 -1</gml:pos><gml:pos>0 8000.5</gml:pos></gml:Envelope>"),
              Expression{the_box})
        << "any two opposite corners";
    EXPECT_EQ(geometry("<gml:Envelope><gml:lowerCorner srsName='hall' srsDimension='2' uomLabels='mm mm' axisLabels='x y'>0 -1"
                       "</gml:lowerCorner><gml:upperCorner>5000 8000.5</gml:upperCorner></gml:Envelope>"),
              Expression{the_box});
    EXPECT_EQ(geometry("<fes:Literal>desk</fes:Literal>"), literal("desk"));
}

TEST(Condition, ReadsLinesCirclesAndPolygons) {
    Geometry line;
    line.crs = "hall";
    line.shape = Geometry::Shape::line;
    line.paths = {{{0, 1}, {2, 3.5}, {4, 0}}};
    line.high = {4, 3.5, 0};
    EXPECT_EQ(geometry("<gml:LineString srsName='hall'><gml:posList>0 1 2 3.5 4 0</gml:posList></gml:LineString>"),
              Expression{line});
    EXPECT_EQ(geometry("<gml:LineString><gml:pos srsName='hall'>0 1</gml:pos><gml:pos>2 3.5</gml:pos><gml:pos>4 0</gml:pos>"
                       "</gml:LineString>"),
              Expression{line});
    Geometry circle;
    circle.shape = Geometry::Shape::circle;
    circle.paths = {{{1, 2}}};
    circle.radius = 1'500;
    circle.low = {-1'499, -1'498, 0};
    circle.high = {1'501, 1'502, 0};
    EXPECT_EQ(geometry("<gml:CircleByCenterPoint numArc='1'><gml:pos>1 2</gml:pos><gml:radius uom='m'>1.5</gml:radius>"
                       "</gml:CircleByCenterPoint>"),
              Expression{circle});
    Geometry polygon;
    polygon.shape = Geometry::Shape::polygon;
    polygon.paths = {{{0, 0}, {9, 0}, {0, 9}, {0, 0}}, {{1, 1}, {2, 1}, {1, 2}, {1, 1}}};
    polygon.high = {9, 9, 0};
    EXPECT_EQ(
        geometry("<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList srsDimension='2'>0 0 9 0 0 9 0 0</gml:posList>"
                 "</gml:LinearRing></gml:exterior><gml:interior><gml:LinearRing><gml:pos>1 1</gml:pos><gml:pos>2 1</gml:pos>"
                 "<gml:pos>1 2</gml:pos><gml:pos>1 1</gml:pos></gml:LinearRing></gml:interior></gml:Polygon>"),
        Expression{polygon});
}

TEST(Condition, GivesTheReasonForUnsupportedGeometries) {
    EXPECT_THAT(reason_in(geometry("<gml:LineString><gml:posList>0 0 1</gml:posList></gml:LineString>")),
                HasSubstr("has 3 numbers: expected 2 for each point"));
    EXPECT_THAT(reason_in(geometry("<gml:LineString><gml:posList>0 0</gml:posList></gml:LineString>")),
                HasSubstr("line of one point"));
    EXPECT_THAT(reason_in(geometry("<gml:LineString srsDimension='3'><gml:posList>0 0 0 1 1 1</gml:posList></gml:LineString>")),
                HasSubstr("three coordinates: expected two"));
    EXPECT_THAT(reason_in(geometry("<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 1 0 1 1</gml:posList>"
                                   "</gml:LinearRing></gml:exterior></gml:Polygon>")),
                HasSubstr("LinearRing of 3 points: expected four or more, the last one equal to the first"));
    EXPECT_THAT(reason_in(geometry("<gml:CircleByCenterPoint><gml:pos>1 2</gml:pos><gml:radius uom='ell'>1</gml:radius>"
                                   "</gml:CircleByCenterPoint>")),
                HasSubstr("'ell'"));
    EXPECT_THAT(reason_in(geometry("<gml:CircleByCenterPoint><gml:pos>1 2 3</gml:pos><gml:radius uom='m'>1</gml:radius>"
                                   "</gml:CircleByCenterPoint>")),
                HasSubstr("centre of a circle"));
    EXPECT_THAT(reason_in(geometry("<gml:Envelope><gml:lowerCorner>0 9</gml:lowerCorner><gml:upperCorner>5 3</gml:upperCorner>"
                                   "</gml:Envelope>")),
                HasSubstr("lowerCorner is above its upperCorner (9 and 3)"));
    EXPECT_THAT(reason_in(geometry("<gml:Point><gml:pos>1</gml:pos></gml:Point>")), HasSubstr("has 1 coordinates: expected two"));
    EXPECT_THAT(reason_in(geometry("<gml:Point><gml:pos>1 2 3 4</gml:pos></gml:Point>")),
                HasSubstr("has 4 coordinates: expected two or three"));
    EXPECT_THAT(reason_in(geometry("<gml:Point><gml:pos>1 NaN</gml:pos></gml:Point>")), HasSubstr("is NaN or too large"));
    EXPECT_THAT(reason_in(geometry("<gml:Point><gml:pos>1 1e999</gml:pos></gml:Point>")), HasSubstr("is NaN or too large"));
    EXPECT_THAT(reason_in(geometry("<gml:Point srsDimension='3'><gml:pos>1 2</gml:pos></gml:Point>")),
                HasSubstr("has 2 coordinates, but its srsDimension is 3"));
    EXPECT_THAT(reason_in(geometry("<gml:Point><gml:pos srsDimension='2'>1 2 3</gml:pos></gml:Point>")),
                HasSubstr("has 3 coordinates, but its srsDimension is 2"));
    EXPECT_THAT(reason_in(geometry("<gml:Point uomLabels='m m'><gml:pos>1 2</gml:pos></gml:Point>")), HasSubstr("uomLabels"));
    EXPECT_THAT(reason_in(geometry("<gml:Point axisLabels='y x'><gml:pos>1 2</gml:pos></gml:Point>")), HasSubstr("axisLabels"));
    EXPECT_THAT(reason_in(geometry("<gml:Envelope><gml:pos>1 2</gml:pos><gml:pos>1 2 3</gml:pos></gml:Envelope>")),
                HasSubstr("the same number in all points"));
    EXPECT_THAT(
        reason_in(geometry("<gml:Envelope><gml:pos srsName='a'>1 2</gml:pos><gml:pos srsName='b'>1 2</gml:pos></gml:Envelope>")),
        HasSubstr("two frames"));
}

TEST(Condition, ReadsTemporalRelations) {
    auto const read = [](std::string const& name) {
        return the<TemporalComparison>(filter("<fes:" + name + ">" + where + noon + "</fes:" + name + ">"));
    };
    EXPECT_EQ(read("After"), (TemporalComparison{TemporalRelation::after, {reference("location"), {Period{twelve, twelve}}}}));
    EXPECT_EQ(read("Before").relation, TemporalRelation::before);
    EXPECT_EQ(read("During").relation, TemporalRelation::during);
    EXPECT_EQ(read("TEquals").relation, TemporalRelation::t_equals);
    EXPECT_EQ(read("Begins").relation, TemporalRelation::begins);
    EXPECT_EQ(read("BegunBy").relation, TemporalRelation::begun_by);
    EXPECT_EQ(read("TContains").relation, TemporalRelation::t_contains);
    EXPECT_EQ(read("EndedBy").relation, TemporalRelation::ended_by);
    EXPECT_EQ(read("Ends").relation, TemporalRelation::ends);
    EXPECT_EQ(read("Meets").relation, TemporalRelation::meets);
    EXPECT_EQ(read("MetBy").relation, TemporalRelation::met_by);
    EXPECT_EQ(read("TOverlaps").relation, TemporalRelation::t_overlaps);
    EXPECT_EQ(read("OverlappedBy").relation, TemporalRelation::overlapped_by);
    EXPECT_EQ(read("AnyInteracts").relation, TemporalRelation::any_interacts);
}

TEST(Condition, ReadsMomentsAndPeriods) {
    Expression const morning{Period{*to_utc("2026-11-20T00:00:00Z"), twelve}};
    EXPECT_EQ(time("<gml:TimePeriod><gml:beginPosition>2026-11-20T09:00:00+09:00</gml:beginPosition>"
                   "<gml:endPosition>2026-11-20T12:00:00</gml:endPosition></gml:TimePeriod>"),
              morning);
    EXPECT_EQ(time("<gml:TimePeriod><gml:begin><gml:TimeInstant><gml:timePosition>2026-11-20</gml:timePosition></gml:TimeInstant>"
                   "</gml:begin><gml:end>" +
                   noon + "</gml:end></gml:TimePeriod>"),
              morning);
    EXPECT_EQ(time("<gml:TimeInstant><gml:timePosition>2026-11</gml:timePosition></gml:TimeInstant>"),
              (Expression{Period{*to_utc("2026-11-01T00:00:00Z"), *to_utc("2026-12-01T00:00:00Z")}}));
    EXPECT_THAT(reason_in(time("<gml:TimeInstant><gml:timePosition indeterminatePosition='now'/></gml:TimeInstant>")),
                HasSubstr("'indeterminatePosition'"));
    EXPECT_THAT(reason_in(time("<gml:TimeInstant><gml:timePosition>12:00:00</gml:timePosition></gml:TimeInstant>")),
                HasSubstr("'12:00:00'"));
    EXPECT_THAT(
        reason_in(time("<gml:TimePeriod><gml:beginPosition>2026</gml:beginPosition><gml:endPosition>2025</gml:endPosition>"
                       "</gml:TimePeriod>")),
        HasSubstr("before it begins"));
}

TEST(Condition, ReadsFunctions) {
    auto const compared =
        the<PropertyComparison>(filter("<fes:PropertyIsLessThan><fes:Function name='distance'>" + where + "<fes:Literal>" + spot +
                                       "</fes:Literal></fes:Function>" + ready + "</fes:PropertyIsLessThan>"));
    EXPECT_EQ(compared.left, (Expression{Function{"distance", {reference("location"), {the_spot}}}}));
    auto const bare = the<PropertyComparison>(filter("<fes:PropertyIsLessThan><fes:Function name='distance'>" + where + spot +
                                                     "</fes:Function>" + ready + "</fes:PropertyIsLessThan>"));
    EXPECT_EQ(bare.left, compared.left) << "without a Literal around it";
}

TEST(Condition, GivesTheReasonForAFunctionAsPredicate) {
    EXPECT_THAT(reason_in(filter("<fes:Function name='is_free'/>")), HasSubstr("the function 'is_free' as a predicate"));
}

TEST(SortBy, FollowsAFilterOrStandsAlone) {
    std::string const sort_by =
        "<fes:SortBy><fes:SortProperty><fes:ValueReference>name</fes:ValueReference><fes:SortOrder>DESC</fes:SortOrder></"
        "fes:SortProperty>"
        "<fes:SortProperty><fes:Function name='distance'>" +
        where +
        "<fes:Literal>desk</fes:Literal></fes:Function></fes:SortProperty>"
        "</fes:SortBy>";
    auto const alone = query(sort_by);
    EXPECT_FALSE(alone.filter);
    EXPECT_THAT(alone.sort_by, ElementsAre(SortProperty{reference("name"), SortOrder::descending},
                                           SortProperty{{Function{"distance", {reference("location"), literal("desk")}}}}));
    auto const both = query("<fes:Filter>" + is_ready + "</fes:Filter>" + sort_by);
    EXPECT_EQ(both.filter, equal("status", "READY"));
    EXPECT_EQ(both.sort_by, alone.sort_by);
    EXPECT_THAT(query("<unr:SearchCondition/>" + sort_by).sort_by, SizeIs(2));
}

TEST(SearchCondition, WithoutConditionsRestrictsNothing) {
    EXPECT_FALSE(condition("<unr:SearchCondition/>"));
    EXPECT_FALSE(condition("<unr:SearchCondition><!-- nothing --></unr:SearchCondition>"));
    EXPECT_FALSE(condition("<unr:SearchCondition>\n</unr:SearchCondition>"));
}

TEST(SearchCondition, OfAComponentHasTypeModeAndFilter) {
    auto const component = [](std::string const& attributes, std::string const& inside) {
        return condition("<unr:SearchCondition><unr:ComponentCondition " + attributes + ">" + inside +
                         "</unr:ComponentCondition></unr:SearchCondition>");
    };
    auto const any_of = [](std::vector<Condition> all) { return Condition{Or{{Condition{And{std::move(all)}}}}}; };
    auto const of_type = [](std::string type) {
        return Condition{ComponentGroup{.types = {std::move(type)}, .aliases = {}, .filter = {}, .members = {}}};
    };
    auto const type = of_type("urn:x-rois:def:component:OMG::Move");
    EXPECT_EQ(component("type=' Move '", ""), any_of({of_type("Move")}));
    EXPECT_EQ(component("id='a' type='urn:x-rois:def:component:OMG::Move'", ""), any_of({type}));
    EXPECT_EQ(component("type='unr:x-rois:def:component:OMG::Move'", ""), any_of({type})) << "as the published example spells it";
    EXPECT_EQ(component("mode='exclusive'", ""), any_of({Condition{Not{{equal("status", "BUSY")}}}}));
    EXPECT_EQ(component("mode='shared'", ""), any_of({}));
    for (auto const& written :
         {is_ready, "<fes:Filter>" + is_ready + "</fes:Filter>", "<fes:filter>" + is_ready + "</fes:filter>"})
        EXPECT_EQ(component("", written), any_of({equal("status", "READY")}));
    EXPECT_EQ(component("", "<fes:filter/>"), any_of({}));
    EXPECT_THAT(reason_in(the<Or>(*component("mode='quiet'", "")).operands.front()), HasSubstr("the mode quiet"));
}

TEST(SearchCondition, OfAGroupHasTypesAliasesAFilterAndMembers) {
    auto const read = [](std::string const& inside) {
        return the<Or>(*condition("<unr:SearchCondition>" + inside + "</unr:SearchCondition>")).operands.front();
    };
    auto const group =
        the<ComponentGroup>(read("<unr:ComponentGroupCondition types=' Robot  unr:a:Move' aliases='a b'>" + is_ready +
                                 "<unr:ComponentCondition/><unr:ComponentCondition type='t'/></unr:ComponentGroupCondition>"));
    EXPECT_THAT(group.types, ElementsAre("Robot", "urn:a:Move"));
    EXPECT_THAT(group.aliases, ElementsAre("a", "b"));
    EXPECT_THAT(group.filter, ElementsAre(equal("status", "READY")));
    EXPECT_THAT(
        group.members,
        ElementsAre(Condition{And{}},
                    Condition{And{{Condition{ComponentGroup{.types = {"t"}, .aliases = {}, .filter = {}, .members = {}}}}}}));
    EXPECT_THAT(the<ComponentGroup>(read("<unr:ComponentGroupCondition/>")).members, IsEmpty());
    EXPECT_THAT(reason_in(read("<unr:ComponentGroupCondition types='a' aliases='b c'/>")), HasSubstr("aliases"));
}

}  // namespace
}  // namespace rois::xml
