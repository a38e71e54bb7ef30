// Decoding of requests, in the forms that XML allows.
#include <gmock/gmock.h>

#include <array>
#include <limits>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view reference =
    R"(<component_ref rois:authority="OMG" rois:code="navigation" rois:codebook_ref="cb" rois:version="1"/>)";
Identifier const navigation{"navigation", "OMG", "cb", "1"};

TEST(Request, EveryOperationIsRead) {
    operation<Connect>(document("connect"));
    operation<Disconnect>(document("disconnect"));
    EXPECT_FALSE(operation<GetProfile>(document("get_profile")).condition.filter);
    EXPECT_FALSE(operation<Search>(document("search")).condition.filter);
    EXPECT_FALSE(operation<BindAny>(document("bind_any")).condition.filter);
    EXPECT_EQ(operation<GetErrorDetail>(document("get_error_detail", "<error_id>e1</error_id>")).error_id, ErrorId{"e1"});
    EXPECT_EQ(operation<Bind>(document("bind", reference)).component_ref, navigation);
    EXPECT_EQ(operation<Release>(document("release", reference)).component_ref, navigation);
    EXPECT_EQ(operation<GetParameter>(document("get_parameter", reference)).component_ref, navigation);
    EXPECT_EQ(operation<GetCommandResult>(document("get_command_result", "<command_id>c1</command_id>")).command_id,
              CommandId{"c1"});
    EXPECT_EQ(operation<rois::Query>(document("query", "<query_type>robot_position</query_type>")).query_type, "robot_position");
    EXPECT_EQ(operation<Unsubscribe>(document("unsubscribe", "<subscribe_id>s1</subscribe_id>")).subscribe_id, SubscribeId{"s1"});
    EXPECT_EQ(operation<GetEventDetail>(document("get_event_detail", "<event_id>v1</event_id>")).event_id, EventId{"v1"});
    operation<StopEverything>(document("stop_everything"));
    EXPECT_EQ(operation<ClearStop>(document("clear_stop", {}, " stop='3'")).stop, 3u);
}

TEST(Request, ResumeHasSessionAndLastSequence) {
    auto const resume = operation<Resume>(document("resume", {}, " session='s' last_sequence=' 42 '"));
    EXPECT_EQ(resume.session, SessionId{"s"});
    EXPECT_EQ(resume.last_sequence, 42u);
    auto const last = operation<Resume>(document("resume", {}, " session='s' last_sequence='18446744073709551615'"));
    EXPECT_EQ(last.last_sequence, std::numeric_limits<std::uint64_t>::max());
}

TEST(Request, SubscribeReadsInlineResults) {
    auto const inline_results = [](std::string_view value) {
        return operation<Subscribe>(document("subscribe", "<event_type>e</event_type>", value)).inline_results;
    };
    EXPECT_FALSE(inline_results(""));
    EXPECT_TRUE(inline_results(" inline_results='true'"));
    EXPECT_TRUE(inline_results(" inline_results=' 1\n'"));
    EXPECT_FALSE(inline_results(" inline_results='false'"));
    EXPECT_FALSE(inline_results(" inline_results='0'"));
}

TEST(Request, AnEngineConnectsWithItsRole) {
    auto const application = operation<Connect>(document("connect", {}, " role='application'"));
    EXPECT_FALSE(application.is_engine);
    EXPECT_FALSE(application.window);
    auto const engine = operation<Connect>(document("connect", {}, " role='engine' window='3000'"));
    EXPECT_TRUE(engine.is_engine);
    EXPECT_EQ(engine.window, std::chrono::seconds{3});
    EXPECT_THAT(encode(Request{engine, {}}), HasSubstr(" role=\"engine\" window=\"3000\""));
}

TEST(Request, BindingsAndSessionsAskForSwitches) {
    std::string const ref = "<component_ref rois:code='navigation'/>";
    EXPECT_EQ(operation<Bind>(document("bind", ref)).switching, Switching::none);
    EXPECT_EQ(operation<Bind>(document("bind", ref, " switching='abort'")).switching, Switching::abort);
    EXPECT_EQ(operation<BindAny>(document("bind_any", {}, " switching='restart'")).switching, Switching::restart);
    EXPECT_THAT(encode(Request{BindAny{{}, Switching::restart}, {}}), HasSubstr(" switching=\"restart\""));
    EXPECT_THAT(encode(Request{Bind{}, {}}), Not(HasSubstr("switching")));
    EXPECT_TRUE(operation<Bind>(document("bind", ref, " take_over='1'")).take_over);
    EXPECT_FALSE(operation<Bind>(document("bind", ref, " take_over='false'")).take_over);
    EXPECT_FALSE(operation<Bind>(document("bind", ref)).take_over);
    EXPECT_THAT(encode(Request{Bind{{}, Switching::none, true}, {}}), HasSubstr(" take_over=\"true\""));
    EXPECT_THAT(encode(Request{Bind{}, {}}), Not(HasSubstr("take_over")));
    Connect connect;
    EXPECT_THAT(encode(Request{connect, {}}), Not(HasSubstr("switches")));
    connect.switches = operation<Connect>(document("connect", {}, " switches='true'")).switches;
    EXPECT_THAT(encode(Request{connect, {}}), HasSubstr(" switches=\"true\""));
}

