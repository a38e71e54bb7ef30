// Content models, attributes and elements of the tables, with small schemas: what the tables accept, what they leave to xerces-c,
// and that they never accept what xerces-c rejects.
#include <array>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "xml/small_schema.hpp"

namespace rois::xml {
namespace {

enum class Known { yes, no };

struct ContentCase {
    std::string_view type;  // the rest of `<xsd:complexType`, with its content
    Known known = Known::yes;
};

void PrintTo(ContentCase const& of, std::ostream* out) { *out << of.type; }

class Content : public testing::TestWithParam<ContentCase> {};

// Returns all sequences of the elements a, b and c up to this length.
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

TEST_P(Content, IsAcceptedAsByXerces) {
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

// Returns a random particle. It may be ambiguous.
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

TEST(Tables, RandomContentModelsAreCheckedAsByXerces) {
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
            continue;  // an ambiguous content model
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

TEST(Tables, TextBetweenElementsIsCheckedAsByXerces) {
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

TEST(Tables, AttributesAreCheckedAsByXerces) {
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

TEST(Tables, XsiTypesAreCheckedAsByXerces) {
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

TEST(Tables, UnsupportedDeclarationsAreLeftToXerces) {
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

TEST(Tables, IdsMustBeUnique) {
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

TEST(Tables, UnqualifiedElementsAreLeftToXerces) {
    Small qualified{
        R"(<xsd:element name="root"><xsd:complexType><xsd:sequence><xsd:element name="a" form="unqualified"><xsd:complexType/></xsd:element>
        </xsd:sequence></xsd:complexType></xsd:element>)"};
    EXPECT_EQ(qualified.root("<a/>"), Outcome::neither);
    EXPECT_EQ(qualified.root("<a xmlns=''/>"), Outcome::xerces_only);
}

}  // namespace
}  // namespace rois::xml
