// Profiles that deviate from the schemas: common deviations are read with a warning, others are rejected with their place.
#include <gmock/gmock.h>

#include "types/data_type.hpp"
#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

// Returns a component profile with its start tag in line 1, the identifier in line 2 and the rest from line 3.
std::string profile(std::string_view inside,
                    std::string_view identifier = "<gml:identifier codeSpace='cs'>urn:c</gml:identifier>",
                    std::string_view rois = "http://www.omg.org/spec/RoIS/20240801") {
    std::string text{"<rois:HRIComponentProfile xmlns:gml='http://www.opengis.net/gml/3.2' "};
    text.append("xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' gml:id='c' xmlns:rois='").append(rois).append("'>\n");
    return text.append(identifier).append("\n").append(inside).append("</rois:HRIComponentProfile>");
}

std::string message(std::string_view kind, std::string_view inside) {
    return std::string{"<rois:MessageProfile xsi:type='rois:"} + std::string{kind} + "MessageProfileType' rois:name='m'>" +
           std::string{inside} + "</rois:MessageProfile>";
}

std::string parameter(std::string_view element, std::string_view type, std::string_view attributes = "") {
    std::string text{"<rois:"};
    text.append(element).append(" rois:name='p' ").append(attributes).append("><rois:data_type_ref rois:code='").append(type);
    return text.append("'/></rois:").append(element).append(">");
}

ProfileDocument whole(std::string const& text) { return read_profile_document(schemas(), "p.xml", text); }

ComponentProfile component(ProfileDocument const& document) { return std::get<ComponentProfile>(document.profile); }

std::string refusal(std::string const& text) {
    try {
        whole(text);
        return "it was read";
    } catch (BadDocument const& e) {
        return e.what();
    }
}

TEST(ForeignProfile, IsReadWithoutWarningsIfItIsValid) {
    auto const read = whole(profile(message("Event", parameter("Results", "String[]"))));
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_EQ(component(read).messages.at(0).kind, MessageKind::event);
}

TEST(ForeignProfile, MayBeOfAnyVersion) {
    constexpr std::string_view identifier = "<gml:identifier codeSpace='cs'>urn:c</gml:identifier>";
    EXPECT_THAT(whole(profile("", identifier, "http://www.omg.org/spec/RoIS/20151201")).warnings, IsEmpty());
    EXPECT_THAT(whole(profile("", identifier, "http://www.omg.org/spec/RoIS/20250801")).warnings,
                ElementsAre(AllOf(StartsWith("p.xml:1:1: "), HasSubstr("'http://www.omg.org/spec/RoIS/20250801'"))));
    EXPECT_THAT(refusal(profile("", identifier, "http://www.omg.org/spec/RoIS/yesterday")),
                StartsWith("p.xml:1:1: unknown element"));
}

TEST(ForeignProfile, MayHaveWhiteSpaceAroundANamespace) {
    constexpr std::string_view identifier = "<gml:identifier codeSpace='cs'>urn:c</gml:identifier>";
    for (auto const* name : {"http://www.omg.org/spec/RoIS/20240801 ", "  http://www.omg.org/spec/RoIS/20151201 "}) {
        auto const read = whole(profile(message("Event", ""), identifier, name));
        EXPECT_THAT(read.warnings, ElementsAre(AllOf(StartsWith("p.xml:1:1: "), HasSubstr("white space")))) << name;
        EXPECT_THAT(component(read).messages, SizeIs(1));
    }
}

TEST(ForeignProfile, MayLackACodeSpaceAndAnId) {
    auto text = profile("", "<gml:identifier>urn:c</gml:identifier>");
    auto const read = whole(text);
    EXPECT_THAT(read.warnings, ElementsAre(AllOf(StartsWith("p.xml:2:1: "), HasSubstr("codeSpace"))));
    EXPECT_EQ(component(read).object.code_space, "urn:ietf:rfc:2141");
    text.replace(text.find("gml:id='c'"), 10, "");
    EXPECT_THAT(whole(text).warnings, ElementsAre(HasSubstr("gml:id"), HasSubstr("codeSpace")));
    EXPECT_THAT(refusal(profile("", "")), AllOf(StartsWith("p.xml:1:1: "), HasSubstr("identifier")));
    EXPECT_THAT(refusal(profile("", "<gml:identifier codeSpace='c'> </gml:identifier>")), HasSubstr("is empty"));
}

