// The documents that the gateway writes: every kind is valid against the schemas.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::HasSubstr;
using testing::Not;

// Characters that XML must escape, and characters that it does not allow.
using namespace std::string_literals;
std::string const strange = "<&>\"'\t\n\r ]]> \xC3\xA4\xF0\x9F\x98\x80 \x01\0\xC3( \xED\xA0\x80"s;

Identifier const component{"navi<gation", "OMG", "cb", "1"};

// Returns a successful reply with this member set.
template <class R, class Value>
Reply answer(Value R::*member, std::type_identity_t<Value> value) {
    R reply;
    reply.*member = std::move(value);
    return reply;
}

Reply query_reply(Identifier component_ref, Results results) {
    rois::Query::Reply reply;
    reply.component_ref = std::move(component_ref);
    reply.results = std::move(results);
    return reply;
}

Results results() {
    Results all;
    all.parameters.push_back({"number", {"int", {}, {}, {}}, {"2"}});
    all.parameters.push_back({strange, {strange, strange, strange, strange}, {strange, "", " "}});
    all.parameters.push_back({"none", {"string[]", {}, {}, {}}, {}});
    all.located.push_back({"position", "person_1", "urn:hall", {1, -2.5, 1e300}, {}, {}});
    all.located.push_back({"position", strange, "", {0.1, 0, -0.0}, {0, 0, 90}, Located::Reliability{0.25}});
    all.located.push_back({"position",
                           "p",
                           "",
                           {std::numeric_limits<double>::infinity(), 1 / 3.0, std::numeric_limits<double>::quiet_NaN()},
                           {},
                           Located::Covariance{{1, 0, 0, 1}}});
    return all;
}

ComponentProfile component_profile() {
    ParameterProfile const parameter{"p", {"int", {}, {}, {}}, "5", "a \"number\""};
    ParameterProfile const other{"q", {"String[]", {}, {}, {}}, {}, {}};
    ComponentProfile profile{
        {"urn:x-rois:def:component:OMG::Navigation", "urn:ietf:rfc:2141", "Navigation", "goes", "urn:adapter"},
        {"urn:sub"},
        {},
        {parameter}};
    profile.messages.push_back({MessageKind::command, "start", {parameter}, {parameter, other}, std::chrono::milliseconds{500}});
    profile.messages.push_back({MessageKind::query, "where", {parameter}, {}, {}});
    profile.messages.push_back({MessageKind::event, "reached", {}, {}, {}});
    return profile;
}

EngineProfile engine_profile() {
    EngineProfile const sub{{"urn:sub", "cs", "sub 1", "", ""}, {}, {"sub1.a"}, {}};
    return {{"urn:main", "cs", "main", "the <main> one", ""}, {sub}, {"a", "urn:x:b"}, {{"p", {"int", {}, {}, {}}, {}, ""}}};
}

GetProfile::Reply profile_reply() {
    GetProfile::Reply reply;
    reply.profile = std::make_shared<EngineProfile const>(engine_profile());
    auto const profile = std::make_shared<ComponentProfile const>(component_profile());
    reply.components = {
        {"a", "urn:t", "main", profile}, {"sub1.a", "urn:t", "sub 1", profile}, {"urn:x:b", "urn:t", "main", profile}};
    return reply;
}

CommandUnitSequence sequence() {
    CommandMessage const say{component, "start", CommandId{strange}, results().parameters};
    CommandMessage const wait{component, "stop", CommandId{"c2"}, {}};
    Branch const branch{{CommandUnit{{}, say}, CommandUnit{5, wait}}};
    ConcurrentCommands const branches{ConcurrentCommands::Form::branch_list, {branch, branch}};
    ConcurrentCommands const flat{ConcurrentCommands::Form::command_list, {Branch{{CommandUnit{{}, wait}}}}};
    SequentialCommandUnit const nested{{CommandUnit{{}, ParallelCommandUnit{{CommandUnit{-1, DelayOnly{}}}}}}};
    return {{CommandUnit{200, say}, CommandUnit{{}, branches}, CommandUnit{7, flat}, CommandUnit{{}, nested},
             CommandUnit{{}, DelayOnly{}}}};
}

