// Conditions and units, without an engine.
#include "rois/condition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "xml/codec/codec.hpp"

namespace rois::test {
namespace {

using namespace rois::conditions;

// Returns XML in a short form: names without prefixes, (Element attribute=value ...), 'literal', reference.
std::string short_form(pugi::xml_node element) {
    std::string const name{std::string_view{element.name()}.substr(std::string_view{element.name()}.find(':') + 1)};
    bool const literal = name == "Literal" && !element.first_child().first_child();
    if (literal) return "'" + std::string{element.text().get()} + "'";
    if (name == "ValueReference") return element.text().get();
    auto form = "(" + name;
    for (auto const attribute : element.attributes()) form += std::string{" "} + attribute.name() + "=" + attribute.value();
    for (auto const child : element.children())
        form += " " + (child.type() == pugi::node_pcdata ? child.value() : short_form(child));
    return form + ")";
}

std::string written(QueryExpression condition) {
    pugi::xml_document document;
    document.load_string(xml::encode(Request{Search{std::move(condition)}, {}}).c_str());
    return short_form(document.document_element().child("condition"));
}

Utc at(std::string const& time) { return *to_utc(time); }

TEST(AConditionInCode, IsWrittenAsFilterEncoding) {
    Reference const number{"number"};
    auto const a = number == 1;
    auto const b = status == "READY";
    auto const c = bound == false;
    struct Row {
        Condition condition;
        std::string filter;
    };
    for (auto const& [condition, filter] : std::vector<Row>{
             {type == "Navigation", "(PropertyIsEqualTo component_type 'urn:x-rois:def:component:OMG::Navigation')"},
             {type != "urn:my:type", "(PropertyIsNotEqualTo component_type 'urn:my:type')"},
             {b, "(PropertyIsEqualTo status 'READY')"},
             {c, "(PropertyIsEqualTo bound 'false')"},
             {engine != std::string{"sub1"}, "(PropertyIsNotEqualTo engine 'sub1')"},
             {result("number") > 0, "(PropertyIsGreaterThan Result/number '0')"},
             {parameter("volume") <= 50U, "(PropertyIsLessThanOrEqualTo Property/volume '50')"},
             {number < -0.5, "(PropertyIsLessThan number '-0.5')"},
             {parameter("distance") >= 1.5_m, "(PropertyIsGreaterThanOrEqualTo Property/distance '1500')"},
             {result("th") == 90_deg, "(PropertyIsEqualTo Result/th '90')"},
             {timestamp >= at("2026-11-20T12:00:00Z"), "(PropertyIsGreaterThanOrEqualTo timestamp '2026-11-20T12:00:00.000Z')"},
             {number.between(1, 3), "(PropertyIsBetween number (LowerBoundary '1') (UpperBoundary '3'))"},
             {component_ref.like("nav*"), "(PropertyIsLike wildCard=* singleChar=? escapeChar=\\ component_ref 'nav*')"},
             {number.is_null(), "(PropertyIsNull number)"},
             {position.within({11500_mm, 8200_mm, 7500_mm, 10200_mm}),
              "(Within position_data (Envelope (lowerCorner 7500 8200) (upperCorner 11500 10200)))"},
             {position.within({0_m, 0_m, 1_m, 1_m, "urn:my:map"}),
              "(Within position_data (Envelope srsName=urn:my:map (lowerCorner 0 0) (upperCorner 1000 1000)))"},
             {location.within("entrance"), "(Within location 'entrance')"},
             {location.near("desk", 2_m), "(DWithin location 'desk' (Distance uom=mm 2000))"},
             {position.near(Pose{1_m, 2_m}, 250_mm), "(DWithin position_data (Point (pos 1000 2000)) (Distance uom=mm 250))"},
             {timestamp.after(at("2026-11-20T12:00:00Z")),
              "(After timestamp (TimeInstant (timePosition 2026-11-20T12:00:00.000Z)))"},
             {timestamp.before(at("2026-11-20T12:00:00Z")),
              "(Before timestamp (TimeInstant (timePosition 2026-11-20T12:00:00.000Z)))"},
             {timestamp.during({at("2026-11-20T12:00:00Z"), at("2026-11-20T13:00:00Z")}),
              "(During timestamp (TimePeriod (beginPosition 2026-11-20T12:00:00.000Z) (endPosition 2026-11-20T13:00:00.000Z)))"},
         })
        EXPECT_EQ(written(condition), "(condition (Filter " + filter + "))");

    auto const [x, y, z] =
        std::tuple{"(PropertyIsEqualTo number '1')", "(PropertyIsEqualTo status 'READY')", "(PropertyIsEqualTo bound 'false')"};
    auto const of = [](std::string const& all, auto... each) { return "(" + all + ((" " + std::string{each}) + ...) + ")"; };
    auto const filter = [&](std::string const& predicate) { return of("condition", of("Filter", predicate)); };
    EXPECT_EQ(written(a && b && c), filter(of("And", x, y, z))) << "one And with three operands";
    EXPECT_EQ(written(a || b || c), filter(of("Or", x, y, z)));
    EXPECT_EQ(written(a && (b || !c)), filter(of("And", x, of("Or", y, of("Not", z)))));
    EXPECT_EQ(written(narrowed(b, a)), filter(of("And", x, y)));
    EXPECT_EQ(written(narrowed({}, a)), filter(x));
}

TEST(AConditionInCode, SetsTheOrder) {
    EXPECT_EQ(written(ordered(type == "Move", nearest_to("desk"), descending(parameter("volume")), ascending(component_ref))),
              "(condition (Filter (PropertyIsEqualTo component_type 'urn:x-rois:def:component:OMG::Move')) (SortBy "
              "(SortProperty (Function name=distance location 'desk')) "
              "(SortProperty Property/volume (SortOrder DESC)) (SortProperty component_ref)))");
    EXPECT_EQ(written({}), "()") << "no condition";
}

// --- Units ---

TEST(Units, CalculateOnlyWithTheSameUnit) {
    EXPECT_EQ(1.5_m, 1500_mm);
    EXPECT_EQ(2_m + 3_mm - 1_mm, 2002_mm);
    EXPECT_EQ(-90_deg * 2, 4.0 * -45_deg);
    EXPECT_EQ(90_deg / 2, 45_deg);
    EXPECT_DOUBLE_EQ(3_m / 1500_mm, 2);
    EXPECT_LT(999_mm, 1_m);
    static_assert(!std::is_convertible_v<double, millimetres> && !std::is_convertible_v<millimetres, double>);
    static_assert(!std::is_convertible_v<degrees, millimetres>);
}

TEST(Units, ComputeDistancesAndPoses) {
    EXPECT_EQ(distance(Pose{0_m, 0_m}, Pose{3_m, -4_m}), 5_m);
    auto const place = before(Pose{1_m, 1_m, 90_deg, "urn:my:map"}, 2_m);
    EXPECT_EQ(to_text(place), "1000, 3000, 270") << "they look at each other";
    EXPECT_EQ(place.crs, "urn:my:map");
    EXPECT_EQ(to_text(before(Pose{1_m, 1_m, 90_deg}, 2_m, 90_deg)), "-1000, 1000, 360") << "to their left";
}

TEST(Units, AreReadFromText) {
    struct Row {
        std::string text;
        std::optional<Pose> pose;
    };
    for (auto const& [text, pose] : std::vector<Row>{
             {"9500, 6000, 90", Pose{9500_mm, 6_m, 90_deg}},
             {"-1.5,2e3", Pose{-1.5_mm, 2_m}},
             {" 1 , 2 , -3 ", Pose{1_mm, 2_mm, -3_deg}},
             {"", {}},
             {"1", {}},
             {"1, 2, 3, 4", {}},
             {"1, 2,", {}},
             {"desk", {}},
             {"1, inf", {}},
             {"nan, 1", {}},
         })
        EXPECT_EQ(to_pose(text), pose) << text;
    EXPECT_EQ(to_pose("1, 2", "urn:my:map")->crs, "urn:my:map");
    EXPECT_EQ(to_text(Pose{0.12345_mm, -0.0001_mm, 33.3333_deg}), "0.123, 0, 33.333");
}

}  // namespace
}  // namespace rois::test