TEST(Request, CommandsMayBeCheckedOnly) {
    std::string const unit = "<rois:command_unit_list rois:delay_time='5'/>";
    std::string const sequence = "<rois:CommandUnitSequence>" + unit + "</rois:CommandUnitSequence>",
                      ref = "<component_ref rois:code='speech'/><parameters/>";
    EXPECT_FALSE(operation<Execute>(document("execute", sequence)).check_only);
    EXPECT_TRUE(operation<Execute>(document("execute", sequence, " check_only='true'")).check_only);
    EXPECT_FALSE(operation<SetParameter>(document("set_parameter", ref)).check_only);
    EXPECT_TRUE(operation<SetParameter>(document("set_parameter", ref, " check_only='1'")).check_only);
    EXPECT_THAT(encode(Request{Execute{{}, true}, {}}), HasSubstr(" check_only=\"true\""));
    EXPECT_THAT(encode(Request{Execute{}, {}}), Not(HasSubstr("check_only")));
}

TEST(Request, RequestIdIsKept) {
    EXPECT_EQ(request(document("connect", {}, " request_id='a b &lt;&#x20AC;'")).request_id, "a b <\xE2\x82\xAC");
    EXPECT_EQ(request(document("connect")).request_id, "");
}

TEST(Request, ParametersAreRead) {
    auto const set = operation<SetParameter>(document("set_parameter", std::string{reference} + R"(<parameters>
        <parameter rois:name="speech_text"><rois:data_type_ref rois:code="string"/><rois:value>Welcome.</rois:value></parameter>
        <parameter rois:name="names"><rois:data_type_ref rois:code="string[]"/><rois:value>a</rois:value><rois:value/><rois:value> </rois:value></parameter>
        <parameter rois:name="none"><rois:data_type_ref rois:code="string[]" rois:codebook_ref="cb"/></parameter>
    </parameters>)"));
    EXPECT_THAT(set.parameters, ElementsAre(Parameter{"speech_text", {"string", {}, {}, {}}, {"Welcome."}},
                                            Parameter{"names", {"string[]", {}, {}, {}}, {"a", "", " "}},
                                            Parameter{"none", {"string[]", {}, "cb", {}}, {}}));
}

TEST(Request, TextIsReadByTheRulesOfXml) {
    auto const text = [](std::string_view written) {
        return operation<rois::Query>(document("query", "<query_type>" + std::string{written} + "</query_type>")).query_type;
    };
    EXPECT_EQ(text("a<![CDATA[<b>&amp;]]>c"), "a<b>&amp;c");
    EXPECT_EQ(text("a<!-- b -->c"), "ac");
    EXPECT_EQ(text("&lt;&amp;&gt;&quot;&apos;&#65;&#x1F600;"), "<&>\"'A\xF0\x9F\x98\x80");
    EXPECT_EQ(text("a\r\nb\rc&#13;d"), "a\nb\nc\rd");
    EXPECT_EQ(text("  \t "), "  \t ");
    EXPECT_EQ(text("<![CDATA[]]>"), "");
    EXPECT_EQ(text("a<!-- 1 -->b<![CDATA[c]]>d<!-- 2 --><!-- 3 -->&#101;<![CDATA[f]]>"), "abcdef");
    EXPECT_EQ(text("<![CDATA[\r\n]]>"), "\n");
    EXPECT_EQ(text("<![CDATA[ ]]>"), " ");
    EXPECT_EQ(text("a<![CDATA[]]>b<![CDATA[ \t ]]>c"), "ab \t c");
    EXPECT_EQ(text("<![CDATA[\r]]>\n"), "\n\n");
    EXPECT_EQ(text("\r<![CDATA[\n\r\r]]>\n"), "\n\n\n\n\n");
    EXPECT_EQ(text(""), "");
    EXPECT_EQ(operation<Bind>(document("bind", "<component_ref rois:code='a\t\r\nb&#10;&#9;c  d '/>")).component_ref.code,
              "a  b\n\tc  d ");
}

// XSD 1.0, cvc-complex-type 2: white space in any form is allowed between elements, but no character in an empty element.
TEST(Request, MayHaveWhiteSpaceAndEmptyCdataBetweenElements) {
    auto const is_request = [](std::string const& text) { return std::holds_alternative<Request>(read(text)); };
    std::string const ref = "<component_ref rois:code='a'/>";
    auto const everywhere = [&](std::string const& text) {
        return std::array{is_request(document("bind", text + ref)), is_request(document("bind", ref + text)),
                          is_request(document("search", text))};
    };
    for (auto const* blank :
         {" ", "\r\n\t", "<![CDATA[]]>", "<![CDATA[ \r\n\t]]>", "<!-- c --> <![CDATA[]]><![CDATA[ ]]> ", "&#32;&#x9;"})
        EXPECT_THAT(everywhere(blank), Each(true)) << blank;
    for (auto const* text : {"x", "<![CDATA[x]]>", "<![CDATA[ x ]]>", "<![CDATA[<]]>", "<![CDATA[ <!-- -->]]>", "&#160;"})
        EXPECT_THAT(everywhere(text), Each(false)) << text;
    EXPECT_TRUE(is_request(document("connect", "<![CDATA[]]>")));
    EXPECT_FALSE(is_request(document("connect", "<![CDATA[ ]]>")));
    EXPECT_FALSE(is_request(document("connect", " ")));
    EXPECT_FALSE(is_request("<![CDATA[]]>" + document("connect")));
    EXPECT_FALSE(is_request(document("connect") + "<![CDATA[]]>"));
}

TEST(Request, AnyPrefixesAreRead) {
    auto const bind = operation<Bind>(
        R"(<m:bind xmlns:m="urn:x-rois:psm:xml:message:1"><m:component_ref xmlns:q="http://www.omg.org/spec/RoIS/20240801" q:code="a"/></m:bind>)");
    EXPECT_EQ(bind.component_ref.code, "a");
    auto const execute = operation<Execute>(R"(<e:execute xmlns:e="urn:x-rois:psm:xml:message:1">
        <CommandUnitSequence xmlns="http://www.omg.org/spec/RoIS/20240801" xmlns:i="http://www.w3.org/2001/XMLSchema-instance" xmlns:r="http://www.omg.org/spec/RoIS/20240801">
          <command_unit_list i:type="CommandMessageType" r:command_type="start" r:command_id=""><component_ref r:code="a"/></command_unit_list>
          <command_unit_list i:type=" z:CommandMessageType " xmlns:z="http://www.omg.org/spec/RoIS/20240801" r:command_type="stop" r:command_id=""><component_ref r:code="b"/></command_unit_list>
        </CommandUnitSequence></e:execute>)");
    ASSERT_EQ(execute.command_unit_list.command_unit_list.size(), 2u);
    EXPECT_EQ(std::get<CommandMessage>(execute.command_unit_list.command_unit_list[1].unit).component_ref.code, "b");
}

TEST(Request, TheNamespaceOf2015IsRead) {
    auto const old = R"(<bind xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20151201">
        <component_ref rois:code="http://www.omg.org/spec/RoIS/20151201"/></bind>)";
    EXPECT_EQ(operation<Bind>(old).component_ref.code, "http://www.omg.org/spec/RoIS/20151201");
    auto const both =
        R"(<bind xmlns="urn:x-rois:psm:xml:message:1" xmlns:o='http://www.omg.org/spec/RoIS/20151201' xmlns:n="http://www.omg.org/spec/RoIS/20240801">
        <component_ref o:code="c" n:version="v"/></bind>)";
    EXPECT_EQ(operation<Bind>(both).component_ref, (Identifier{"c", {}, {}, "v"}));
}

