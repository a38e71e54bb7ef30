// Documents from files, and the schemas.
#include <gmock/gmock.h>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view begin =
    R"(<p:HRIComponentProfile xmlns:p="http://www.omg.org/spec/RoIS/20240801" xmlns:g="http://www.opengis.net/gml/3.2"
 xmlns:i="http://www.w3.org/2001/XMLSchema-instance" g:id="c"><g:identifier codeSpace="cs"> urn:c </g:identifier>)";

std::string profile(std::string_view inside) { return std::string{begin} + std::string{inside} + "</p:HRIComponentProfile>"; }

std::string refusal(std::string text) {
    try {
        read_component_profile(schemas(), "c.xml", std::move(text));
        return {};
    } catch (BadDocument const& e) {
        return e.what();
    }
}

TEST(DocumentFromAFile, IsWalkedByLocalNames) {
    auto const document = Document::parse(schemas(), "c.xml",
                                          profile("<p:SubComponentProfile>a</p:SubComponentProfile><!-- c -->"
                                                  "<p:SubComponentProfile> <![CDATA[b]]></p:SubComponentProfile>"));
    auto const root = document.root();
    EXPECT_EQ(root.name(), "HRIComponentProfile");
    EXPECT_EQ(root.attribute("id"), "c");
    EXPECT_EQ(root.attribute("p"), std::nullopt) << "a namespace declaration is not an attribute";
    EXPECT_EQ(root.attribute("nothing", "else"), "else");
    ASSERT_EQ(root.children().size(), 3u);
    ASSERT_EQ(root.children("SubComponentProfile").size(), 2u);
    EXPECT_EQ(root.children("SubComponentProfile")[1].text(), " b");
    EXPECT_EQ(child(root, "identifier").attribute("codeSpace"), "cs");
    EXPECT_FALSE(root.child("name"));
}

TEST(DocumentFromAFile, ReturnsTextsAndElementsInOrder) {
    auto const content =
        child(Document::parse(
                  schemas(), "g.xml",
                  "<g:grammar xmlns:g='http://www.w3.org/2001/06/grammar' version='1.0' xml:lang='en'><g:rule id='r'>one "
                  "<g:tag>t</g:tag><!-- c --><![CDATA[two]]></g:rule></g:grammar>")
                  .root(),
              "rule")
            .content();
    ASSERT_EQ(content.size(), 3u);
    EXPECT_EQ(std::get<std::string>(content[0]), "one ");
    EXPECT_EQ(std::get<Element>(content[1]).name(), "tag");
    EXPECT_EQ(std::get<std::string>(content[2]), "two");
}

TEST(DocumentFromAFile, LivesAsLongAsItsElements) {
    auto const identifier = child(Document::parse(schemas(), "c.xml", profile("")).root(), "identifier");
    EXPECT_EQ(identifier.text(), " urn:c ");
}

TEST(DocumentFromAFile, NumbersAreCheckedWhenTheyAreRead) {
    auto const root = Document::parse(schemas(), "p.xml",
                                      profile("\n<p:ParameterProfile p:name='1.5e1' p:default_value='x'>"
                                              "<p:data_type_ref p:code='int'/></p:ParameterProfile>"))
                          .root();
    auto const parameter = child(root, "ParameterProfile");
    EXPECT_EQ(parameter.number("name"), 15);
    EXPECT_EQ(parameter.number("description", 7), 7);
    EXPECT_THROW(parameter.number("description"), BadDocument);
    try {
        parameter.number("default_value", 7);
        ADD_FAILURE() << "'x' was read as a number";
    } catch (BadDocument const& e) {
        EXPECT_THAT(e.what(), AllOf(StartsWith("p.xml:3:1: "), HasSubstr("'default_value'"), HasSubstr("'x'")));
    }
}

TEST(DocumentFromAFile, ReportsErrorsWithTheirPlace) {
    EXPECT_THAT(problem("f.xml", "<a"), StartsWith("f.xml:1:1: "));
    EXPECT_THAT(problem("f.xml", ""), StartsWith("f.xml:1:1: "));
    EXPECT_THAT(problem("f.xml", std::string(2 << 20, ' ')), StartsWith("f.xml:1:1: the document is too large"));
    EXPECT_THAT(problem("f.xml", "\n <nothing/>"), StartsWith("f.xml:2:2: "));
}

TEST(ComponentProfileDocument, IsReadInBothNamespaces) {
    auto old = profile("<p:MessageProfile i:type='p:EventMessageProfileType' p:name='e'/>");
    old.replace(old.find("20240801"), 8, "20151201");
    for (auto const& text : {old, profile("<p:MessageProfile i:type='p:EventMessageProfileType' p:name='e'/>")}) {
        auto const read = read_component_profile(schemas(), "c.xml", text);
        EXPECT_EQ(read.object.identifier, "urn:c");
        ASSERT_EQ(read.messages.size(), 1u);
        EXPECT_EQ(read.messages[0].kind, MessageKind::event);
    }
}

