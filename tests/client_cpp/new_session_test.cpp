// The new session after one that has ended: what the connection restores, and what it must not. The sessions end with their
// gateway; the next gateway uses the same ids again, for other objects.
#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Ne;
using testing::StartsWith;

class TheNewSession : public BothWays {
protected:
    // Ends the gateway, calls `meanwhile`, and starts another gateway.
    void lose_session(std::function<void()> const& meanwhile = [] {}) {
        proxy.refuse(true);
        proxy.cut();
        history.await_once("lost");
        meanwhile();
        gateway.emplace();
        proxy.lead_to(gateway->port());
        proxy.refuse(false);
    }

    // Expects one event of one detection, for this stream only.
    void expect_only_receiver(Blocking& robot, Events<PersonDetected>& kept) {
        auto const detection = PersonDetection{robot.client().component("person_detection")};
        EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok) << "after all earlier requests";
        EXPECT_EQ(robot(detection.start()), CompletedStatus::ok);
        EXPECT_TRUE(robot(kept.next(5s)));
        EXPECT_EQ(robot(detection.stop()), CompletedStatus::ok) << "completes after the event";
        auto events = 0;
        for (auto const& [sequence, notification] : history.notifications())
            events += std::holds_alternative<ReceiveEvent>(notification) ? 1 : 0;
        EXPECT_EQ(events, 1);
    }

    std::optional<GatewayProcess> gateway{std::in_place};
    Proxy proxy{gateway->port()};
    History history;
};
ROIS_BOTH_WAYS(TheNewSession);

// --- Subscriptions that end around the lost session: the new session gives their id to the subscription that is kept ---

// When the first subscription ends. At the end, only the second one must exist.
enum class Moment : std::uint8_t { unanswered, lost, restored };

class ANewSessionDoesNotRestore : public TheNewSession {
protected:
    void play(Moment moment, bool by_request) {
        std::atomic<Client*> leaves = nullptr;
        std::optional<Events<PersonDetected>> left;
        SubscribeId id;
        std::promise<Unsubscribe::Reply> unsubscribed;
        auto const leave = [&](Client& client) {
            left.reset();
            if (by_request) client.spawn(detail::deliver(client.call(Unsubscribe{id}), unsubscribed));
        };
        auto observers = history.observers();
        observers.tap = [&](Direction direction, std::string_view document) {
            bool const restores = direction == Direction::out && document.find("\"restore-") != document.npos;
            if (!restores || !document.starts_with("<subscribe ")) return;
            if (auto* const client = leaves.exchange(nullptr)) leave(*client);
        };

        Blocking robot{settings(proxy.url()), observers};
        auto const detection = robot.bind<PersonDetection>("person_detection");
        auto condition = result("number") > -1;
        if (by_request) {
            id = robot.call(Subscribe{"person_detected", condition, true}).subscribe_id;
        } else {
            left = robot(detection.person_detected(condition));
        }
        auto kept = robot(detection.person_detected(result("number") > -2));
        if (moment == Moment::unanswered) {
            proxy.refuse(true);
            proxy.cut_before("<unsubscribe_response");
            leave(robot.client());
            history.await_once("lost");
        }
        if (moment == Moment::restored) leaves = &robot.client();
        lose_session([&] {
            if (moment == Moment::lost) leave(robot.client());
            robot(robot.client().sleep(0ms));  // waits until the client's thread has done that
        });
        history.await_states({"connecting", "open", "lost", "open"});
        expect_only_receiver(robot, kept);
        if (by_request) {
            EXPECT_EQ(unsubscribed.get_future().get().return_code, ReturnCode::ok);
        }
    }
};
ROIS_BOTH_WAYS(ANewSessionDoesNotRestore);

TEST_P(ANewSessionDoesNotRestore, AStreamDroppedBeforeTheBreak) { play(Moment::unanswered, false); }
TEST_P(ANewSessionDoesNotRestore, AStreamDroppedWhileTheLinkIsLost) { play(Moment::lost, false); }
TEST_P(ANewSessionDoesNotRestore, AStreamDroppedDuringTheRestore) { play(Moment::restored, false); }
TEST_P(ANewSessionDoesNotRestore, ASubscriptionEndedBeforeTheBreak) { play(Moment::unanswered, true); }
TEST_P(ANewSessionDoesNotRestore, ASubscriptionEndedWhileTheLinkIsLost) { play(Moment::lost, true); }
TEST_P(ANewSessionDoesNotRestore, ASubscriptionEndedDuringTheRestore) { play(Moment::restored, true); }

// --- Ids ---