// Returns a successful reply of every operation.
std::vector<Reply> good_replies() {
    return {answer(&Connect::Reply::session, SessionId{strange}),
            Resume::Reply{},
            Disconnect::Reply{},
            profile_reply(),
            answer(&GetErrorDetail::Reply::results, results()),
            answer(&Search::Reply::component_ref_list, {component, {"b", {}, {}, {}}}),
            Bind::Reply{},
            answer(&BindAny::Reply::component_ref, component),
            Release::Reply{},
            answer(&GetParameter::Reply::parameters, results().parameters),
            answer(&SetParameter::Reply::command_id, CommandId{strange}),
            answer(&Execute::Reply::command_unit_list, sequence()),
            answer(&GetCommandResult::Reply::results, results()),
            query_reply(component, results()),
            answer(&Subscribe::Reply::subscribe_id, SubscribeId{strange}),
            Unsubscribe::Reply{},
            answer(&GetEventDetail::Reply::results, Results{}),
            answer(&StopEverything::Reply::not_halted, {strange, "b"}),
            ClearStop::Reply{}};
}

TEST(Answer, EverySuccessfulReplyIsValid) {
    auto const all = good_replies();
    ASSERT_EQ(all.size(), std::variant_size_v<Reply>);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].index(), i);
        auto const text = encode(all[i], strange);
        EXPECT_EQ(problem("answer", text), "") << text;
        EXPECT_THAT(text, HasSubstr("return_code=\"OK\""));
        EXPECT_THAT(text, Not(HasSubstr("<reason")));
        EXPECT_THAT(text, Not(HasSubstr("<?xml")));
    }
}

TEST(Answer, EveryFailedReplyHasOnlyAReason) {
    for (auto code : {ReturnCode::error, ReturnCode::bad_parameter, ReturnCode::unsupported, ReturnCode::out_of_resources,
                      ReturnCode::timeout}) {
        for (auto reply : good_replies()) {
            std::visit([&](auto& each) { each.return_code = code, each.reason = strange; }, reply);
            auto const text = encode(reply, "r");
            EXPECT_EQ(problem("answer", text), "") << text;
            Document const parsed = Document::parse(schemas(), "answer", text);
            EXPECT_EQ(parsed.root().attribute("return_code"), to_text(code));
            EXPECT_EQ(parsed.root().attribute("request_id"), "r");
            ASSERT_EQ(parsed.root().children().size(), 1u);
            EXPECT_EQ(parsed.root().children()[0].name(), "reason");
        }
    }
}

TEST(Answer, HasTheShortFormOfTheContract) {
    EXPECT_EQ(encode(Reply{Bind::Reply{}}, ""), R"(<bind_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK"/>)");
    EXPECT_EQ(
        encode(answer(&Connect::Reply::session, SessionId{"s"}), "1"),
        R"(<connect_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK" request_id="1"><session>s</session></connect_response>)");
    EXPECT_EQ(
        encode(answer(&BindAny::Reply::component_ref, {"a", {}, {}, {}}), ""),
        R"(<bind_any_response xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" return_code="OK">)"
        R"(<component_ref rois:code="a"/></bind_any_response>)");
}