TEST(ComponentProfileDocument, IsRefusedWithItsPlace) {
    EXPECT_THAT(refusal(profile("\n<p:MessageProfile p:name='m'/>")), AllOf(StartsWith("c.xml:3:1: "), HasSubstr("xsi:type")));
    EXPECT_THAT(refusal(profile("\n<p:MessageProfile i:type='p:CommandMessageProfileType' p:name='m' p:timeout='-1'/>")),
                AllOf(StartsWith("c.xml:3:1: "), HasSubstr("'-1'")));
    EXPECT_THAT(refusal(profile(
                    "\n<p:MessageProfile i:type='p:CommandMessageProfileType' p:name='m' p:timeout='99999999999999999999'/>")),
                StartsWith("c.xml:3:1: "));
    EXPECT_THAT(refusal(profile("<p:Unknown/>")), StartsWith("c.xml:2:"));
    EXPECT_THAT(refusal(document("connect")), AllOf(StartsWith("c.xml:1:1: "), HasSubstr("expected 'HRIComponentProfile'")));
}

TEST(ComponentProfileDocument, IsReadForAllBasicComponents) {
    for (auto const& [name, text] : files::profiles()) {
        auto const read = read_component_profile(schemas(), name, std::string{text});
        EXPECT_THAT(read.object.identifier, StartsWith("urn:x-rois:def:component:OMG::")) << name;
        EXPECT_FALSE(read.messages.empty()) << name;
        EXPECT_EQ(problem(name, encode(read, "profile." + name)), "");
    }
}

// --- The schemas ---

std::string why_not_compiled(NamedFiles files) {
    schemas();  // initializes the platform
    try {
        Schemas const compiled{std::move(files)};
        return {};
    } catch (std::runtime_error const& e) {
        return e.what();
    }
}

constexpr std::string_view head = "<s:schema xmlns:s='http://www.w3.org/2001/XMLSchema' xmlns:t='urn:t' targetNamespace='urn:t'>";

std::string schema(std::string_view inside) { return std::string{head} + std::string{inside} + "</s:schema>"; }

TEST(SchemaFiles, AreCompiledFromMemoryInAnyOrder) {
    auto const a = schema("<s:include schemaLocation='b.xsd'/><s:element name='a' type='t:B'/>");
    auto const b = schema("<s:include schemaLocation='a.xsd'/><s:complexType name='B'/>");
    EXPECT_EQ(why_not_compiled({{"a.xsd", a}, {"b.xsd", b}}), "") << "they include each other";
    auto const alone = schema("<s:element name='a' type='s:int'/>");
    EXPECT_EQ(why_not_compiled({{"a.xsd", alone}}), "");
}

TEST(SchemaFiles, AreRefusedWithFileAndPlace) {
    auto const wrong = schema("\n<s:element name='a' type='t:Missing'/>");
    EXPECT_THAT(why_not_compiled({{"wrong.xsd", wrong}}), StartsWith("wrong.xsd:2:"));
    auto const ambiguous = schema(
        "\n<s:complexType name='A'><s:sequence><s:element name='x' type='s:int' minOccurs='0'/>"
        "<s:element name='x' type='s:int'/></s:sequence></s:complexType>");
    EXPECT_THAT(why_not_compiled({{"ambiguous.xsd", ambiguous}}), HasSubstr("ambiguous.xsd"));
    EXPECT_THAT(why_not_compiled({{"broken.xsd", "<s:schema"}}), StartsWith("broken.xsd:1:"));
}

TEST(SchemaFiles, LoadNothingFromOutside) {
    auto const outside = schema("<s:include schemaLocation='/etc/passwd'/>");
    EXPECT_THAT(why_not_compiled({{"a.xsd", outside}}),
                AllOf(HasSubstr("'/etc/passwd'"), HasSubstr("not among the given files")));
    auto const net = schema("<s:import namespace='urn:u' schemaLocation='http://127.0.0.1:1/u.xsd'/>");
    EXPECT_THAT(why_not_compiled({{"a.xsd", net}}), HasSubstr("not among the given files"));
}

TEST(SchemaFiles, MayBeCompiledTwiceOnSeveralPlatforms) {
    Platform const one, two;
    Schemas const first{files::schemas()};
    {
        Platform const three;
        Schemas const second{files::schemas()};
        EXPECT_EQ(first.files().size(), second.files().size());
    }
    EXPECT_EQ(first.files().size(), files::schemas().size());
    operation<Connect>(document("connect"));
}

}  // namespace
}  // namespace rois::xml
