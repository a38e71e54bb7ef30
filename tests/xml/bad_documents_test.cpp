// Invalid documents, one test for each kind.
#include <gmock/gmock.h>

#include <pugixml.hpp>
#include <set>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

std::string repeated(std::string_view text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}

// Returns a request with elements nested to this depth, including the root.
std::string nested(std::size_t depth) { return document("search", repeated("<a>", depth - 1) + repeated("</a>", depth - 1)); }

TEST(BadDocument, EmptyAndTruncatedDocumentsAreNotWellFormed) {
    for (auto const text : {"", " ", "\r\n\t ", "\xEF\xBB\xBF", "\xEF\xBB\xBF "}) {
        EXPECT_EQ(fault(text).code, FaultCode::not_well_formed);
        EXPECT_EQ(fault(text).reason, "the document is empty");
    }
    auto const whole = "<?xml version='1.0'?>\n<!-- c -->\n" + document("bind", "<component_ref rois:code='a'/><![CDATA[ ]]>");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        auto const refused = fault(whole.substr(0, length));
        EXPECT_EQ(refused.code, FaultCode::not_well_formed) << whole.substr(0, length);
        EXPECT_TRUE(refused.place) << length;
    }
}

TEST(BadDocument, DocumentTypesAndEntitiesAreRejected) {
    auto const bomb = "<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>]>"s;
    for (auto const& type : {bomb, "<!DOCTYPE connect>"s, "<!DOCTYPE connect SYSTEM 'file:///etc/passwd'>"s,
                             "<!DOCTYPE connect [<!ENTITY e SYSTEM 'http://127.0.0.1:1/'>]>"s,
                             "<?xml version='1.0'?>\n<!DOCTYPE connect PUBLIC '-//X//Y' 'http://127.0.0.1:1/x.dtd'>"s}) {
        EXPECT_EQ(fault(type + document("connect")).code, FaultCode::forbidden_xml) << type;
    }
    auto const unknown = fault(document("unsubscribe", "<subscribe_id>&e;</subscribe_id>"));
    EXPECT_EQ(unknown.code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("connect", {}, " request_id='&nbsp;'")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("<!ELEMENT connect ANY>" + document("connect")).code, FaultCode::not_well_formed);
}