constexpr std::string_view sequence = R"(
  <rois:CommandUnitSequence>
    <rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="c1" rois:delay_time="200">
      <rois:component_ref rois:code="speech_synthesis"/>
      <rois:arguments><rois:parameter rois:name="speech_text"><rois:data_type_ref rois:code="string"/><rois:value>Hi</rois:value></rois:parameter></rois:arguments>
    </rois:command_unit_list>
    <rois:command_unit_list rois:delay_time="-5"/>
    <rois:command_unit_list xsi:type="rois:ConcurrentCommandsType">
      <rois:branch_list>
        <rois:command_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id=""><rois:component_ref rois:code="a"/></rois:command_list>
        <rois:command_list rois:command_type="stop" rois:command_id="" rois:delay_time="1"><rois:component_ref rois:code="b"/></rois:command_list>
      </rois:branch_list>
      <rois:branch_list>
        <rois:command_list rois:command_type="start" rois:command_id=""><rois:component_ref rois:code="c"/></rois:command_list>
      </rois:branch_list>
    </rois:command_unit_list>
    <rois:command_unit_list xsi:type="rois:ConcurrentCommandsType" rois:delay_time="7">
      <rois:command_list rois:command_type="x" rois:command_id=""><rois:component_ref rois:code="d"/></rois:command_list>
      <rois:command_list rois:command_type="y" rois:command_id=""><rois:component_ref rois:code="e"/></rois:command_list>
    </rois:command_unit_list>
    <rois:command_unit_list xsi:type="rois:ParallelCommandUnitType">
      <rois:command_unit_list xsi:type="rois:SequentialCommandUnitType" rois:delay_time="99999999999999999999999">
        <rois:command_unit_list rois:delay_time="-99999999999999999999999"/>
      </rois:command_unit_list>
    </rois:command_unit_list>
  </rois:CommandUnitSequence>)";

