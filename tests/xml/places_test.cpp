// The place of a fault, and what it expected.
#include <gmock/gmock.h>

#include "xml/codec/place.hpp"
#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::string_view head =
    R"(<execute xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801">)";

TEST(Place, CountsCharactersAndLines) {
    std::string_view const text =
        "\xEF\xBB\xBF"
        "a\xC3\xA4\xF0\x9F\x98\x80z\r\nb\rc\n\nd";
    auto const at = [&](std::string_view what) {
        auto const place = place_of(text, text.find(what));
        return std::to_string(place.line) + ":" + std::to_string(place.column);
    };
    EXPECT_EQ(at("a"), "1:1");
    EXPECT_EQ(at("\xF0"), "1:3");
    EXPECT_EQ(at("z"), "1:4");
    EXPECT_EQ(at("b"), "2:1");
    EXPECT_EQ(at("c"), "3:1");
    EXPECT_EQ(at("d"), "5:1");
    EXPECT_EQ(place_of(text, 1'000).line, 5u);
    Places places{text};
    for (auto const offset : {text.size(), std::size_t{0}, text.size() / 2, text.size()}) {
        EXPECT_EQ(places.of(offset).line, place_of(text, offset).line);
        EXPECT_EQ(places.of(offset).column, place_of(text, offset).column);
    }
}

TEST(Place, IsFoundFromTheColumnsOfAParser) {
    std::string_view const text =
        "\xEF\xBB\xBF"
        "a\xF0\x9F\x98\x80z\n\xC3\xA4y";
    EXPECT_EQ(text.substr(offset_of(text, {1, 1}), 1), "a");
    EXPECT_EQ(text.substr(offset_of(text, {1, 4}), 1), "z");  // the character before takes two UTF-16 units
    EXPECT_EQ(text.substr(offset_of(text, {2, 2}), 1), "y");
    EXPECT_EQ(offset_of(text, {7, 1}), text.size());
}

TEST(Fault, IsAtTheChildThatIsNotAllowed) {
    auto const refused = fault("<bind xmlns='urn:x-rois:psm:xml:message:1'>\r\n  <!-- \xC3\xA4 --> <component/>\r\n</bind>");
    EXPECT_EQ(place(refused), "2:14");
    EXPECT_EQ(refused.reason, "unknown element 'component' inside 'bind': expected 'component_ref'");
}

TEST(Fault, IsAtTheParentOfAMissingChild) {
    auto const refused = fault(
        "\n <!-- here -->\n <set_parameter xmlns='urn:x-rois:psm:xml:message:1'\n "
        "xmlns:rois='http://www.omg.org/spec/RoIS/20240801'>"
        "<component_ref rois:code='a'/>\n\n</set_parameter>");
    EXPECT_EQ(place(refused), "3:2");
    EXPECT_EQ(refused.reason, "element 'parameters' is missing in 'set_parameter'");
}

TEST(Fault, IsAtTheTagOfAWrongAttribute) {
    auto const wrong = fault(
        "<subscribe xmlns='urn:x-rois:psm:xml:message:1'\n  inline_results='perhaps'><event_type>e</event_type></subscribe>");
    EXPECT_EQ(place(wrong), "1:1");
    EXPECT_EQ(wrong.reason, "attribute 'inline_results' of 'subscribe' has the value 'perhaps': expected true or false");
    auto const missing = fault(std::string{head} +
                               "\n<rois:CommandUnitSequence>\n<rois:command_unit_list rois:delay_time='1s'/>"
                               "</rois:CommandUnitSequence></execute>");
    EXPECT_EQ(place(missing), "3:1");
    EXPECT_THAT(missing.reason, AllOf(HasSubstr("'rois:delay_time'"), HasSubstr("'1s'"), HasSubstr("a whole number")));
}

TEST(Fault, ListsTheKnownOperations) {
    auto const refused = fault(document("foo"));
    EXPECT_EQ(place(refused), "1:1");
    EXPECT_THAT(refused.reason,
                AllOf(HasSubstr("unknown operation 'foo'"), HasSubstr("'connect', 'resume', 'disconnect', 'get_profile'"),
                      HasSubstr("'get_event_detail'")));
    EXPECT_THAT(fault("<connect/>").reason, HasSubstr("must be in the namespace 'urn:x-rois:psm:xml:message:1'"));
    EXPECT_THAT(fault("<connect xmlns='urn:other'/>").reason, HasSubstr("not in 'urn:other'"));
    EXPECT_EQ(fault("<connect xmlns='urn:other'/>").code, FaultCode::invalid);
}

TEST(Fault, OfAnUnknownNamespaceIsAtItsTag) {
    auto const unused = fault(document("bind", "\n<component_ref xmlns:x='urn:x' rois:code='a'/>"));
    EXPECT_EQ(unused.code, FaultCode::invalid);
    EXPECT_EQ(place(unused), "2:1");
    EXPECT_THAT(unused.reason, HasSubstr("'urn:x'"));
    // A parser's pools would keep the namespace, so a reference must not hide it.
    EXPECT_EQ(fault(document("connect", {}, " xmlns:x='urn:&#120;'")).code, FaultCode::invalid);
}

TEST(Fault, OfAMismatchedEndTagIsAtTheStartTag) {
    EXPECT_EQ(place(fault(document("bind", "\n <component_ref rois:code='a'>\n"))), "2:2");
    EXPECT_EQ(place(fault("<bind>\n <a><!-- <b> --><c/><d x='>'></d>\n</bind>\n")), "2:2");
    EXPECT_EQ(place(fault("<bind>\n <a>\n</a></bound>")), "1:1");
    EXPECT_EQ(place(fault("<bind/>\n</bind>")).substr(0, 2), "2:");
}

TEST(Fault, OfATruncatedDocumentIsAtTheUnclosedTag) {
    auto const refused = fault(document("bind", "\n   <component_ref rois:code='a'>\n\n"));
    EXPECT_EQ(refused.code, FaultCode::not_well_formed);
    auto const cut = fault("<bind xmlns='urn:x-rois:psm:xml:message:1'>\n   <component_ref>\n\n");
    EXPECT_EQ(place(cut), "2:4");
    EXPECT_EQ(place(fault("<bind>\n <a>\n  <b/>\n")), "2:2");
    EXPECT_EQ(place(fault("<bind>\n <component_ref rois:code='a")), "2:2");
}

TEST(Fault, OfASyntaxErrorIsAtTheError) {
    EXPECT_EQ(place(fault("<bind>\n <component_ref a=b/></bind>")), "2:19");
    EXPECT_EQ(place(fault("<bind>\n\n <a></b>\n</bind>")).substr(0, 2), "3:");
}

TEST(Fault, IsAtTheSamePlaceWithAByteOrderMark) {
    EXPECT_EQ(place(fault("\xEF\xBB\xBF<bind xmlns='urn:x-rois:psm:xml:message:1'> <component/></bind>")), "1:45");
    EXPECT_EQ(place(fault("<bind xmlns='urn:x-rois:psm:xml:message:1'> <component/></bind>")), "1:45");
    EXPECT_EQ(place(fault("\xEF\xBB\xBF<nonsense/>")), "1:1");
}

TEST(Fault, IsFoundAfterManyValidChildren) {
    std::string children;
    for (int i = 0; i < 4'000; ++i) children += "<rois:command_unit_list/>";
    auto const refused =
        fault(document("execute", "<rois:CommandUnitSequence>" + children + "\n<bad/></rois:CommandUnitSequence>"));
    EXPECT_EQ(place(refused), "2:1");
    EXPECT_EQ(refused.reason, "unknown element 'bad' inside 'rois:CommandUnitSequence': expected 'rois:command_unit_list'");
}

TEST(Fault, OfAnExceededLimitIsAtTheTag) {
    EXPECT_EQ(place(fault("<a>\n <b>\n  <c/></b></a>", {.depth = 2})), "3:3");
    EXPECT_EQ(place(fault("<?xml version='1.1'?><a/>")), "1:1");
    EXPECT_EQ(place(fault("\n<!DOCTYPE a><a/>")), "2:1");
}

TEST(Fault, OfADuplicateIdIsAtTheSecond) {
    auto const reported = problem(
        "p.xml",
        "<rois:HRIEngineProfile xmlns:rois='http://www.omg.org/spec/RoIS/20240801' xmlns:gml='http://www.opengis.net/gml/3.2'"
        " gml:id='e'><gml:identifier codeSpace='c'>i</gml:identifier>\n<rois:SubProfile gml:id='e'>"
        "<gml:identifier codeSpace='c'>i</gml:identifier><rois:HRIComponent>c</rois:HRIComponent></rois:SubProfile>"
        "<rois:HRIComponent>c</rois:HRIComponent></rois:HRIEngineProfile>");
    EXPECT_EQ(reported, "p.xml:2:1: the id 'e' is used twice");
}

}  // namespace
}  // namespace rois::xml