TEST_P(TheNewSession, ReceivesNoIdsOfTheOldSession) {
    Blocking robot{settings(proxy.url()), history.observers()};
    auto& client = robot.client();
    robot.open();
    std::vector<std::future<Answer>> asked;
    lose_session([&] {
        asked.push_back(begun(client, client.request({GetEventDetail{{"e-1"}, {}}, {}})));
        asked.push_back(begun(client, client.request({GetErrorDetail{{"error-1"}, {}}, {}})));
        asked.push_back(begun(client, client.request({GetCommandResult{{"c-1"}, {}}, {}})));
        asked.push_back(begun(client, client.request({Unsubscribe{{"s-1"}}, {}})));
        robot(client.sleep(0ms));
    });
    for (auto& each : asked) {
        auto const answer = each.get();
        ASSERT_TRUE(std::holds_alternative<NoAnswer>(answer));
        EXPECT_EQ(std::get<NoAnswer>(answer).why, NoAnswer::Why::session_lost);
    }
    EXPECT_EQ(robot.call(GetEventDetail{{"e-1"}, {}}).return_code, ReturnCode::bad_parameter)
        << "later requests reach the engine";
}

TEST_P(TheNewSession, GivesEachSubscriptionAUniqueId) {
    Blocking robot{settings(proxy.url()), history.observers()};
    robot.open();
    auto const subscribed = [&](std::string type) { return robot.call(Subscribe{std::move(type), {}, true}).subscribe_id; };
    std::vector const before{subscribed("reached_target"), subscribed("person_identified"), subscribed("person_detected")};
    for (auto const index : {0U, 1U}) EXPECT_EQ(robot.call(Unsubscribe{before[index]}).return_code, ReturnCode::ok);
    lose_session();
    history.await_states({"connecting", "open", "lost", "open"});
    std::vector const after{subscribed("reached_target"), subscribed("person_identified")};  // 2 and 3 at the engine
    EXPECT_THAT(after, testing::Each(Ne(before[2])));
    EXPECT_EQ(robot.call(Unsubscribe{after[1]}).return_code, ReturnCode::ok);
    EXPECT_EQ(subscribed("person_detected"), before[2]) << "the subscription that was kept";
}

// --- Observers that close ---

class TheNewSessionWhenAnObserverCloses : public TheNewSession {
protected:
    // Closes the connection when `when` is observed. Returns the last document that was sent.
    std::string close_at(std::string_view when) {
        std::atomic<Client*> closes = nullptr;
        std::string last;
        auto const note = [&](std::string_view now) {
            auto* const client = closes.load();
            if (client != nullptr && now == when) client->close();
        };
        auto observers = history.observers();
        observers.state = [&, remember = observers.state](StateChange const& change) {
            remember(change);
            note(to_text(change.state));
        };
        observers.gap = [&](Gap const&) { note("gap"); };
        observers.tap = [&](Direction direction, std::string_view document) {
            if (direction == Direction::in) return;
            last = document;
            if (document.starts_with("<connect ")) note("connect");
        };
        {
            Blocking robot{settings(proxy.url()), observers};
            robot.open();
            closes = &robot.client();
            lose_session();
            history.await_state("closed");
            EXPECT_EQ(robot.client().state(), State::closed);
            EXPECT_THAT(robot.call(Search{}).reason, HasSubstr("closed"));
        }
        return last;
    }
};
ROIS_BOTH_WAYS(TheNewSessionWhenAnObserverCloses);

TEST_P(TheNewSessionWhenAnObserverCloses, AtTheLostLinkDoesNotBegin) {
    close_at("lost");
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open", "lost", "closed"));
}

TEST_P(TheNewSessionWhenAnObserverCloses, AtTheConnectDoesNotBegin) {
    EXPECT_THAT(close_at("connect"), StartsWith("<connect "));
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open", "lost", "closed"));
}

TEST_P(TheNewSessionWhenAnObserverCloses, AtTheGapEnds) {
    EXPECT_THAT(close_at("gap"), StartsWith("<disconnect "));
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open", "lost", "open", "closed"));
}

// --- Unexpected answers ---

// An unexpected document must not count as the answer to a document that was sent on an earlier link.
TEST_P(TheNewSession, IsRetriedAfterAnUnexpectedAnswer) {
    for (auto const& [sent, replaced] : {std::pair{"<bind_response", "(bind_response"}, {"\"restore-", "\"nothing-"}}) {
        Blocking robot{settings(proxy.url()), history.observers()};
        auto& client = robot.client();
        auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
        proxy.refuse(true);
        proxy.cut_before("<search_response");
        auto raw = begun(client, client.send("<search xmlns='urn:x-rois:psm:xml:message:1'/>"));
        history.await_state("lost");
        proxy.misquote(sent, replaced);
        lose_session();
        history.await_state("open");
        auto const answer = raw.get();
        ASSERT_TRUE(std::holds_alternative<NoAnswer>(answer)) << std::get<std::string>(answer);
        EXPECT_EQ(std::get<NoAnswer>(answer).why, NoAnswer::Why::link_lost);
        EXPECT_EQ(robot(synthesis.set(Speech().with_speech_text("Hello."))), CompletedStatus::ok);
        robot(synthesis.release());
    }
}

}  // namespace
}  // namespace rois::test
