// Facets, content models and attributes, one by one, with small schemas: what the tables accept, what they leave to xerces-c, and
// that xerces-c accepts whatever they accept.
#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/comparison.hpp"
#include "fuzz/pieces.hpp"
#include "speaking.hpp"

namespace rois::xml {
namespace {

using Outcome = fuzz::Comparison::Outcome;

// A schema with these declarations, for the namespace urn:t, and both judges of its documents.
class Small {
public:
    explicit Small(std::string_view declarations) {
        static Platform const platform;
        text_.append(R"(<xsd:schema xmlns:xsd="http://www.w3.org/2001/XMLSchema" xmlns="urn:t" xmlns:t="urn:t")")
            .append(R"( targetNamespace="urn:t" elementFormDefault="qualified">)")
            .append(declarations)
            .append("</xsd:schema>");
        comparison_.emplace(std::make_shared<Schemas const>(NamedFiles{{"t.xsd", text_}}));
    }

    // `<root xmlns="urn:t">` around what is inside, with attributes.
    Outcome root(std::string_view inside, std::string_view attributes = {}) {
        std::string document{R"(<root xmlns="urn:t" xmlns:t="urn:t" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance")"};
        document.append(attributes).append(">").append(inside).append("</root>");
        auto const outcome = comparison_->look_at(document);
        EXPECT_NE(outcome, Outcome::wrong) << text_ << '\n' << document << '\n' << comparison_->complaint();
        return outcome;
    }

private:
    std::string text_;
    std::optional<fuzz::Comparison> comparison_;
};

struct TypeCase {
    std::string_view type;  // its definition: what stands in xsd:simpleType
    std::vector<std::string_view> accepted;
    std::vector<std::string_view> left;     // to xerces-c, which accepts them
    std::vector<std::string_view> refused;  // by xerces-c
};

void PrintTo(TypeCase const& of, std::ostream* out) { *out << of.type; }

class Type : public testing::TestWithParam<TypeCase> {};

TEST_P(Type, IsAcceptedAsFarAsItIsKnown) {
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
    // Whatever the value, never more than xerces-c; as content and as an attribute, with white space around and inside.
    auto const nobody_differs = [&](std::string const& text) {
        schema.root(element(text));
        schema.root("<none/>", " a=\"" + text + "\"");
    };
    for (auto const value : fuzz::values) {
        for (std::string const blank : {"", " ", "\r\n", "&#x9;"}) nobody_differs((blank + std::string{value}).append(blank));
        nobody_differs(std::string{value}.append(" ").append(value));
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

enum class Known { yes, no };

struct ContentCase {
    std::string_view type;  // what stands in xsd:complexType
    Known known = Known::yes;
};

void PrintTo(ContentCase const& of, std::ostream* out) { *out << of.type; }

class Content : public testing::TestWithParam<ContentCase> {};

// All sequences of a, b and c of up to so many elements.
std::vector<std::string> sequences(std::size_t longest) {
    std::vector<std::string> all{""};
    for (std::size_t begin = 0, length = 0; length < longest; ++length) {
        auto const end = all.size();
        for (; begin < end; ++begin) {
            for (auto const* next : {"<a/>", "<b/>", "<c/>"}) all.push_back(all[begin] + next);
        }
    }
    return all;
}

TEST_P(Content, IsAcceptedJustAsXercesDoes) {
    auto const& [type, known] = GetParam();
    std::string declarations{
        R"(<xsd:element name="a"><xsd:complexType/></xsd:element><xsd:element name="b"><xsd:complexType/></xsd:element>)"
        R"(<xsd:element name="c"><xsd:complexType/></xsd:element><xsd:element name="root"><xsd:complexType)"};
    Small schema{declarations.append(type).append("</xsd:complexType></xsd:element>")};
    std::size_t valid = 0;
    for (auto const& children : sequences(6)) {
        auto const outcome = schema.root(children);
        if (outcome != Outcome::neither) {
            EXPECT_EQ(outcome, known == Known::yes ? Outcome::both : Outcome::xerces_only) << children;
            ++valid;
        }
    }
    EXPECT_GT(valid, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, Content,
    testing::Values(
        ContentCase{R"(>)"}, ContentCase{R"(><xsd:sequence><xsd:element ref="a"/></xsd:sequence>)"},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" minOccurs="0"/></xsd:sequence>)"},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" maxOccurs="unbounded"/></xsd:sequence>)"},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" minOccurs="0" maxOccurs="unbounded"/></xsd:sequence>)"},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" minOccurs="2" maxOccurs="4"/></xsd:sequence>)"},
        ContentCase{
            R"(><xsd:sequence><xsd:element ref="a" minOccurs="2" maxOccurs="unbounded"/><xsd:element ref="b"/></xsd:sequence>)"},
        ContentCase{
            R"(><xsd:sequence><xsd:element ref="a"/><xsd:element ref="b" minOccurs="0"/><xsd:element ref="c"/></xsd:sequence>)"},
        ContentCase{R"(><xsd:choice><xsd:element ref="a"/><xsd:element ref="b"/></xsd:choice>)"},
        ContentCase{
            R"(><xsd:choice minOccurs="0" maxOccurs="unbounded"><xsd:element ref="a"/><xsd:element ref="b" maxOccurs="2"/></xsd:choice>)"},
        ContentCase{R"(><xsd:choice minOccurs="2" maxOccurs="3"><xsd:element ref="a"/><xsd:element ref="c"/></xsd:choice>)"},
        ContentCase{
            R"(><xsd:choice maxOccurs="2"><xsd:choice><xsd:element ref="a"/><xsd:element ref="b"/></xsd:choice><xsd:element ref="c"/></xsd:choice>)"},
        ContentCase{
            R"(><xsd:sequence minOccurs="0" maxOccurs="unbounded"><xsd:element ref="a"/><xsd:element ref="b" minOccurs="0"/></xsd:sequence>)"},
        ContentCase{
            R"(><xsd:sequence maxOccurs="2"><xsd:element ref="a"/><xsd:choice minOccurs="0"><xsd:element ref="b"/><xsd:element ref="c"/></xsd:choice></xsd:sequence>)"},
        ContentCase{
            R"(><xsd:sequence><xsd:sequence minOccurs="0"><xsd:element ref="a"/><xsd:element ref="b"/></xsd:sequence><xsd:element ref="c" minOccurs="0"/></xsd:sequence>)"},
        ContentCase{
            R"(><xsd:choice><xsd:sequence><xsd:element ref="a"/><xsd:element ref="b"/></xsd:sequence><xsd:sequence><xsd:element ref="c"/><xsd:element ref="b"/></xsd:sequence></xsd:choice>)"},
        ContentCase{R"(><xsd:choice><xsd:element ref="a" minOccurs="0"/><xsd:element ref="b"/></xsd:choice>)"},
        ContentCase{R"( mixed="true"><xsd:sequence><xsd:element ref="a"/><xsd:element ref="b" minOccurs="0"/></xsd:sequence>)"},
        ContentCase{
            R"( mixed="true"><xsd:choice minOccurs="0" maxOccurs="unbounded"><xsd:element ref="a"/><xsd:element ref="b"/></xsd:choice>)"},
        ContentCase{R"(><xsd:all><xsd:element ref="a"/><xsd:element ref="b" minOccurs="0"/></xsd:all>)", Known::no},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a"/><xsd:any namespace="##any" processContents="lax"/></xsd:sequence>)",
                    Known::no},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" minOccurs="0" maxOccurs="1000"/></xsd:sequence>)", Known::no},
        ContentCase{R"(><xsd:sequence><xsd:element ref="a" minOccurs="0" maxOccurs="300"/></xsd:sequence>)"}));