TEST(Request, CommandSequencesAreRead) {
    auto const units = operation<Execute>(document("execute", sequence)).command_unit_list.command_unit_list;
    ASSERT_EQ(units.size(), 5u);
    auto const& speak = std::get<CommandMessage>(units[0].unit);
    EXPECT_EQ(units[0].delay_time, 200);
    EXPECT_EQ(speak.component_ref.code, "speech_synthesis");
    EXPECT_EQ(speak.command_type, "start");
    EXPECT_EQ(speak.command_id, CommandId{"c1"});
    EXPECT_THAT(speak.arguments, ElementsAre(Parameter{"speech_text", {"string", {}, {}, {}}, {"Hi"}}));
    EXPECT_TRUE(std::holds_alternative<DelayOnly>(units[1].unit));
    EXPECT_EQ(units[1].delay_time, -5);

    auto const& branches = std::get<ConcurrentCommands>(units[2].unit);
    EXPECT_EQ(branches.form, ConcurrentCommands::Form::branch_list);
    ASSERT_EQ(branches.branches.size(), 2u);
    ASSERT_EQ(branches.branches[0].command_list.size(), 2u);
    EXPECT_EQ(branches.branches[0].command_list[1].delay_time, 1);
    EXPECT_EQ(std::get<CommandMessage>(branches.branches[0].command_list[1].unit).command_type, "stop");

    auto const& flat = std::get<ConcurrentCommands>(units[3].unit);
    EXPECT_EQ(flat.form, ConcurrentCommands::Form::command_list);
    EXPECT_EQ(units[3].delay_time, 7);
    ASSERT_EQ(flat.branches.size(), 2u);
    EXPECT_EQ(std::get<CommandMessage>(flat.branches[1].command_list.at(0).unit).component_ref.code, "e");

    auto const& parallel = std::get<ParallelCommandUnit>(units[4].unit);
    ASSERT_EQ(parallel.command_unit_list.size(), 1u);
    EXPECT_EQ(parallel.command_unit_list[0].delay_time, std::numeric_limits<std::int64_t>::max());
    auto const& inner = std::get<SequentialCommandUnit>(parallel.command_unit_list[0].unit);
    EXPECT_EQ(inner.command_unit_list.at(0).delay_time, std::numeric_limits<std::int64_t>::min());
}

std::string echo(CommandUnitSequence const& units) {
    Execute::Reply reply;
    reply.command_unit_list = units;
    return encode(Reply{reply}, "");
}

TEST(Request, CommandSequencesRoundTrip) {
    auto const first = operation<Execute>(document("execute", sequence));
    auto const answer = echo(first.command_unit_list);
    EXPECT_EQ(problem("answer", answer), "");
    auto const begin = answer.find("<rois:CommandUnitSequence"), end = answer.find("</execute_response");
    auto const again = operation<Execute>(document("execute", answer.substr(begin, end - begin)));
    EXPECT_EQ(echo(again.command_unit_list), answer);
}

TEST(Request, OneReaderReadsManyDocuments) {
    RequestReader reader{schemas()};
    for (int i = 0; i < 100; ++i) {
        EXPECT_TRUE(std::holds_alternative<Request>(reader.read(document("bind", reference))));
        EXPECT_TRUE(std::holds_alternative<Fault>(reader.read(document("bind", "<nonsense/>"))));
        EXPECT_TRUE(std::holds_alternative<Fault>(reader.read("<")));
    }
    RequestReader moved{std::move(reader)};
    EXPECT_TRUE(std::holds_alternative<Request>(moved.read(document("connect"))));
}

}  // namespace
}  // namespace rois::xml