TEST(Answer, OfAQueryMayHaveSeveralRows) {
    auto const row = [](std::string const& number) { return Results{{{"number", {"int", {}, {}, {}}, {number}}}, {}}; };
    auto reply = std::get<rois::Query::Reply>(query_reply(component, row("1")));
    reply.other_rows = {row("2"), row("3")};
    auto const text = encode(Reply{reply}, "7");
    EXPECT_EQ(problem("answer", text), "") << text;
    auto const read = AnswerReader{}.read(text);
    ASSERT_TRUE(read) << text;
    auto const again = std::get<rois::Query::Reply>(std::get<Answered>(*read).reply);
    EXPECT_EQ(again.results.parameters, row("1").parameters);
    ASSERT_EQ(again.other_rows.size(), 2u);
    EXPECT_EQ(again.other_rows[0].parameters, row("2").parameters);
    EXPECT_EQ(again.other_rows[1].parameters, row("3").parameters);
}

TEST(Answer, OfGetProfileHasFramesAndPlacesForEngines) {
    auto reply = profile_reply();
    auto const text_without = encode(Reply{reply}, "7");
    EXPECT_THAT(text_without, Not(HasSubstr("<space")));
    Frame const map{.crs = strange.substr(0, 5),
                    .base = "urn:hall",
                    .position = {1, -2.5, 1e300},
                    .orientation = {0, 0, 90},
                    .covariance = {4, 0, 0, 0, 4, 0, 0, 0, 0.25}};
    Frame const cart{.crs = "cart", .base = map.crs, .position = {}, .orientation = {}, .covariance = {}};
    NamedPlace const lab{"lab", {.crs = "urn:hall", .low = {0, -1, 0}, .high = {1, 2.5, 0}, .dimensions = 2}};
    NamedPlace const shelf{"<shelf>", {.crs = "", .low = {0, 0, 1}, .high = {0, 0, 2}, .dimensions = 3}};
    reply.space = {{map, cart}, {lab, shelf}};
    auto const text = encode(Reply{reply}, "7");
    EXPECT_EQ(problem("answer", text), "") << text;
    auto const read = AnswerReader{}.read(text);
    ASSERT_TRUE(read) << text;
    auto const again = std::get<GetProfile::Reply>(std::get<Answered>(*read).reply);
    EXPECT_EQ(again.space, reply.space) << text;
    EXPECT_EQ(again.components.size(), reply.components.size());
}

TEST(AnswerReader, KeepsInvalidFramesAndPlacesForTheEngineToReport) {
    auto reply = profile_reply();
    reply.space.places = {{"lab", {}}};
    auto text = encode(Reply{reply}, "7");
    auto const at = text.find("<low>");
    text.replace(at, text.find("</place>") - at, "<low>1 2</low><high>3</high>");
    text.insert(text.find("<place"), "<frame crs=\"map\"><position>0 x 0</position></frame>");
    auto const read = AnswerReader{}.read(text);
    ASSERT_TRUE(read) << text;
    auto const& space = std::get<GetProfile::Reply>(std::get<Answered>(*read).reply).space;
    ASSERT_EQ(space.frames.size(), 1U);
    EXPECT_TRUE(std::isnan(space.frames[0].position[1]));
    EXPECT_TRUE(std::isnan(space.frames[0].orientation[0])) << "missing";
    ASSERT_EQ(space.places.size(), 1U);
    EXPECT_EQ(space.places[0].area.dimensions, 0);
}

TEST(Answer, ValuesRoundTrip) {
    std::string const carried = "<&>\"'\t\n\r ]]> \xC3\xA4\xF0\x9F\x98\x80  ";
    auto const reply = query_reply({carried, carried, {}, {}}, {{{carried, {carried, {}, {}, {}}, {carried, "", " "}}}, {}});
    auto const root = Document::parse(schemas(), "answer", encode(reply, carried)).root();
    EXPECT_EQ(root.attribute("request_id"), carried);
    EXPECT_EQ(child(root, "component_ref").attribute("authority"), carried);
    auto const result = child(child(root, "results"), "result");
    EXPECT_EQ(result.attribute("name"), carried);
    auto const values = result.children("value");
    ASSERT_EQ(values.size(), 3u);
    EXPECT_EQ(values[0].text(), carried);
    EXPECT_EQ(values[1].text(), "");
    EXPECT_EQ(values[2].text(), " ");
}

