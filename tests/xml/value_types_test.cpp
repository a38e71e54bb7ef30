// Simple types and facets of the tables: what the tables accept, what they leave to xerces-c, and that they never accept what
// xerces-c rejects.
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/pieces.hpp"
#include "xml/small_schema.hpp"

namespace rois::xml {
namespace {

struct TypeCase {
    std::string_view type;  // the content of its xsd:simpleType
    std::vector<std::string_view> accepted;
    std::vector<std::string_view> left;     // left to xerces-c, which accepts them
    std::vector<std::string_view> refused;  // rejected by xerces-c
};

void PrintTo(TypeCase const& of, std::ostream* out) { *out << of.type; }

class Type : public testing::TestWithParam<TypeCase> {};

TEST_P(Type, AcceptsOnlyValuesThatXercesAccepts) {
    auto const& [type, accepted, left, refused] = GetParam();
    std::string declarations{R"(<xsd:simpleType name="T">)"};
    declarations.append(type)
        .append(R"(</xsd:simpleType><xsd:element name="root"><xsd:complexType><xsd:choice>)")
        .append(R"(<xsd:element name="e" type="T"/><xsd:element name="none" type="xsd:string"/></xsd:choice>)")
        .append(R"(<xsd:attribute name="a" type="T"/></xsd:complexType></xsd:element>)")
        .append(R"(<xsd:element name="plain" type="T"/>)");
    Small schema{declarations};
    auto const element = [](std::string_view value) { return std::string{"<e>"}.append(value).append("</e>"); };
    auto const expect = [&](std::vector<std::string_view> const& values, Outcome outcome) {
        for (auto const value : values) EXPECT_EQ(schema.root(element(value)), outcome) << '"' << value << '"';
    };
    expect(accepted, Outcome::both);
    expect(left, Outcome::xerces_only);
    expect(refused, Outcome::neither);
    // For any value, as content and as attribute, with white space around and inside: accepts nothing that xerces-c rejects.
    auto const expect_no_wrong_acceptance = [&](std::string const& text) {
        schema.root(element(text));
        schema.root("<none/>", " a=\"" + text + "\"");
    };
    for (auto const value : fuzz::values) {
        for (std::string const space : {"", " ", "\r\n", "&#x9;"})
            expect_no_wrong_acceptance((space + std::string{value}).append(space));
        expect_no_wrong_acceptance(std::string{value}.append(" ").append(value));
    }
}

constexpr std::string_view positive_list =
    R"(<xsd:restriction><xsd:simpleType><xsd:list itemType="xsd:positiveInteger"/></xsd:simpleType>)"
    R"(<xsd:minLength value="2"/><xsd:maxLength value="3"/></xsd:restriction>)";

INSTANTIATE_TEST_SUITE_P(
    Tables, Type,
    testing::Values(
        TypeCase{R"(<xsd:restriction base="xsd:string"/>)",
                 {"", " a ", "\n", "a&amp;b", "&#x1F600;", "\xC3\xA9", "]] >", "a ]] b"},
                 {"<![CDATA[a]]>", "a<!-- -->"},
                 {"<b/>"}},
        TypeCase{R"(<xsd:restriction base="xsd:normalizedString"/>)", {"", "a\tb"}, {}, {}},
        TypeCase{R"(<xsd:restriction base="xsd:token"/>)", {"", " a  b "}, {}, {}},
        TypeCase{
            R"(<xsd:restriction base="xsd:string"><xsd:enumeration value="OK"/><xsd:enumeration value="a b"/></xsd:restriction>)",
            {"OK", "a b"},
            {"O&#75;"},
            {" OK", "ok", "", "a\tb"}},
        TypeCase{R"(<xsd:restriction base="xsd:normalizedString"><xsd:enumeration value="a b"/></xsd:restriction>)",
                 {"a b"},
                 {"a\tb"},
                 {"a  b", " a b"}},
        TypeCase{R"(<xsd:restriction base="xsd:token"><xsd:enumeration value="a b"/></xsd:restriction>)",
                 {"a b", " a b\n"},
                 {"a  b", "a\tb"},
                 {"ab"}},
        TypeCase{R"(<xsd:restriction base="xsd:string"><xsd:enumeration value=""/></xsd:restriction>)", {""}, {}, {" ", "a"}},
        TypeCase{R"(<xsd:restriction base="xsd:string"><xsd:enumeration value="a&amp;b"/></xsd:restriction>)",
                 {},
                 {"a&amp;b"},
                 {"ab"}},
        TypeCase{
            R"(<xsd:restriction><xsd:simpleType><xsd:restriction base="xsd:string"><xsd:enumeration value="a"/><xsd:enumeration value="b"/></xsd:restriction></xsd:simpleType><xsd:enumeration value="b"/></xsd:restriction>)",
            {"b"},
            {},
            {"a"}},
        TypeCase{R"(<xsd:restriction base="xsd:string"><xsd:length value="2"/></xsd:restriction>)",
                 {"ab"},
                 {"a ", "\xC3\xA9\xC3\xA9", "a&amp;"},
                 {"a", "abc"}},
        TypeCase{R"(<xsd:restriction base="xsd:string"><xsd:minLength value="2"/><xsd:maxLength value="3"/></xsd:restriction>)",
                 {"ab", "abc"},
                 {"a b"},
                 {"a", "abcd", "\xC3\xA9", "&lt;"}},
        TypeCase{R"(<xsd:restriction base="xsd:token"><xsd:minLength value="1"/></xsd:restriction>)", {"a"}, {" a"}, {"", " "}},
        TypeCase{R"(<xsd:restriction base="xsd:string"><xsd:pattern value="[ab]+"/></xsd:restriction>)", {}, {"a", "ab"}, {"c"}},
        TypeCase{
            R"(<xsd:restriction base="xsd:string"><xsd:whiteSpace value="collapse"/><xsd:enumeration value="a"/></xsd:restriction>)",
            {"a", " a "},
            {},
            {"b"}},
        TypeCase{
            R"(<xsd:restriction base="xsd:boolean"/>)", {"true", "false", "1", "0", " true "}, {"t&#114;ue"}, {"TRUE", "", "2"}},
        TypeCase{R"(<xsd:restriction base="xsd:double"/>)",
                 {"0", "-1.5", "1e5", "1E-3", "007", " 1 ", "-0"},
                 {"INF", "NaN", "+1", ".5", "5.", "1e400"},
                 {"", "1 2", "x", "1e", "0x1"}},
        TypeCase{
            R"(<xsd:restriction base="xsd:double"><xsd:minInclusive value="0"/><xsd:maxInclusive value="1"/></xsd:restriction>)",
            {"0", "1", "0.5", "1.0", "1e-5"},
            {"-0"},
            {"-1", "1.5", "1.0001", "INF"}},
        TypeCase{
            R"(<xsd:restriction base="xsd:double"><xsd:minExclusive value="0"/><xsd:maxExclusive value="1"/></xsd:restriction>)",
            {"0.5", "1e-30"},
            {},
            {"0", "1", "1.0", "-0"}},
        TypeCase{R"(<xsd:restriction base="xsd:double"><xsd:enumeration value="1"/></xsd:restriction>)", {}, {"1", "1.0"}, {"2"}},
        TypeCase{R"(<xsd:restriction base="xsd:float"/>)", {}, {"1"}, {"x"}},
        TypeCase{R"(<xsd:restriction base="xsd:decimal"/>)",
                 {"0", "-1.5", "123456789012345"},
                 {"1234567890123456", "+1", ".5"},
                 {"1e5", "INF", ""}},
        TypeCase{
            R"(<xsd:restriction base="xsd:decimal"><xsd:minInclusive value="0.1"/><xsd:maxExclusive value="0.3"/></xsd:restriction>)",
            {"0.1", "0.10", "0.29999999999999"},
            {},
            {"0.3", "0.09999999999999", "0.30"}},
        TypeCase{R"(<xsd:restriction base="xsd:decimal"><xsd:minInclusive value="0.1234567890123456789"/></xsd:restriction>)",
                 {},
                 {"0.2"},
                 {"0.1"}},
        TypeCase{R"(<xsd:restriction base="xsd:decimal"><xsd:totalDigits value="3"/></xsd:restriction>)", {}, {"1.5"}, {"1234"}},
        TypeCase{
            R"(<xsd:restriction base="xsd:decimal"><xsd:fractionDigits value="1"/></xsd:restriction>)", {}, {"1.5"}, {"1.55"}},
        TypeCase{R"(<xsd:restriction base="xsd:integer"/>)",
                 {"0", "-1", "007", "999999999999999"},
                 {"1000000000000000", "+1"},
                 {"1.0", "", "1e3", "--1"}},
        TypeCase{R"(<xsd:restriction base="xsd:nonNegativeInteger"><xsd:maxInclusive value="130"/></xsd:restriction>)",
                 {"0", "130"},
                 {"-0"},
                 {"131", "-1"}},
        TypeCase{R"(<xsd:restriction base="xsd:positiveInteger"/>)", {"1", "01"}, {}, {"0", "-1"}},
        TypeCase{R"(<xsd:restriction base="xsd:negativeInteger"/>)", {"-1"}, {}, {"0", "1"}},
        TypeCase{R"(<xsd:restriction base="xsd:unsignedLong"/>)",
                 {"0", "1"},
                 {"18446744073709551615"},
                 {"18446744073709551616", "-1"}},
        TypeCase{R"(<xsd:restriction base="xsd:byte"/>)", {"127", "-128"}, {}, {"128", "-129"}},
        TypeCase{R"(<xsd:restriction base="xsd:int"><xsd:minExclusive value="5"/></xsd:restriction>)", {"6"}, {}, {"5"}},
        TypeCase{R"(<xsd:restriction base="xsd:integer"><xsd:pattern value="[0-9]{2}"/></xsd:restriction>)", {}, {"12"}, {"1"}},
        TypeCase{R"(<xsd:restriction base="xsd:dateTime"/>)",
                 {"2026-11-20T12:00:00Z", "2026-11-20T12:00:00.5+01:00", " 2026-02-28T23:59:59 "},
                 {"2024-02-29T00:00:00Z", "2026-11-20T24:00:00Z", "10000-01-01T00:00:00Z"},
                 {"2026-02-30T00:00:00Z", "2026-11-20", "now", ""}},
        TypeCase{
            R"(<xsd:restriction base="xsd:date"/>)", {"2026-11-20", "2026-11-20Z"}, {"2024-02-29"}, {"2026-11-31", "2026-13-01"}},
        TypeCase{R"(<xsd:restriction base="xsd:date"><xsd:minInclusive value="2026-01-01"/></xsd:restriction>)",
                 {},
                 {"2026-11-20"},
                 {"2025-11-20"}},
        TypeCase{R"(<xsd:restriction base="xsd:time"/>)", {"12:00:00", "12:00:00.5Z"}, {"24:00:00"}, {"12:00", "25:00:00"}},
        TypeCase{R"(<xsd:restriction base="xsd:gYearMonth"/>)", {"2026-11"}, {}, {"2026-13"}},
        TypeCase{R"(<xsd:restriction base="xsd:gYear"/>)", {"2026", "2026Z"}, {"-2026"}, {"26"}},
        TypeCase{R"(<xsd:restriction base="xsd:duration"/>)",
                 {"PT8H", "P1Y2M3DT4H5M6S", "P1D"},
                 {"-P1D", "PT1.5S"},
                 {"P", "PT", "P1YT", "1D"}},
        TypeCase{R"(<xsd:restriction base="xsd:NCName"/>)", {"a", "_a-1.b", " a "}, {"\xC3\xA9"}, {"1a", "a:b", ""}},
        TypeCase{R"(<xsd:restriction base="xsd:QName"/>)", {"a", "t:a"}, {"xml:a"}, {"none:a", ":a"}},
        TypeCase{R"(<xsd:restriction base="xsd:ID"/>)", {"a"}, {" a"}, {"1", "a:b"}},
        TypeCase{R"(<xsd:restriction base="xsd:anyURI"/>)", {}, {"urn:a"}, {}},
        TypeCase{R"(<xsd:restriction base="xsd:language"/>)", {}, {"en"}, {"a_b"}},
        TypeCase{R"(<xsd:restriction base="xsd:NMTOKEN"/>)", {}, {"a"}, {"a b"}},
        TypeCase{R"(<xsd:restriction base="xsd:hexBinary"/>)", {}, {"0A"}, {"0"}},
        TypeCase{R"(<xsd:list itemType="xsd:double"/>)", {"", "1", " 1 2.5\t-3e4\n"}, {"1 INF"}, {"1,2", "1 x"}},
        TypeCase{positive_list, {"1 2", " 1 2 3 "}, {}, {"1", "1 2 3 4", "0 1", ""}},
        TypeCase{R"(<xsd:list itemType="xsd:string"/>)", {}, {"a b"}, {}},
        TypeCase{R"(<xsd:list itemType="xsd:ID"/>)", {}, {"a b"}, {"1"}},
        TypeCase{
            R"(<xsd:restriction><xsd:simpleType><xsd:list itemType="xsd:integer"/></xsd:simpleType><xsd:enumeration value="1 2"/></xsd:restriction>)",
            {},
            {"1 2"},
            {"1 3"}},
        TypeCase{R"(<xsd:union memberTypes="xsd:positiveInteger xsd:dateTime"/>)",
                 {"1", "2026-11-20T12:00:00Z"},
                 {" 1"},
                 {"0", "a", ""}},
        TypeCase{R"(<xsd:union memberTypes="xsd:boolean xsd:string"/>)", {"true"}, {"a", ""}, {}},
        TypeCase{
            R"(<xsd:union memberTypes="xsd:integer"><xsd:simpleType><xsd:restriction base="xsd:string"><xsd:enumeration value="a"/><xsd:enumeration value=""/></xsd:restriction></xsd:simpleType></xsd:union>)",
            {"a", "", "-5"},
            {" a"},
            {"b"}},
        TypeCase{
            R"(<xsd:restriction><xsd:simpleType><xsd:union memberTypes="xsd:integer xsd:boolean"/></xsd:simpleType><xsd:enumeration value="1"/></xsd:restriction>)",
            {},
            {"1"},
            {"2"}}));

}  // namespace
}  // namespace rois::xml
