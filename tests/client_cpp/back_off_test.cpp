// The pauses between attempts to connect, and the reports of failed attempts.
#include "client_cpp/rig.hpp"
#include "client_cpp/scripted_gateway.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

// --- Links of one session, with a scripted gateway ---

class TheBackOff : public testing::Test {
protected:
    ~TheBackOff() override { gateway.cut(); }

    static Settings with_pauses(std::string url, std::chrono::milliseconds first, std::chrono::milliseconds longest) {
        Settings settings;
        settings.url = std::move(url);
        settings.first_pause = first;
        settings.longest_pause = longest;
        return settings;
    }
    void connect() {
        gateway.accept();
        gateway.receive("connect");
        gateway.answer("<session>one</session>");
    }
    void resume() {
        gateway.accept();
        gateway.receive("resume");
        gateway.answer();
    }

    ScriptedGateway gateway;
};

// The pauses are an hour long, so the test ends only if each link follows without a pause.
TEST_F(TheBackOff, IsResetByANotification) {
    History history;
    Client client{with_pauses(gateway.url(), 1h, 1h), history.observers()};
    connect();
    for (int sequence = 1; sequence <= 50; ++sequence) {
        resume();
        gateway.event(sequence, "s-1");
    }
    history.await_notifications(50);
}

// If the pauses grew, the last one would last at least half a minute.
TEST_F(TheBackOff, IsResetByAResumedSession) {
    Client client{with_pauses(gateway.url(), 1ms, 1h)};
    connect();
    for (int link = 0; link < 16; ++link) resume();
    gateway.accept();
    EXPECT_EQ(client.session().text, "one");
}

TEST_F(TheBackOff, GrowsWhileNoLinkResumesTheSession) {
    std::promise<std::vector<FailedAttempt>> reported;
    std::vector<FailedAttempt> attempts;
    Observers observers;
    observers.attempt_failed = [&](FailedAttempt const& attempt) {
        attempts.push_back(attempt);
        if (attempts.size() == 6) reported.set_value(attempts);
    };
    Client client{with_pauses(gateway.url(), 8ms, 50ms), observers};
    connect();
    for (int link = 0; link < 7; ++link) {
        gateway.accept();
        gateway.receive("resume");
    }
    auto const all = reported.get_future().get();
    std::vector<std::chrono::milliseconds> const longest{8ms, 16ms, 32ms, 50ms, 50ms, 50ms};
    for (std::size_t i = 0; i < longest.size(); ++i) {
        EXPECT_EQ(all[i].count, i + 1);
        EXPECT_LE(all[i].retry_in, longest[i]);
        EXPECT_GE(all[i].retry_in, longest[i] / 2);
    }
}

// --- Against the real gateway ---

class TheFlakyLink : public BothWays {};
ROIS_BOTH_WAYS(TheFlakyLink);

// Another session makes the robot report 25 targets ten times a second, so this session receives only events. The pauses are the
// defaults, and a session keeps 1,024 notifications.
TEST_P(TheFlakyLink, LosesNothingAt250EventsPerSecondWhenItBreaksEvery100Kilobytes) {
    constexpr int rounds = 120;
    constexpr int each = 25;
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "100"}};
    Proxy proxy{gateway.port()};
    Settings usual;
    usual.url = proxy.url();
    usual.way = GetParam();
    History history;
    Blocking listener{usual, history.observers()};
    auto reached = listener.events<ReachedTarget>();
    Blocking driver{quick(gateway.url())};
    auto const navigation = driver.bind<Navigation>("navigation");
    proxy.cut_every(100'000);
    auto next = std::chrono::steady_clock::now();
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::string> const targets(each, "4000, 5000");
        EXPECT_EQ(driver(navigation.start(ParameterList{positions("target_position", targets, {})})), CompletedStatus::ok);
        next += 100ms;
        std::this_thread::sleep_until(next);
    }
    history.await_notifications(rounds * each);
    EXPECT_THAT(history.gaps(), testing::IsEmpty());
    auto const received = history.notifications();
    ASSERT_THAT(received, SizeIs(rounds * each));
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i].first, i + 1);
    EXPECT_GT(proxy.cuts(), 10U);
}

class ARefusedConnection : public BothWays {};
ROIS_BOTH_WAYS(ARefusedConnection);

TEST_P(ARefusedConnection, IsReportedAtOnceWhileTheClientRetries) {
    Proxy proxy{shared_gateway().port()};
    proxy.refuse(true);
    auto patient = settings(proxy.url());
    patient.connect_deadline = 1h;
    std::promise<FailedAttempt> reported;
    History history;
    auto observers = history.observers();
    observers.attempt_failed = [&](FailedAttempt const& attempt) {
        if (attempt.count == 1) reported.set_value(attempt);
    };
    Blocking robot{patient, observers};
    auto const first = reported.get_future().get();
    EXPECT_THAT(first.reason, HasSubstr("reset"));
    EXPECT_GT(first.retry_in, 0ms);
    EXPECT_EQ(robot.client().state(), State::connecting);
    proxy.refuse(false);
    robot.open();
    EXPECT_THAT(history.states(), testing::ElementsAre("connecting", "open"));
}

}  // namespace
}  // namespace rois::test