TEST(Answer, InvalidCharactersAreReplaced) {
    auto const session = [](std::string const& text) {
        return child(Document::parse(schemas(), "answer", encode(answer(&Connect::Reply::session, SessionId{text}), "")).root(),
                     "session")
            .text();
    };
    std::string const replaced = "\xEF\xBF\xBD";
    EXPECT_EQ(session("a\x01"
                      "b\0c"s),
              "a" + replaced + "b" + replaced + "c");
    EXPECT_EQ(session("\xC3(\xEF\xBF\xBF"), replaced + "(" + replaced);
    EXPECT_EQ(session("\xE2\x82"), replaced + replaced);
}

TEST(Answer, NumbersAreShortAndRoundTrip) {
    auto const root = Document::parse(schemas(), "answer", encode(answer(&GetEventDetail::Reply::results, results()), "")).root();
    auto const located = child(root, "results").children("located");
    ASSERT_EQ(located.size(), 3u);
    EXPECT_EQ(child(located[0], "position").text(), "1 -2.5 1e+300");
    EXPECT_FALSE(located[0].child("orientation"));
    EXPECT_EQ(child(located[1], "position").text(), "0.1 0 -0");
    EXPECT_EQ(child(located[1], "orientation").text(), "0 0 90");
    EXPECT_EQ(child(located[1], "reliability").text(), "0.25");
    EXPECT_EQ(child(located[2], "position").text(), "INF 0.3333333333333333 NaN");
    EXPECT_EQ(child(located[2], "covariance").text(), "1 0 0 1");
    EXPECT_EQ(located[2].attribute("crs"), "");
}

TEST(Answer, AProfileHasOneIdForEachObject) {
    auto const text = encode(Reply{profile_reply()}, "");
    for (auto const* id :
         {"\"engine.main\"", "\"engine.sub_x20_1\"", "\"profile.a\"", "\"profile.sub1.a\"", "\"profile.urn_x3A_x_x3A_b\""}) {
        EXPECT_THAT(text, HasSubstr(std::string{"gml:id="} + id));
    }
}

TEST(Answer, ProfileIdsKeepTheCharactersOfXmlNames) {
    for (auto const& [name, id] :
         {std::pair{"profile.ランプ", "profile.ランプ"}, {"profile.é1", "profile.é1"}, {"1ラ", "_x31_ラ"}}) {
        auto const text = encode(ComponentProfile{}, name);
        EXPECT_THAT(text, HasSubstr("gml:id=\"" + std::string{id} + '"'));
        EXPECT_EQ(problem("profile", text), "") << text;
    }
}

TEST(Answer, ProfileIdsEscapeOtherCharacters) {
    std::vector<std::pair<std::string, std::string>> const ids{
        {"profile.😀", "profile._xF0__x9F__x98__x80_"},
        {"profile._xF0__x9F__x98__x80_", "profile._x5F_xF0__x5F_x9F__x5F_x98__x5F_x80_"},
        {"profile._x20 ", "profile._x5F_x20_x20_"},
        {"profile.𠮷野", "profile._xF0__xA0__xAE__xB7_野"},
        {"profile.desk_xylophone", "profile.desk_xylophone"}};
    for (auto const& [name, id] : ids) {
        auto const text = encode(ComponentProfile{}, name);
        EXPECT_THAT(text, HasSubstr("gml:id=\"" + id + '"'));
        EXPECT_EQ(problem("profile", text), "") << text;
    }
}