// A particle as one might write it, or not.
std::string any_particle(std::mt19937& random, int depth) {
    static constexpr std::array occurrences{"",
                                            "",
                                            "",
                                            " minOccurs='0'",
                                            " maxOccurs='unbounded'",
                                            " minOccurs='0' maxOccurs='unbounded'",
                                            " minOccurs='2' maxOccurs='3'",
                                            " minOccurs='0' maxOccurs='2'",
                                            " minOccurs='2' maxOccurs='unbounded'"};
    std::string const occurs = occurrences[random() % occurrences.size()];
    if (depth == 0 || random() % 3 == 0) return std::string{"<xsd:element ref='"} + "abc"[random() % 3] + "'" + occurs + "/>";
    std::string const group = random() % 2 == 0 ? "xsd:sequence" : "xsd:choice";
    auto text = "<" + group + occurs + ">";
    for (auto parts = 1 + random() % 3; parts > 0; --parts) text += any_particle(random, depth - 1);
    return text + "</" + group + ">";
}

TEST(Tables, AnyContentModel) {
    constexpr auto elements =
        R"(<xsd:element name="a"><xsd:complexType/></xsd:element><xsd:element name="b"><xsd:complexType/></xsd:element>)"
        R"(<xsd:element name="c"><xsd:complexType/></xsd:element>)";
    std::mt19937 random{20261121};
    auto const children = sequences(4);
    std::size_t models = 0, both = 0, xerces_only = 0;
    for (int i = 0; i < 1'200; ++i) {
        auto const declarations = std::string{elements} + "<xsd:element name='root'><xsd:complexType><xsd:sequence>" +
                                  any_particle(random, 2) + any_particle(random, 2) +
                                  "</xsd:sequence></xsd:complexType></xsd:element>";
        std::optional<Small> schema;
        try {
            schema.emplace(declarations);
        } catch (std::runtime_error const&) {
            continue;  // it is ambiguous
        }
        ++models;
        for (auto const& each : children) {
            auto const outcome = schema->root(each);
            both += outcome == Outcome::both ? 1 : 0;
            xerces_only += outcome == Outcome::xerces_only ? 1 : 0;
        }
    }
    EXPECT_GT(models, 100u);
    EXPECT_GT(both, 1'000u);
    EXPECT_EQ(xerces_only, 0u);
}

TEST(Tables, TextBetweenElements) {
    auto const with = [](std::string_view mixed) {
        return Small{std::string{R"(<xsd:element name="root"><xsd:complexType mixed=")"}.append(mixed).append(
            R"("><xsd:sequence><xsd:element name="a" minOccurs="0"/></xsd:sequence></xsd:complexType></xsd:element>)")};
    };
    auto elements = with("false");
    EXPECT_EQ(elements.root(" \t\r\n"), Outcome::both);
    EXPECT_EQ(elements.root("<!-- a -->"), Outcome::both);
    EXPECT_EQ(elements.root("a"), Outcome::neither);
    EXPECT_NE(elements.root("&#32;"), Outcome::both);
    EXPECT_NE(elements.root("<![CDATA[ ]]>"), Outcome::both);
    EXPECT_EQ(elements.root("<a/>"), Outcome::xerces_only) << "of any type";
    auto mixed = with("true");
    EXPECT_EQ(mixed.root("a&amp;\n<!-- b -->&#x41;"), Outcome::both);
    EXPECT_EQ(mixed.root("a]]>"), Outcome::neither);
    Small empty{R"(<xsd:element name="root"><xsd:complexType/></xsd:element>)"};
    EXPECT_EQ(empty.root(""), Outcome::both);
    EXPECT_NE(empty.root(" "), Outcome::both);
    EXPECT_NE(empty.root("<!-- -->"), Outcome::both);
}

TEST(Tables, Attributes) {
    Small schema{R"(
        <xsd:attribute name="global" type="xsd:integer"/>
        <xsd:complexType name="Base"><xsd:attribute name="gone"/><xsd:attribute name="kept" type="xsd:integer"/><xsd:anyAttribute namespace="##any" processContents="lax"/></xsd:complexType>
        <xsd:element name="root"><xsd:complexType><xsd:complexContent><xsd:restriction base="Base">
            <xsd:attribute name="gone" use="prohibited"/>
            <xsd:attribute name="must" type="xsd:boolean" use="required"/>
            <xsd:attribute name="default" type="xsd:integer" default="5"/>
            <xsd:attribute name="fixed" type="xsd:integer" fixed="5"/>
            <xsd:attribute ref="global"/>
            <xsd:anyAttribute namespace="##other" processContents="lax"/>
        </xsd:restriction></xsd:complexContent></xsd:complexType></xsd:element>)"};
    auto const with = [&](std::string const& attributes) { return schema.root("", attributes); };
    EXPECT_EQ(with(" must='1'"), Outcome::both);
    EXPECT_EQ(with(" must='1' kept='1' t:global='1' default='7'"), Outcome::both);
    EXPECT_EQ(with(""), Outcome::neither);
    EXPECT_EQ(with(" must='x'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' gone='1'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' fixed='5'"), Outcome::xerces_only);
    EXPECT_EQ(with(" must='1' fixed='6'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' global='1'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' t:must='1'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' must='1'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' xmlns:u='urn:t' t:global='1' u:global='1'"), Outcome::neither);
    EXPECT_EQ(with(" must='1' xml:lang='en'"), Outcome::xerces_only);
    EXPECT_EQ(with(" must='1' xsi:schemaLocation='urn:t t.xsd'"), Outcome::xerces_only);
    EXPECT_EQ(with(" must='1' xsi:nil='false'"), Outcome::neither);
}

TEST(Tables, TypesThatADocumentChooses) {
    auto const declared = [](std::string_view of_base, std::string_view of_root) {
        return Small{
            std::string{R"(<xsd:complexType name="Base")"}
                .append(of_base)
                .append(
                    R"(><xsd:sequence><xsd:element name="a" type="xsd:integer" minOccurs="0"/></xsd:sequence></xsd:complexType>
            <xsd:complexType name="Longer"><xsd:complexContent><xsd:extension base="Base"><xsd:sequence><xsd:element name="b" type="xsd:integer"/></xsd:sequence>
                <xsd:attribute name="c" type="xsd:string" use="required"/></xsd:extension></xsd:complexContent></xsd:complexType>
            <xsd:complexType name="Longest"><xsd:complexContent><xsd:extension base="Longer"/></xsd:complexContent></xsd:complexType>
            <xsd:complexType name="Abstract" abstract="true"><xsd:complexContent><xsd:extension base="Base"/></xsd:complexContent></xsd:complexType>
            <xsd:complexType name="Shorter"><xsd:complexContent><xsd:restriction base="Base"><xsd:sequence/></xsd:restriction></xsd:complexContent></xsd:complexType>
            <xsd:complexType name="Other"><xsd:sequence><xsd:element name="a" type="xsd:integer" minOccurs="0"/></xsd:sequence></xsd:complexType>
            <xsd:element name="root" type="Base")")
                .append(of_root)
                .append("/>")};
    };
    auto open = declared("", "");
    EXPECT_EQ(open.root("", " xsi:type='Base'"), Outcome::both);
    EXPECT_EQ(open.root("<a>1</a><b>2</b>", " xsi:type='Longer' c=''"), Outcome::both);
    EXPECT_EQ(open.root("<b>2</b>", " xsi:type='t:Longest' c=''"), Outcome::both);
    EXPECT_EQ(open.root("<b>2</b>", " xsi:type='Longer'"), Outcome::neither);
    EXPECT_EQ(open.root("<b>2</b>", " c=''"), Outcome::neither);
    EXPECT_EQ(open.root("", " xsi:type='Shorter'"), Outcome::xerces_only);
    EXPECT_EQ(open.root("", " xsi:type=' Base '"), Outcome::xerces_only);
    EXPECT_EQ(open.root("", " xsi:type='Abstract'"), Outcome::neither);
    EXPECT_EQ(open.root("", " xsi:type='Other'"), Outcome::neither);
    EXPECT_EQ(open.root("", " xsi:type='None'"), Outcome::neither);
    EXPECT_EQ(open.root("", " xsi:type='none:Base'"), Outcome::neither);
    EXPECT_EQ(open.root("", " xsi:type='Base' t:type='Base'"), Outcome::neither);
    for (auto const& [of_base, of_root] :
         {std::pair{" block='extension'", ""}, std::pair{"", " block='extension'"}, std::pair{"", " block='#all'"}}) {
        auto blocked = declared(of_base, of_root);
        EXPECT_EQ(blocked.root("", " xsi:type='Base'"), Outcome::both) << of_base << of_root;
        EXPECT_EQ(blocked.root("<b>2</b>", " xsi:type='Longer' c=''"), Outcome::neither) << of_base << of_root;
    }
    auto abstract = declared(" abstract='true'", "");
    EXPECT_EQ(abstract.root(""), Outcome::neither);
    EXPECT_EQ(abstract.root("", " xsi:type='Base'"), Outcome::neither);
    EXPECT_EQ(abstract.root("<b>2</b>", " xsi:type='Longer' c=''"), Outcome::both);
}

TEST(Tables, ElementsThatAreMoreThanTheirType) {
    Small schema{R"(
        <xsd:element name="head" type="xsd:integer"/>
        <xsd:element name="member" type="xsd:integer" substitutionGroup="head"/>
        <xsd:element name="abstract" type="xsd:integer" abstract="true"/>
        <xsd:element name="concrete" type="xsd:integer" substitutionGroup="abstract"/>
        <xsd:element name="root"><xsd:complexType><xsd:choice maxOccurs="unbounded">
            <xsd:element ref="head"/><xsd:element ref="abstract"/>
            <xsd:element name="nillable" type="xsd:integer" nillable="true"/>
            <xsd:element name="default" type="xsd:integer" default="5"/>
            <xsd:element name="fixed" type="xsd:integer" fixed="5"/>
            <xsd:element name="unique"><xsd:complexType><xsd:sequence><xsd:element name="key" type="xsd:integer" maxOccurs="2"/></xsd:sequence></xsd:complexType>
                <xsd:unique name="keys"><xsd:selector xpath="t:key"/><xsd:field xpath="."/></xsd:unique></xsd:element>
            <xsd:element name="position" type="xsd:integer"/>
            <xsd:element name="pos"><xsd:complexType><xsd:sequence/></xsd:complexType></xsd:element>
        </xsd:choice></xsd:complexType></xsd:element>)"};
    EXPECT_EQ(schema.root("<head>1</head>"), Outcome::both);
    EXPECT_EQ(schema.root("<member>1</member>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<abstract>1</abstract>"), Outcome::neither);
    EXPECT_EQ(schema.root("<concrete>1</concrete>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<nillable>1</nillable>"), Outcome::both);
    EXPECT_EQ(schema.root("<nillable xsi:nil='true'/>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<nillable xsi:nil='false'>1</nillable>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<nillable xsi:nil='true'>1</nillable>"), Outcome::neither);
    EXPECT_EQ(schema.root("<default/>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<fixed>5</fixed>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<fixed>6</fixed>"), Outcome::neither);
    EXPECT_EQ(schema.root("<unique><key>1</key><key>2</key></unique>"), Outcome::xerces_only);
    EXPECT_EQ(schema.root("<unique><key>1</key><key>1</key></unique>"), Outcome::neither);
    EXPECT_EQ(schema.root("<position>1</position>"), Outcome::both);
    EXPECT_EQ(schema.root("<position>" + std::string(8'200, ' ') + "1</position>"), Outcome::neither) << "the scan's limit";
    EXPECT_EQ(schema.root("<pos/>"), Outcome::xerces_only) << "called like a list";
}

TEST(Tables, Ids) {
    Small schema{R"(<xsd:element name="root"><xsd:complexType><xsd:choice minOccurs="0" maxOccurs="unbounded">
        <xsd:element name="of"><xsd:complexType><xsd:attribute name="id" type="xsd:ID"/></xsd:complexType></xsd:element>
        <xsd:element name="to"><xsd:complexType><xsd:attribute name="id" type="xsd:IDREF"/></xsd:complexType></xsd:element>
        <xsd:element name="id" type="xsd:ID"/></xsd:choice></xsd:complexType></xsd:element>)"};
    EXPECT_EQ(schema.root("<of id='a'/><of id='b'/><id>c</id><of/>"), Outcome::both);
    EXPECT_EQ(schema.root("<of id='a'/><of id='a'/>"), Outcome::neither);
    EXPECT_EQ(schema.root("<of id='a'/><id>a</id>"), Outcome::neither);
    EXPECT_EQ(schema.root("<of id='a'/><of id=' a '/>"), Outcome::neither);
    EXPECT_EQ(schema.root("<of id='a'/><to id='a'/>"), Outcome::xerces_only);
    std::string many;
    for (int i = 0; i < 20; ++i) many += "<of id='a" + std::to_string(i) + "'/>";
    EXPECT_EQ(schema.root(many), Outcome::xerces_only);
}

TEST(Tables, ElementsWithoutANamespace) {
    Small qualified{
        R"(<xsd:element name="root"><xsd:complexType><xsd:sequence><xsd:element name="a" form="unqualified"><xsd:complexType/></xsd:element>
        </xsd:sequence></xsd:complexType></xsd:element>)"};
    EXPECT_EQ(qualified.root("<a/>"), Outcome::neither);
    EXPECT_EQ(qualified.root("<a xmlns=''/>"), Outcome::xerces_only);
}

}  // namespace
}  // namespace rois::xml