TEST(ForeignProfile, MayHaveAUrnForItsId) {
    auto text = profile("");
    text.replace(text.find("gml:id='c'"), 10, "gml:id='urn:a:b'");
    EXPECT_THAT(whole(text).warnings, ElementsAre(AllOf(StartsWith("p.xml:1:1: "), HasSubstr("'urn:a:b'"))));
}

TEST(ForeignProfile, KeepsAnIdThatLooksEscaped) {
    auto text = profile("");
    text.replace(text.find("gml:id='c'"), 10, "gml:id='_x20_'");
    text.replace(text.find(" codeSpace='cs'"), 15, "");
    EXPECT_THAT(whole(text).warnings, ElementsAre(HasSubstr("codeSpace")));
}

TEST(ForeignProfile, MayHaveAttributesWithoutPrefix) {
    auto const read =
        whole(profile("<rois:ParameterProfile name='p' default_value='10'>\n<rois:data_type_ref code='int'/>"
                      "</rois:ParameterProfile>"));
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("'name'"), HasSubstr("'default_value'"), StartsWith("p.xml:4:1: ")));
    EXPECT_EQ(component(read).parameters.at(0).default_value, "10");
}

TEST(ForeignProfile, MayMisspellTheKindOfAMessage) {
    auto const read =
        whole(profile("<rois:MessageProfile xsi:type='rois:CommaneMessageProfileType' rois:name='start'/>\n"
                      "<rois:MessageProfile xsi:type='eventMessageProfileType' rois:name='seen'/>"));
    EXPECT_THAT(read.warnings, ElementsAre(AllOf(StartsWith("p.xml:3:1: "), HasSubstr("CommaneMessageProfileType")),
                                           AllOf(StartsWith("p.xml:4:1: "), HasSubstr("'rois:EventMessageProfileType'"))));
    EXPECT_EQ(component(read).messages.at(0).kind, MessageKind::command);
    EXPECT_EQ(component(read).messages.at(1).kind, MessageKind::event);
    EXPECT_THAT(refusal(profile("\n<rois:MessageProfile xsi:type='rois:Telegram' rois:name='m'/>")), StartsWith("p.xml:4:1: "));
}

TEST(ForeignProfile, MayNameTheKindByTheElement) {
    auto const read = whole(
        profile("<rois:QueryMessageProfile rois:name='how'>" + parameter("Results", "string") + "</rois:QueryMessageProfile>"));
    EXPECT_THAT(read.warnings, ElementsAre(AllOf(StartsWith("p.xml:3:1: "), HasSubstr("rois:QueryMessageProfile"))));
    EXPECT_EQ(component(read).messages.at(0).kind, MessageKind::query);
    EXPECT_THAT(component(read).messages.at(0).results, SizeIs(1));
}

TEST(ForeignProfile, MayGiveArgumentsToEventsAndQueries) {
    auto const event = whole(profile(message("Event", parameter("Arguments", "string"))));
    EXPECT_THAT(event.warnings, ElementsAre(HasSubstr("'Results'")));
    EXPECT_THAT(component(event).messages.at(0).results, SizeIs(1));
    EXPECT_THAT(component(event).messages.at(0).arguments, IsEmpty());
    auto const query = whole(profile(message("Query", parameter("Results", "string") + parameter("Arguments", "string"))));
    EXPECT_THAT(query.warnings, ElementsAre(HasSubstr("'Arguments' are ignored")));
    EXPECT_THAT(component(query).messages.at(0).results, SizeIs(1));
    EXPECT_THAT(component(query).messages.at(0).arguments, IsEmpty());
}

TEST(ForeignProfile, MayBeInAnotherOrder) {
    auto const read =
        whole(profile(parameter("ParameterProfile", "int") + "\n<rois:SubComponentProfile>a</rois:SubComponentProfile>" +
                      message("Command", parameter("Arguments", "int") + parameter("Results", "bool"))));
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("after 'rois:ParameterProfile'"), HasSubstr("after 'rois:Arguments'")));
    EXPECT_THAT(component(read).sub_components, ElementsAre("a"));
    EXPECT_THAT(read.sub_component_places, ElementsAre("p.xml:4:1"));
    EXPECT_THAT(component(read).messages.at(0).arguments, SizeIs(1));
}

TEST(ForeignProfile, MayHaveAnEmptyDefaultForNone) {
    auto const read = whole(profile(parameter("ParameterProfile", "int", "rois:default_value=''")));
    EXPECT_THAT(read.warnings, ElementsAre(AllOf(StartsWith("p.xml:3:1: "), HasSubstr("is empty: ignored"))));
    EXPECT_EQ(component(read).parameters.at(0).default_value, std::nullopt);
    EXPECT_EQ(component(whole(profile(parameter("ParameterProfile", "string", "rois:default_value=''"))))
                  .parameters.at(0)
                  .default_value,
              "");
}