TEST(FaultDocument, OfEveryCodeIsValid) {
    for (int code = 0; code <= static_cast<int>(FaultCode::shutting_down); ++code) {
        Fault const bare{static_cast<FaultCode>(code), "", {}, ""};
        EXPECT_EQ(problem("fault", encode(bare)), "");
        Fault const full{static_cast<FaultCode>(code), strange, Place{2, 7}, strange};
        EXPECT_EQ(problem("fault", encode(full)), "");
    }
    EXPECT_EQ(
        encode(Fault{FaultCode::invalid, "a<b", Place{2, 7}, "r\"1"}),
        R"(<fault xmlns="urn:x-rois:psm:xml:message:1" code="invalid" line="2" column="7" request_id="r&quot;1"><reason>a&lt;b</reason></fault>)");
}

std::vector<Notification> notifications() {
    Utc const expire{std::chrono::milliseconds{1'795'176'000'123}};
    ReceiveEvent const bare{EventId{"e1"}, "person_detected", SubscribeId{"s1"}, expire, component, nullptr};
    ReceiveEvent with_results{EventId{strange}, strange,   SubscribeId{strange},
                              expire,           component, std::make_shared<Results const>(results())};
    return {bare,
            with_results,
            ReceiveError{ErrorId{"x"}, ErrorType::component_not_responding, component},
            ReceiveError{ErrorId{strange}, {}, {}},
            Completed{CommandId{strange}, CompletedStatus::abort},
            ReceiveError{ErrorId{"x"}, ErrorType::component_not_responding, component, strange},
            Completed{CommandId{"c"}, CompletedStatus::error, std::make_shared<Results const>(results()), strange, false},
            Completed{CommandId{"c"}, CompletedStatus::ok, std::make_shared<Results const>(), {}, true},
            ComponentChanged{component, ComponentStatus::warning, results()},
            ComponentChanged{component, ComponentStatus::busy, {}},
            Switched{component, "robot1.navigation", strange, strange},
            Lost{12},
            ProfileChanged{}};
}

TEST(NotificationDocument, OfEachKindIsValid) {
    std::string all = notifications_begin();
    std::uint64_t sequence = 0;
    for (auto const& each : notifications()) {
        auto const text = std::string{notification_head(each)} + std::to_string(++sequence) + notification_tail(each);
        EXPECT_EQ(problem("notification", text), "") << text;
        EXPECT_EQ(Document::parse(schemas(), "notification", text).root().attribute("sequence"), std::to_string(sequence));
        all += text;
    }
    EXPECT_EQ(problem("notifications", all + notifications_end()), "");
    EXPECT_EQ(problem("notifications", notifications_begin() + notifications_end()), "");
}

TEST(NotificationDocument, HasItsSequenceBetweenHeadAndTail) {
    Notification const lost{Lost{3}};
    EXPECT_EQ(notification_head(lost), R"(<lost sequence=")");
    EXPECT_EQ(notification_tail(lost), R"(" xmlns="urn:x-rois:psm:xml:message:1" count="3"/>)");
    auto const event = notification_tail(notifications()[0]);
    EXPECT_THAT(event, HasSubstr("<expire>2026-11-20T12:00:00.123Z</expire>"));
    EXPECT_THAT(event, Not(HasSubstr("sequence")));
    EXPECT_THAT(event, Not(HasSubstr("<results")));
}

TEST(StopStateDocument, IsValidAndReadBack) {
    AnswerReader reader;
    for (auto const& state : {StopState{true, {}}, StopState{false, {}}, StopState{true, {"navigation", "robot2.move"}},
                              StopState{true, {"<&>\"' \xC3\xA4"}}}) {
        auto const text = encode(state);
        EXPECT_EQ(problem("stop_state", text), "") << text;
        auto const again = reader.read_stop_state(text);
        ASSERT_TRUE(again) << text;
        EXPECT_EQ(again->stopped, state.stopped) << text;
        EXPECT_EQ(again->not_halted, state.not_halted) << text;
    }
    EXPECT_EQ(
        encode(StopState{true, {"navigation"}}),
        R"(<stop_state xmlns="urn:x-rois:psm:xml:message:1"><stopped>true</stopped><not_halted>navigation</not_halted></stop_state>)");
}