TEST(BadDocument, ProcessingInstructionsAreRejected) {
    EXPECT_EQ(fault("<?php echo 1 ?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault("<?xml-stylesheet href='http://127.0.0.1:1/x.xsl'?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(document("bind", "<?p?><component_ref rois:code='a'/>")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(document("connect") + "<?p?>").code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(" <?xml version='1.0'?>" + document("connect")).code, FaultCode::not_well_formed);
}

TEST(BadDocument, OtherVersionsAndEncodingsAreRejected) {
    EXPECT_EQ(fault("<?xml version='1.1'?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault("<?xml version=\"1.0\" encoding='ISO-8859-1'?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault("<?xml version='1.0' encoding='UTF-16'?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault("<?xml version='1.0' encoding='EBCDIC-CP-US'?>" + document("connect")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault("<?xml encoding='UTF-8'?>" + document("connect")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("<?xml version='1.0' charset='UTF-8'?>" + document("connect")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("\xFF\xFE<\0c\0/\0>\0"s).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("<\0c\0/\0>\0"s).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("+ADw-connect/+AD4-").code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("\x4C\x6F\xA7\x94\x93").code, FaultCode::not_well_formed);  // EBCDIC
}

TEST(BadDocument, Utf8IsAcceptedWithAndWithoutByteOrderMark) {
    operation<Connect>("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8' standalone='yes'?>\n" + document("connect") +
                       "\n<!-- end -->\n");
    operation<Connect>("<?xml version='1.0' encoding=\"Utf-8\"?>" + document("connect"));
    operation<Connect>("\n" + document("connect"));
}

TEST(BadDocument, BytesThatAreNotCharactersAreRejected) {
    for (auto const& bytes :
         {"\xC3\x28"s, "\0"s, "\x01"s, "\x1F"s, "\xC0\x80"s, "\xE0\x80\xAF"s, "\xF0\x80\x80\xAF"s, "\xED\xA0\x80"s,
          "\xF4\x90\x80\x80"s, "\xF5\x80\x80\x80"s, "\xEF\xBF\xBE"s, "\xEF\xBF\xBF"s, "\x80"s, "\xE2\x82"s, "\xFE"s}) {
        auto const inside = fault(document("query", "<query_type>abcdefgh" + bytes + "</query_type>"));
        EXPECT_EQ(inside.code, FaultCode::not_well_formed);
        EXPECT_EQ(inside.place.value_or(Place{}).column,
                  document("query", "x").find(">x") + 2 + std::string_view{"<query_type>abcdefgh"}.size());
        EXPECT_EQ(fault(document("connect", {}, " request_id='" + bytes + "'")).request_id, "");
        EXPECT_EQ(fault(document("connect") + bytes).code, FaultCode::not_well_formed);
    }
    EXPECT_EQ(fault(document("query", "<query_type>&#1;</query_type>")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("query", "<query_type>&#xD800;</query_type>")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("query", "<query_type>&#x110000;</query_type>")).code, FaultCode::not_well_formed);
}

TEST(BadDocument, ElementsNestedTooDeeplyAreRejected) {
    EXPECT_EQ(fault(nested(64)).code, FaultCode::invalid);
    auto const deeper = fault(nested(65));
    EXPECT_EQ(deeper.code, FaultCode::forbidden_xml);
    EXPECT_THAT(deeper.reason, HasSubstr("64"));
    EXPECT_EQ(fault(nested(10'000)).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(repeated("<a>", 300'000)).code, FaultCode::forbidden_xml);
}

TEST(BadDocument, TooManyAndDuplicateAttributesAreRejected) {
    auto const with = [](std::size_t count) {
        std::string attributes;
        for (std::size_t i = 0; i < count; ++i) attributes += " a" + std::to_string(i) + "='1'";
        return document("bind", "<component_ref" + attributes + "/>");
    };
    EXPECT_EQ(fault(with(32)).code, FaultCode::invalid);
    auto const more = fault(with(33));
    EXPECT_EQ(more.code, FaultCode::forbidden_xml);
    EXPECT_THAT(more.reason, HasSubstr("32"));
    EXPECT_EQ(fault(document("bind", "<component_ref rois:code='a' rois:code='a'/>")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("connect", {}, R"( xmlns:r="http://www.omg.org/spec/RoIS/20240801" r:a="" rois:a="")")).code,
              FaultCode::not_well_formed);
}

// Returns a request with nested elements, each of which declares `each` namespaces.
std::string declaring(std::size_t elements, std::size_t each) {
    std::string text, ends;
    for (std::size_t i = 0; i < elements; ++i) {
        text += "<fes:Not";
        for (std::size_t j = 0; j < each; ++j)
            text += " xmlns:p" + std::to_string(i) + "x" + std::to_string(j) + "='http://www.opengis.net/fes/2.0'";
        text += ">";
        ends += "</fes:Not>";
    }
    text += "<fes:PropertyIsNull><fes:ValueReference>a</fes:ValueReference></fes:PropertyIsNull>" + ends;
    return document("search", "<condition><fes:Filter>" + text + "</fes:Filter></condition>");
}

TEST(BadDocument, TooManyNamespacesInScopeAreRejected) {
    std::size_t const of_root = 6;  // declared by `document`
    auto const most = 64 - of_root;
    EXPECT_TRUE(std::holds_alternative<Request>(read(declaring(2, most / 2))));
    auto const text = declaring(3, most / 2);
    auto const more = fault(text);
    EXPECT_EQ(more.code, FaultCode::forbidden_xml);
    EXPECT_EQ(more.reason, "too many namespace declarations in scope: the limit is 64");
    EXPECT_EQ(more.place.value_or(Place{}).column, text.rfind("<fes:Not ") + 1) << "of the tag with the first one too many";
    EXPECT_EQ(fault(declaring(57, 25)).reason, more.reason) << "618 KiB took 0.7 s once";
    std::string beside;
    for (int i = 0; i < 100; ++i)
        beside += "<component_ref xmlns:a='http://www.opengis.net/fes/2.0' xmlns:b='http://www.opengis.net/fes/2.0'/>";
    EXPECT_EQ(fault(document("bind", beside)).code, FaultCode::invalid) << "these are not in scope together";
}

TEST(BadDocument, LongNamesAndTooManyElementsAreRejected) {
    std::string const longest(256, 'n');
    EXPECT_EQ(fault(document("bind", "<" + longest + "/>")).code, FaultCode::invalid);
    EXPECT_THAT(fault(document("bind", "<" + longest + "n/>")).reason, HasSubstr("256"));
    EXPECT_EQ(fault(document("bind", "<" + longest + "n/>")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(document("connect", {}, " " + longest + "n=''")).code, FaultCode::forbidden_xml);
    EXPECT_EQ(fault(document("bind", repeated("<a/>", 4'999))).code, FaultCode::invalid);
    EXPECT_EQ(fault(document("bind", repeated("<a/>", 5'000))).code, FaultCode::forbidden_xml);
    EXPECT_THAT(fault(document("bind", repeated("<a/>", 5'000))).reason, HasSubstr("5000"));
}

// Returns a request with a box whose corner has these coordinates.
std::string within_box(std::string const& corner) {
    return document(
        "search",
        "<condition><fes:Filter><fes:BBOX><fes:ValueReference>location</fes:ValueReference>"
        "<gml:Envelope xmlns:gml='http://www.opengis.net/gml/3.2'><gml:lowerCorner>" +
            corner +
            "</gml:lowerCorner><gml:upperCorner>1 1</gml:upperCorner></gml:Envelope></fes:BBOX></fes:Filter></condition>");
}

TEST(BadDocument, LongListsOfNumbersAreRejected) {
    EXPECT_TRUE(std::holds_alternative<Request>(read(within_box("0 0<!-- in the corner -->"))));
    for (auto const& corner : {repeated("1 ", 400'000), repeated("1 ", 3'000) + "<!-- -->" + repeated("1 ", 3'000)}) {
        auto const refused = fault(within_box(corner));
        EXPECT_EQ(refused.code, FaultCode::forbidden_xml);
        EXPECT_THAT(refused.reason, HasSubstr("list of numbers"));
    }
}

// The scan must limit the length of every element of the schemas whose type is a list.
TEST(BadDocument, TheScanLimitsEveryListOfTheSchemas) {
    std::set<std::string> types;     // whose values are lists
    std::set<std::string> elements;  // of such a type
    for (std::size_t before = 1; before != types.size() + elements.size();) {
        before = types.size() + elements.size();
        for (auto const& [name, text] : files::schemas()) {
            pugi::xml_document schema;
            ASSERT_TRUE(schema.load_buffer(text.data(), text.size())) << name;
            auto const is_list = [&](pugi::xml_node derivation) {
                std::string const base = derivation.attribute("base").value();
                return types.contains(base.substr(base.find(':') + 1));
            };
            for (auto const& found : schema.select_nodes("//xsd:list"))
                types.insert(found.node().parent().attribute("name").value());
            for (auto const& found : schema.select_nodes("//xsd:restriction | //xsd:extension"))
                for (auto type = found.node(); is_list(found.node()) && type; type = type.parent())
                    if (type.attribute("name")) types.insert(type.attribute("name").value());
            for (auto const& found : schema.select_nodes("//xsd:element[@type]")) {
                std::string const type = found.node().attribute("type").value();
                if (types.contains(type.substr(type.find(':') + 1))) elements.insert(found.node().attribute("name").value());
            }
        }
    }
    EXPECT_THAT(elements, testing::IsSupersetOf({"pos", "lowerCorner", "position", "covariance"}));
    for (auto const& element : elements)
        EXPECT_THAT(fault("<" + element + ">" + repeated("1 ", 5'000) + "</" + element + ">").reason,
                    HasSubstr("list of numbers"))
            << element;
}

TEST(BadDocument, OneByteOverTheLimitIsTooLarge) {
    std::size_t const limit = 1 << 20;
    auto const frame = document("query", "<query_type></query_type>");
    auto whole = document("query", "<query_type>" + std::string(limit - frame.size(), 'q') + "</query_type>");
    ASSERT_EQ(whole.size(), limit);
    EXPECT_EQ(operation<rois::Query>(whole).query_type.size(), limit - frame.size());
    whole += ' ';
    EXPECT_EQ(fault(whole).code, FaultCode::too_large);
    EXPECT_THAT(fault(whole).reason, HasSubstr("1048576"));
}

TEST(BadDocument, TheGivenLimitsApply) {
    DocumentLimits const limits{.bytes = 500, .depth = 3, .attributes = 6, .name_length = 14, .elements = 3};
    EXPECT_EQ(fault(std::string(501, ' '), limits).code, FaultCode::too_large);
    EXPECT_THAT(fault("<a><a><a><a/></a></a></a>", limits).reason, HasSubstr("3"));
    EXPECT_THAT(fault("<a b='' c='' d='' e='' f='' g='' h=''/>", limits).reason, HasSubstr("6"));
    EXPECT_THAT(fault("<a123456789012345/>", limits).reason, HasSubstr("14"));
    EXPECT_THAT(fault("<a><b/><b/><b/></a>", limits).reason, HasSubstr("3"));
}

TEST(BadDocument, SchemaLocationsAreIgnored) {
    auto const taken = operation<Connect>(
        document("connect", {}, R"( xsi:schemaLocation="urn:x-rois:psm:xml:message:1 http://127.0.0.1:1/m.xsd")"));
    (void)taken;
    operation<Connect>(document("connect", {}, R"( xsi:noNamespaceSchemaLocation="file:///etc/passwd")"));
    operation<Connect>(
        document("connect", {}, R"( xsi:schemaLocation="http://www.opengis.net/gml/3.2 file:///nowhere/gml.xsd")"));
}

TEST(BadDocument, BrokenTagsAreNotWellFormed) {
    for (auto const* inside :
         {"<a b>",   "<a b=c/>",   "<a b='1'c='2'/>", "<a b='<'/>", "<a 'b'/>", "< a/>", "<a/ >", "<a =''/>", "</a>",
          "<a></b>", "<a",         "<!-- -- -->",     "<![CDATA[",  "]]>",      "&",     "&#x;",  "<1/>",     "<a:b:c/>",
          "<x:a/>",  "<a x:b=''/>"}) {
        EXPECT_EQ(fault(document("bind", inside)).code, FaultCode::not_well_formed) << inside;
    }
    EXPECT_EQ(fault(document("connect") + document("connect")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("connect") + "text").code, FaultCode::not_well_formed);
    EXPECT_EQ(fault("connect").code, FaultCode::not_well_formed);
}

TEST(BadDocument, NotWellFormedTakesPrecedenceOverInvalid) {
    EXPECT_EQ(fault(document("bind", "<foo/><b>")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("bind", "<component_ref xmlns='urn:foreign'/><b>")).code, FaultCode::not_well_formed);
    EXPECT_EQ(fault(document("bind", "<component_ref xmlns='urn:foreign'/>")).code, FaultCode::invalid);
}

TEST(BadDocument, XsiNilIsInvalid) {
    for (auto const* nil : {"true", "false", "1", "0"}) {
        auto const text = document("bind", "<component_ref rois:code='a' xsi:nil='"s + nil + "'/>");
        EXPECT_EQ(fault(text).code, FaultCode::invalid) << nil;
    }
}

TEST(BadDocument, ReasonsAreShortAndOnOneLine) {
    auto const refused = fault(document("connect", {}, " request_id='r' x='" + std::string(5'000, 'x') + "'"));
    EXPECT_LT(refused.reason.size(), 400u);
    auto const value =
        fault(document("subscribe", "<event_type>e</event_type>", " inline_results='a&#10;b" + std::string(500, 'x') + "'"));
    EXPECT_LT(value.reason.size(), 400u);
    EXPECT_EQ(value.reason.find('\n'), std::string::npos);
    auto const mismatch = fault("<" + std::string(200, 'y') + ">");
    EXPECT_LT(mismatch.reason.size(), 400u);
}

TEST(RequestId, OfMoreThan256CharactersIsInvalidAndNotRepeated) {
    std::string euros;
    for (int i = 0; i < 256; ++i) euros += "&#x20AC;";
    EXPECT_EQ(request(document("connect", {}, " request_id='" + euros + "'")).request_id.size(), 3 * 256u);
    auto const refused = fault("\n " + document("connect", {}, " request_id='" + euros + "x'"));
    EXPECT_EQ(refused.code, FaultCode::invalid);
    EXPECT_THAT(refused.reason, HasSubstr("has 257 characters: expected 256 at most"));
    EXPECT_THAT(refused.reason, HasSubstr("request_id '"));
    EXPECT_EQ(refused.request_id, "");
    ASSERT_TRUE(refused.place);
    EXPECT_EQ(refused.place->line, 2u);
    EXPECT_EQ(refused.place->column, 2u);
    EXPECT_EQ(fault(document("nonsense", {}, " request_id='" + euros + "'")).request_id.size(), 3 * 256u);
    EXPECT_EQ(fault(document("nonsense", {}, " request_id='" + euros + "x'")).request_id, "");
}

TEST(BadDocument, TheFaultHasTheRequestIdIfItCanBeRead) {
    EXPECT_EQ(fault(document("bind", {}, " request_id='r1'")).request_id, "r1");
    EXPECT_EQ(fault(document("nonsense", {}, " request_id='a&amp;b&#x20AC;\tc'")).request_id, "a&b\xE2\x82\xAC c");
    EXPECT_EQ(fault(document("bind", "<a></b>", " request_id=\"r2\"")).request_id, "r2");
    EXPECT_EQ(
        fault("<?xml version='1.0'?><!-- <a request_id='no'/> -->\n" + document("bind", "\x01", " request_id='r3'")).request_id,
        "r3");
    EXPECT_EQ(fault("<bind request_id='r4' x='1").request_id, "");
    EXPECT_EQ(fault(document("bind", "<a request_id='r5'/>")).request_id, "");
    EXPECT_EQ(fault(nested(65).insert(7, " request_id='r6'")).request_id, "r6");
    EXPECT_EQ(fault(document("connect_response", {}, " return_code='OK' request_id='r7'")).request_id, "r7");
}

}  // namespace
}  // namespace rois::xml