TEST(ForeignProfile, MayHaveUnknownDataTypes) {
    auto const read = whole(
        profile("\n" + message("Event", parameter("Results", "Shade")) + "\n" + parameter("ParameterProfile", "List&lt;Shade>")));
    EXPECT_THAT(read.warnings,
                testing::UnorderedElementsAre(
                    testing::MatchesRegex("p.xml:4:[0-9]+: unknown data type 'Shade' of 'p': its values are not checked"),
                    testing::MatchesRegex("p.xml:5:[0-9]+: unknown data type 'List<Shade>' of 'p': .*")));
    for (auto const* known : {"xsd:float", "Set&lt;Date>", "UnlimitedNatural", "urn:x-other:int", "NBestType"})
        EXPECT_THAT(whole(profile(parameter("ParameterProfile", known))).warnings, IsEmpty()) << known;
}

TEST(ForeignProfile, IsRefusedWithADefaultThatIsNotOfItsType) {
    for (auto const* type : {"Float", "xsd:int", "urn:x-other:int", "UnlimitedNatural", "Boolean", "Date", "xs:time",
                             "Set&lt;Integer>", "Sequence&lt;xsd:dateTime>"})
        EXPECT_THAT(refusal(profile("\n" + parameter("ParameterProfile", type, "rois:default_value='-a lot'"))),
                    AllOf(StartsWith("p.xml:4:1: the default value of 'p': "), HasSubstr("is not of the type")))
            << type;
    EXPECT_THAT(refusal(profile("\n" + parameter("ParameterProfile", "UnlimitedNatural", "rois:default_value='-1'"))),
                StartsWith("p.xml:4:1: the default value of 'p': '-1' is not of the type UnlimitedNatural"));
}

TEST(ForeignProfile, IsRefusedWhereItContradictsItself) {
    EXPECT_THAT(refusal(profile("\n" + parameter("ParameterProfile", "int", "rois:default_value='many'"))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("'many' is not of the type int")));
    EXPECT_THAT(refusal(profile("\n" + parameter("ParameterProfile", " "))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("data type")));
    EXPECT_THAT(refusal(profile(message("Event", "") + "\n" + message("Event", ""))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("duplicate message 'm'")));
    EXPECT_THAT(refusal(profile(parameter("ParameterProfile", "int") + "\n" + parameter("ParameterProfile", "int"))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("duplicate name 'p'")));
    EXPECT_THAT(refusal(profile("\n<rois:MessageProfile rois:name='m'/>")),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("xsi:type")));
}

// Returns a message of this kind and name.
std::string message_named(std::string_view kind, std::string_view name, std::string_view inside) {
    auto text = message(kind, inside);
    return text.replace(text.find("'m'"), 3, "'" + std::string{name} + "'");
}

TEST(ForeignProfile, IsRefusedWhereItsMessagesContradictItsParameters) {
    auto const set = [](std::string_view type, std::string_view attributes = "") {
        return message_named("Command", "set_parameter", parameter("Arguments", type, attributes)) + "\n";
    };
    auto const get = [](std::string_view type) {
        return message_named("Query", "get_parameter", "\n" + parameter("Results", type)) + "\n";
    };
    auto const twice = HasSubstr("'p' is defined twice, with different types or default values");
    EXPECT_THAT(refusal(profile(set("int") + parameter("ParameterProfile", "string"))), AllOf(StartsWith("p.xml:4:1: "), twice));
    EXPECT_THAT(refusal(profile(get("int") + parameter("ParameterProfile", "string"))), AllOf(StartsWith("p.xml:5:1: "), twice));
    EXPECT_THAT(refusal(profile(set("int") + get("string"))), AllOf(StartsWith("p.xml:5:1: "), twice));
    EXPECT_THAT(
        refusal(profile(set("int", "rois:default_value='1'") + parameter("ParameterProfile", "int", "rois:default_value='2'"))),
        AllOf(StartsWith("p.xml:4:1: "), twice));
    EXPECT_THAT(
        whole(profile(set("int", "rois:default_value='1'") + get("Integer") + parameter("ParameterProfile", "xsd:int"))).warnings,
        IsEmpty());
}