TEST(EnginesDocument, IsValidAndReadBack) {
    EngineState const hall{.name = "hall",
                           .is = EngineState::Is::present,
                           .link = "ws://127.0.0.1:8081",
                           .round_trip = std::chrono::microseconds{410},
                           .components = 15,
                           .losses = 2,
                           .last_error = ""};
    EngineState const lamps{.name = "lamps",
                            .is = EngineState::Is::given_up,
                            .link = "joins as lamps",
                            .round_trip = {},
                            .components = 1,
                            .losses = 0,
                            .last_error = "<&>\"'"};
    for (auto const& engines : {std::vector<EngineState>{}, {hall}, {hall, lamps}}) {
        auto const text = encode(engines);
        EXPECT_EQ(problem("engines", text), "") << text;
        auto const again = AnswerReader{}.read_engines(text);
        ASSERT_TRUE(again) << text;
        EXPECT_EQ(encode(*again), text);
    }
    EXPECT_FALSE(AnswerReader{}.read_engines(document("engines", "<engine name=\"a\" state=\"asleep\"/>")));
    EXPECT_FALSE(AnswerReader{}.read_engines(encode(StopState{true, {}})));
}

TEST(StopStateDocument, IsNotReadFromOtherDocuments) {
    AnswerReader reader;
    for (auto const& other :
         {std::string{}, std::string{"stopped\n"}, std::string{"<stop_state><stopped>true</stopped></stop_state>"},
          document("stop_state"), document("stop_state", "<not_halted>navigation</not_halted>"),
          document("notifications", "<stopped>true</stopped>"), encode(Fault{})})
        EXPECT_FALSE(reader.read_stop_state(other)) << other;
    EXPECT_FALSE(reader.read(encode(StopState{true, {}})));
}

TEST(ProfileDocument, IsValidAndHasAnXmlDeclaration) {
    for (auto const& text :
         {encode(engine_profile(), "engine.main"), encode(component_profile(), "profile.a:b"), encode(ComponentProfile{}, "")}) {
        EXPECT_THAT(text, testing::StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"));
        EXPECT_EQ(problem("profile", text), "") << text;
    }
}

TEST(EngineProfile, MayHaveNeitherComponentsNorSubEngines) {
    auto profile = engine_profile();
    profile.components.clear();
    profile.sub_profiles.clear();
    EXPECT_EQ(problem("profile", encode(profile, "engine.main")), "");
}

TEST(ProfileDocument, OfAComponentRoundTrips) {
    auto const written = encode(component_profile(), "profile.a");
    auto const again = read_component_profile(schemas(), "profile", written);
    EXPECT_EQ(encode(again, "profile.a"), written);
    EXPECT_EQ(again.object.identifier, "urn:x-rois:def:component:OMG::Navigation");
    EXPECT_EQ(again.object.code_space, "urn:ietf:rfc:2141");
    EXPECT_EQ(again.object.name, "Navigation");
    EXPECT_EQ(again.object.description, "goes");
    EXPECT_THAT(again.sub_components, testing::ElementsAre("urn:sub"));
    ASSERT_EQ(again.messages.size(), 3u);
    EXPECT_EQ(again.messages[0].timeout, std::chrono::milliseconds{500});
    EXPECT_EQ(again.messages[0].arguments.size(), 2u);
    EXPECT_EQ(again.messages[0].results.size(), 1u);
    EXPECT_EQ(again.messages[1].kind, MessageKind::query);
    EXPECT_EQ(again.messages[2].kind, MessageKind::event);
    ASSERT_EQ(again.parameters.size(), 1u);
    EXPECT_EQ(again.parameters[0].default_value, "5");
    EXPECT_EQ(again.parameters[0].description, "a \"number\"");
    EXPECT_EQ(again.parameters[0].data_type_ref.code, "int");
}

}  // namespace
}  // namespace rois::xml
