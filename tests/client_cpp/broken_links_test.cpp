// Links that break: the session is resumed, no command runs twice, and missed notifications are reported.
#include <algorithm>
#include <cstdlib>

#include "client_cpp/rig.hpp"
#include "kit/http_client.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class TheLink : public BothWays {
protected:
    // A gateway that ends lost sessions at once.
    static GatewayProcess forgetful() {
        return GatewayProcess{{"--listen", "127.0.0.1:0", "--session-timeout", "0.5", "--resume-window", "0"}};
    }
};
ROIS_BOTH_WAYS(TheLink);

// Expects each sequence number once, without gaps except reported ones.
void expect_all_once(History const& history) {
    std::uint64_t last = 0;
    for (auto const& [sequence, notification] : history.notifications()) {
        auto const* const lost = std::get_if<Lost>(&notification);
        EXPECT_EQ(sequence, last + (lost != nullptr ? lost->count : 1));
        last = sequence;
    }
}

TEST_P(TheLink, ResumesItsSession) {
    Proxy proxy{shared_gateway().port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const detection = robot.bind<PersonDetection>("person_detection");
    auto const session = robot.client().session();
    proxy.cut();
    history.await_states({"connecting", "open", "lost", "resumed"});
    EXPECT_EQ(robot.client().session(), session);
    EXPECT_EQ(robot(detection.start()), CompletedStatus::ok) << "it is still bound";
    EXPECT_THAT(history.gaps(), IsEmpty());
    robot(detection.release());
}

TEST_P(TheLink, NoticesASilentGateway) {
    Proxy proxy{shared_gateway().port()};
    auto impatient = settings(proxy.url());
    impatient.ping_interval = 50ms;
    impatient.stream_silence = 100ms;
    History history;
    Blocking robot{impatient, history.observers()};
    robot.open();
    proxy.half_open();
    EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok) << "on the next link";
    EXPECT_THAT(history.states(), Contains("lost"));
    EXPECT_THAT(history.states(), Contains("resumed"));
}

