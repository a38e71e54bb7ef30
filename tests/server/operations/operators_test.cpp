// Every spatial and temporal operator (ISO 19143), in cases that satisfy it and in cases that do not.
#include <ostream>
#include <tuple>

#include "server/conversation.hpp"
#include "server/operations/geometries.hpp"

namespace rois::test {
namespace {

using testing::SizeIs;

// An operator, and the cases that satisfy it.
struct Operator {
    std::string name;
    std::vector<std::string> met_by;
};

std::ostream& operator<<(std::ostream& out, Operator const& each) { return out << each.name; }

struct TestOfOperator : testing::TestWithParam<Operator> {
    TestOfOperator() { desk.connect(); }

    // Returns whether two literal operands satisfy the operator.
    bool is_met(Xml const& one, Xml const& other) {
        auto const found = desk.search(where(element("fes:" + GetParam().name, one + other)));
        EXPECT_THAT(found, testing::AnyOf(IsEmpty(), SizeIs(15)));
        return !found.empty();
    }

    Application desk{Way::http, empty_hall()};
};

// One case for each of the thirteen relations of two periods (ISO 19108), and for those of an instant and a period.
struct TemporalOperators : TestOfOperator {};

TEST_P(TemporalOperators, AreMet) {
    auto const hours = [](int begin, int end) {
        auto const time = [](int hour) { return "2026-11-20T" + std::to_string(hour) + ":00:00Z"; };
        return begin == end ? gml("TimeInstant", text_element("gml:timePosition", time(begin))) : period(time(begin), time(end));
    };
    std::vector<std::tuple<std::string, Xml, Xml>> const cases{
        {"before", hours(10, 12), hours(13, 15)},         {"after", hours(13, 15), hours(10, 12)},
        {"meets", hours(10, 12), hours(12, 15)},          {"met by", hours(12, 15), hours(10, 12)},
        {"overlaps", hours(10, 13), hours(12, 15)},       {"overlapped by", hours(12, 15), hours(10, 13)},
        {"begins", hours(10, 12), hours(10, 15)},         {"begun by", hours(10, 15), hours(10, 12)},
        {"ends", hours(12, 15), hours(10, 15)},           {"ended by", hours(10, 15), hours(12, 15)},
        {"during", hours(12, 13), hours(10, 15)},         {"contains", hours(10, 15), hours(12, 13)},
        {"equals", hours(10, 15), hours(10, 15)},         {"instant before", hours(10, 10), hours(12, 15)},
        {"instant begins", hours(12, 12), hours(12, 15)}, {"instant during", hours(13, 13), hours(12, 15)},
        {"instant ends", hours(15, 15), hours(12, 15)},   {"ended by instant", hours(12, 15), hours(15, 15)},
    };
    std::vector<std::string> met_by;
    for (auto const& [name, one, other] : cases)
        if (is_met(one, other)) met_by.push_back(name);
    EXPECT_EQ(met_by, GetParam().met_by);
}

INSTANTIATE_TEST_SUITE_P(
    Over, TemporalOperators,
    testing::Values(Operator{"Before", {"before", "instant before"}}, Operator{"After", {"after"}}, Operator{"Meets", {"meets"}},
                    Operator{"MetBy", {"met by"}}, Operator{"TOverlaps", {"overlaps"}},
                    Operator{"OverlappedBy", {"overlapped by"}}, Operator{"Begins", {"begins", "instant begins"}},
                    Operator{"BegunBy", {"begun by"}}, Operator{"Ends", {"ends", "instant ends"}},
                    Operator{"EndedBy", {"ended by", "ended by instant"}}, Operator{"During", {"during", "instant during"}},
                    Operator{"TContains", {"contains"}}, Operator{"TEquals", {"equals"}},
                    Operator{"AnyInteracts",
                             {"overlaps", "overlapped by", "begins", "begun by", "ends", "ended by", "during", "contains",
                              "equals", "instant begins", "instant during", "instant ends", "ended by instant"}}),
    testing::PrintToStringParamName());

struct SpatialOperators : TestOfOperator {};

TEST_P(SpatialOperators, AreMet) {
    auto const square = ring("0 0 4 0 4 4 0 4 0 0");
    auto const line = [](std::string const& points) { return gml("LineString", text_element("gml:posList", points)); };
    std::vector<std::tuple<std::string, Xml, Xml>> const cases{
        {"equal areas", square, box("0 0", "4 4")},
        {"areas apart", square, circle("9 9", "1", "mm")},
        {"areas side by side", square, ring("4 0 8 0 8 4 4 0")},
        {"point on the edge", square, gml("Point", text_element("gml:pos", "4 2"))},
        {"areas that overlap", square, box("2 2", "6 6")},
        {"area with a circle in it", square, circle("2 2", "1", "mm")},
        {"circle in an area", circle("2 2", "1", "mm"), square},
        {"line through an area", line("-1 2 5 2"), square},
        {"lines that cross", line("0 0 4 4"), line("0 4 4 0")},
        {"lines along each other", line("0 0 4 0"), line("2 0 6 0")},
        {"equal points", gml("Point", text_element("gml:pos", "4 2")), box("4 2", "4 2")},
    };
    std::vector<std::string> met_by;
    for (auto const& [name, one, other] : cases)
        if (is_met(one, other)) met_by.push_back(name);
    EXPECT_EQ(met_by, GetParam().met_by);
}

INSTANTIATE_TEST_SUITE_P(Over, SpatialOperators,
                         testing::Values(Operator{"Equals", {"equal areas", "equal points"}},
                                         Operator{"Disjoint", {"areas apart"}},
                                         Operator{"Touches", {"areas side by side", "point on the edge"}},
                                         Operator{"Overlaps", {"areas that overlap", "lines along each other"}},
                                         Operator{"Crosses", {"line through an area", "lines that cross"}}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace rois::test