TEST(ForeignProfile, IsRefusedIfItRedefinesMessagesOfTheEngine) {
    auto const result = [](std::string_view name, std::string_view type) {
        auto text = parameter("Results", type);
        return text.replace(text.find("'p'"), 3, "'" + std::string{name} + "'");
    };
    EXPECT_THAT(refusal(profile("\n" + message_named("Query", "component_status", result("battery", "int")))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("the engine answers the query 'component_status'")));
    EXPECT_THAT(refusal(profile("\n" + message_named("Command", "dim", result("Status", "int")))),
                AllOf(StartsWith("p.xml:4:1: "), HasSubstr("get_command_result")));
    EXPECT_THAT(whole(profile(message_named("Query", "component_status", result("status", "Component_Status")))).warnings,
                IsEmpty());
}

TEST(ForeignProfile, HasDefaultTimesInUtc) {
    auto const read = whole(profile(parameter("ParameterProfile", "DateTime", "rois:default_value='2026-11-20T12:00:00+01:00'")));
    EXPECT_EQ(component(read).parameters.at(0).default_value, "2026-11-20T11:00:00Z");
}

TEST(ForeignProfile, IsRefusedWithTheErrorThatRemainsAfterRepair) {
    EXPECT_THAT(refusal(profile(message("Event", parameter("Arguments", "int")) + "\n<rois:Unknown/>")),
                AllOf(StartsWith("p.xml:4:1: unknown element 'rois:Unknown'")));
    EXPECT_THAT(refusal(profile("\n <gml:name/>", "<gml:identifier>urn:c</gml:identifier>\n<rois:Unknown/>")),
                StartsWith("p.xml:3:1: "));
    EXPECT_THAT(refusal("<a>"), StartsWith("p.xml:1:1: not well-formed"));
    EXPECT_THAT(refusal(document("connect")), AllOf(StartsWith("p.xml:1:1: "), HasSubstr("'HRIEngineProfile'")));
}

TEST(ForeignProfile, IsServedAsAValidDocument) {
    auto const read = component(whole(profile(message("Event", parameter("Arguments", "String[]")),
                                              "<gml:metaDataProperty xmlns:x='http://www.w3.org/1999/xlink' x:href=' urn:a '/>"
                                              "<gml:identifier>urn:c</gml:identifier>")));
    EXPECT_EQ(read.object.meta_data, "urn:a");
    auto const written = encode(read, "profile.c");
    EXPECT_EQ(problem("again.xml", written), "");
    EXPECT_EQ(component(whole(written)), read);
}

TEST(ForeignEngineProfile, MayListItsComponentsFirstOrHaveNone) {
    auto const engine = [](std::string_view inside) {
        return "<HRIEngineProfile xmlns='http://www.omg.org/spec/RoIS/20151201' xmlns:g='http://www.opengis.net/gml/3.2' "
               "g:id='e'>"
               "<g:identifier codeSpace='c'>urn:e</g:identifier>" +
               std::string{inside} + "</HRIEngineProfile>";
    };
    constexpr std::string_view sub =
        "<SubProfile g:id='s'><g:identifier>urn:s</g:identifier><HRIComponent>urn:x:s:B</HRIComponent></SubProfile>";
    auto const first = whole(engine("<HRIComponent>urn:x-rois:def:HRIComponent:A</HRIComponent>" + std::string{sub}));
    EXPECT_THAT(first.warnings, ElementsAre(HasSubstr("after 'HRIComponent'"), HasSubstr("codeSpace")));
    auto const profile = std::get<EngineProfile>(first.profile);
    EXPECT_THAT(profile.components, ElementsAre("urn:x-rois:def:HRIComponent:A"));
    EXPECT_THAT(profile.sub_profiles.at(0).components, ElementsAre("urn:x:s:B"));
    auto const second = whole(engine(std::string{sub} + std::string{sub}));
    EXPECT_THAT(std::get<EngineProfile>(second.profile).components, IsEmpty());
    EXPECT_THAT(std::get<EngineProfile>(second.profile).sub_profiles, SizeIs(2));
}

TEST(ForeignDataTypes, AreRecognizedInAnyCaseAndForm) {
    auto const type = [](std::string code) {
        return DataType::of({.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}});
    };
    for (auto const* code : {"string[]", "String[]", "STRING[]", "urn:x-rois:def:DataType:ATR::String[]"}) {
        EXPECT_EQ(type(code).base, BaseType::string) << code;
        EXPECT_TRUE(type(code).list) << code;
    }
    for (auto const* code : {"Int", "integer", "UnlimitedNatural", "urn:x-rois:def:DataType:ATR::Integer"})
        EXPECT_EQ(type(code), type("int")) << code;
}

}  // namespace
}  // namespace rois::xml