TEST_P(TheLink, TakesDocumentsAsLongAsTheSettingAllows) {
    auto const why_not = [&](std::size_t longest) {
        auto bounded = settings(shared_gateway().url());
        bounded.longest_document = longest;
        bounded.attempts = 1;
        Blocking robot{bounded};
        try {
            return std::string{robot.call(GetProfile{}).return_code == ReturnCode::ok ? "" : "it was refused"};
        } catch (Error const& error) {
            return std::string{error.what()};
        }
    };
    EXPECT_EQ(why_not(200'000), "");
    EXPECT_NE(why_not(5'000), "") << "the profile is longer";
}

TEST_P(TheLink, AcceptsDelayedAndSplitBytes) {
    Proxy proxy{shared_gateway().port()};
    proxy.drip(7, 0ms);
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    for (int i = 0; i < 3; ++i) EXPECT_EQ(robot.call(Search{type == "Navigation"}).component_ref_list.size(), 1U);
    proxy.delay(30ms);
    auto const begun = std::chrono::steady_clock::now();
    EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok);
    EXPECT_GE(std::chrono::steady_clock::now() - begun, 60ms) << "delayed both ways";
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open"));
}

TEST_P(TheLink, RunsNoSequenceTwice) {
    Proxy proxy{shared_gateway().port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
    auto const setting = [&] { return robot(synthesis.set(Speech().with_speech_text("Hello."))); };
    for (int i = 0; i < 3; ++i) {
        proxy.cut_before("<execute_response");
        EXPECT_EQ(setting(), CompletedStatus::ok);
    }
    EXPECT_EQ(proxy.cuts(), 3U);
    EXPECT_EQ(setting(), CompletedStatus::ok);
    auto const completions = history.completions();
    EXPECT_THAT(completions, SizeIs(4));
    for (auto const& [id, count] : completions) EXPECT_EQ(count, 1) << id;
    expect_all_once(history);
    robot(synthesis.release());
}

// The bytes of both directions, of a command and its answer. ROIS_EVERY_BYTE=1: each of them, which takes a minute.
TEST_P(TheLink, RunsNoCommandTwiceWhereverItIsCut) {
    Proxy proxy{shared_gateway().port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
    std::size_t const step = std::getenv("ROIS_EVERY_BYTE") != nullptr ? 1 : 17;
    std::size_t commands = 0;
    for (std::size_t bytes = 1; bytes < 2'000; bytes += step) {
        proxy.cut_every(bytes, 1);
        EXPECT_EQ(robot(synthesis.set(Speech().with_speech_text("Hello."))), CompletedStatus::ok) << bytes;
        ++commands;
    }
    EXPECT_GT(proxy.cuts(), commands / 2);
    auto const completions = history.completions();
    EXPECT_EQ(completions.size(), commands);
    for (auto const& [id, count] : completions) EXPECT_EQ(count, 1) << id;
    expect_all_once(history);
    robot(synthesis.release());
}

TEST_P(TheLink, IsReplacedAfterAnAnswerToAnotherRequest) {
    Proxy proxy{shared_gateway().port()};
    History history;
    auto const misquote = [&] { proxy.misquote("request_id=\"rois-cpp-", "request_id=\"somebody-"); };
    Blocking robot{settings(proxy.url()), history.observers()};
    auto& client = robot.client();
    auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
    misquote();
    auto first = begun(client, client.call(Search{type == "Navigation"}));
    auto second = begun(client, client.call(Search{type == "Move"}));
    EXPECT_EQ(first.get().component_ref_list.size(), 1U);
    EXPECT_EQ(second.get().component_ref_list.size(), 1U);
    misquote();
    EXPECT_EQ(robot(synthesis.set(Speech().with_speech_text("Hello."))), CompletedStatus::ok);
    EXPECT_THAT(history.completions(), ElementsAre(testing::Pair(testing::_, 1)));
    misquote();
    auto const moving = robot.bind_any(type == "Move");
    EXPECT_EQ(robot(moving.component_status()), ComponentStatus::ready) << "bound once, by this session";
    EXPECT_EQ(proxy.connections(), GetParam() == Way::http ? 8U : 4U);
    EXPECT_EQ(history.states().back(), "resumed");
    robot(moving.release());
    robot(synthesis.release());
}

// A gateway accepts at most 1 MiB. It closes a WebSocket for a longer document; the other calls are repeated on the next link.
TEST_P(TheLink, BreaksOnlyOnceForADocumentThatIsTooLarge) {
    History history;
    Blocking robot{settings(), history.observers()};
    auto& client = robot.client();
    std::string const too_long(2'000'000, 'x');
    auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
    auto before = begun(client, client.call(Search{type == "Navigation"}));
    auto saying = begun(client, synthesis.say(too_long));
    auto after = begun(client, client.call(Search{type == "Move"}));
    try {
        saying.get();
        ADD_FAILURE() << "it was accepted";
    } catch (Error const& refused) {
        EXPECT_EQ(refused.code(), ReturnCode::error);
        EXPECT_THAT(refused.what(), HasSubstr("too_large: "));
    }
    EXPECT_EQ(before.get().component_ref_list.size(), 1U);
    EXPECT_EQ(after.get().component_ref_list.size(), 1U);
    EXPECT_THAT(robot.call(BindAny{type == too_long}).reason, HasSubstr("too_large: "));
    EXPECT_THAT(robot.call(Query{too_long, {}}).reason, HasSubstr("too_large: "));
    if (GetParam() == Way::websocket) {
        EXPECT_THAT(std::get<NoAnswer>(robot(client.send(too_long))).reason, HasSubstr("2000000 bytes: "));
        EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok);
        auto const states = history.states();
        EXPECT_EQ(std::ranges::count(states, "lost"), 4) << "once for each";
    }
    robot(synthesis.release());
}

// The first attempt follows at once. The next ones follow after a pause, since no link delivers an answer.
TEST_P(TheLink, DoesNotResetThePauseBeforeItHasAnswered) {
    Proxy proxy{shared_gateway().port()};
    auto slow = settings(proxy.url());
    slow.first_pause = slow.longest_pause = 1h;
    History history;
    auto observers = history.observers();
    observers.state = [&, record = observers.state](StateChange const& change) {
        if (change.state == State::lost) proxy.cut_before("<search_response");
        record(change);
    };
    Blocking robot{slow, observers};
    robot.open();
    proxy.cut_before("<search_response");
    auto const unanswered = begun(robot.client(), robot.client().call(Search{}, 1h));
    std::vector<std::string> const states{"connecting", "open", "lost", "resumed", "lost"};
    history.await_states(states);
    EXPECT_EQ(robot(robot.client().call(Search{}, 100ms)).return_code, ReturnCode::timeout);
    EXPECT_EQ(history.states(), states);
}

TEST_P(TheLink, ReportsARefusalWhoseFirstAnswerWasLost) {
    Proxy proxy{shared_gateway().port()};
    Blocking robot{settings(proxy.url())};
    auto const synthesis = robot.client().component("speech_synthesis");  // not bound
    robot.open();
    proxy.cut_before("<execute_response");
    try {
        robot(synthesis.start());
        ADD_FAILURE() << "it was accepted";
    } catch (Error const& refused) {
        EXPECT_EQ(refused.code(), ReturnCode::error);
        EXPECT_THAT(refused.what(), HasSubstr("speech_synthesis"));
    }
}

TEST_P(TheLink, BindsOnlyOneComponentWhenTheAnswerWasLost) {
    Proxy proxy{shared_gateway().port()};
    Blocking robot{settings(proxy.url())};
    robot.open();
    auto const detection = conditions::component_ref.like("*_detection");
    auto const first = robot.bind_any(detection);
    proxy.cut_before("<bind_any_response");
    auto const second = robot.bind_any(detection);
    EXPECT_NE(first.ref().code, second.ref().code);
    Blocking other{settings()};
    auto const third = other.bind_any(detection);
    EXPECT_THAT(third.ref().code, testing::AllOf(testing::Ne(first.ref().code), testing::Ne(second.ref().code)));
    robot(first.release());
    robot(second.release());
    other(third.release());
}

TEST_P(TheLink, SendsARawDocumentOnlyOnce) {
    Proxy proxy{shared_gateway().port()};
    Blocking robot{settings(proxy.url())};
    robot.open();
    proxy.cut_before("<search_response");
    auto const answer = robot(robot.client().send("<search xmlns='urn:x-rois:psm:xml:message:1'/>"));
    ASSERT_TRUE(std::holds_alternative<NoAnswer>(answer));
    EXPECT_EQ(std::get<NoAnswer>(answer).why, NoAnswer::Why::link_lost);
}

TEST_P(TheLink, RestoresBindingsAndSubscriptionsInANewSession) {
    auto const gateway = forgetful();
    Proxy proxy{gateway.port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const detection = robot.bind<PersonDetection>("person_detection");
    auto const follow = robot.bind<Follow>("follow");
    auto detected = robot(detection.person_detected(result("number") >= 0));
    auto again = robot(detection.person_detected(result("number") >= 0));  // the same subscription
    auto const following =
        robot(follow.begin_following(FollowParameters().with_target_object_ref("nobody").with_distance(500_mm)));
    auto const session = robot.client().session();

    proxy.refuse(true);
    proxy.cut();
    Blocking other{settings(gateway.url())};  // can bind the component when the session has ended
    Component const its_detection = other.client().component("person_detection");
    while (other.call(Bind{its_detection.ref()}).return_code != ReturnCode::ok) other(other.client().sleep(10ms));
    other(its_detection.release());
    proxy.refuse(false);
    history.await_states({"connecting", "open", "lost", "open"});
    EXPECT_NE(robot.client().session(), session);
    EXPECT_EQ(robot(following.completed()), CompletedStatus::abort);
    history.await_gap();
    ASSERT_THAT(history.gaps(), SizeIs(1));
    EXPECT_EQ(history.gaps().front().why, Gap::Why::new_session);
    EXPECT_THAT(history.gaps().front().not_restored, IsEmpty());

    EXPECT_EQ(robot(detection.start()), CompletedStatus::ok) << "bound again";
    EXPECT_TRUE(robot(detected.next(5s)));
    EXPECT_TRUE(robot(again.next(5s)));
    EXPECT_EQ(detected.gaps(), 1U);
    auto events = 0;
    for (auto const& [sequence, notification] : history.notifications())
        events += std::holds_alternative<ReceiveEvent>(notification) ? 1 : 0;
    EXPECT_EQ(events, 1) << "subscribed once";
    EXPECT_FALSE(history.completions().contains(following.id().text)) << "only the gap is reported of the session that has ended";
}

TEST_P(TheLink, ReportsABindingThatItCannotRestore) {
    auto const gateway = forgetful();
    Proxy proxy{gateway.port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const reaction = robot.bind<Reaction>("reaction");
    proxy.refuse(true);
    proxy.cut();
    Blocking other{settings(gateway.url())};
    while (other.call(Bind{reaction.ref()}).return_code != ReturnCode::ok) other(other.client().sleep(10ms));
    proxy.refuse(false);
    history.await_gap();
    EXPECT_THAT(history.gaps().front().not_restored, ElementsAre(HasSubstr("bind reaction: ")));
}

TEST_P(TheLink, ReportsNotificationsThatTheEngineDropped) {
    GatewayProcess const gateway{{"--listen", "127.0.0.1:0", "--max-waiting-notifications", "16"}};
    Proxy proxy{gateway.port()};
    History history;
    Blocking robot{settings(proxy.url()), history.observers()};
    auto const detection = robot.bind<PersonDetection>("person_detection");
    std::vector<Events<PersonDetected>> many;
    for (int i = 0; i < 40; ++i) many.push_back(robot(detection.person_detected(result("number") >= -i)));
    proxy.refuse(true);
    proxy.cut();
    // Starts the detection over HTTP in the same session, while the session has no link for notifications.
    history.await_states({"connecting", "open", "lost"});
    Blocking witness{quick(gateway.url())};
    auto witnessed = witness.events<PersonDetected>();
    auto const detect = R"(<execute xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801"
        xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><rois:CommandUnitSequence><rois:command_unit_list
        xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="aside"><rois:component_ref
        rois:code="person_detection"/></rois:command_unit_list></rois:CommandUnitSequence></execute>)";
    kit::HttpClient http{gateway.address()};
    http.session = robot.client().session().text;
    ASSERT_EQ(http.post(detect).return_code(), "OK");
    ASSERT_TRUE(witness(witnessed.next(5s)));
    http.session.clear();
    proxy.refuse(false);
    history.await_gap();
    EXPECT_EQ(history.gaps().front().why, Gap::Why::dropped);
    EXPECT_GT(history.gaps().front().count.value_or(0), 0U);
    expect_all_once(history);
    EXPECT_TRUE(robot(many.back().next(5s)));
    EXPECT_EQ(many.back().gaps(), 1U);
}

}  // namespace
}  // namespace rois::test
