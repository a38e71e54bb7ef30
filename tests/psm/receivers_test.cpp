// Notifications of the C++ PSM, while links break and receivers are added and removed.
#include <csignal>

#include "psm/rig.hpp"

namespace {

using namespace rois::test::psm;
using rois::kit::GatewayProcess;
using rois::kit::shared_gateway;

// Remembers where people are.
class People : public Person_Localization::Event {
public:
    ~People() override { end_notifications(); }
    void person_localized(std::string timestamp, RoIS_HRI::RoIS_IdentifierList people, std::vector<std::string> where) override {
        bell.ring([&] { last = {timestamp, people, where}; });
    }
    struct Localized {
        std::string timestamp;
        RoIS_HRI::RoIS_IdentifierList people;
        std::vector<std::string> where;
    };
    Bell bell;
    Localized last;
};

TEST_F(CppPsm, EventsArriveWithTheirResultsByDerivation) {
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml", "--sim-speed", "10"}};
    use(gateway.url());
    People before;
    ASSERT_EQ(system.connect(), ok);
    People after;
    Person_Localization::Command localization;
    EXPECT_EQ(localization.start(), ok) << reason();
    for (auto* const people : {&before, &after}) {
        ASSERT_TRUE(people->bell.await([&] { return !people->last.people.empty(); }));
        EXPECT_EQ(people->last.people.size(), people->last.where.size());
        EXPECT_THAT(people->last.where.front(), HasSubstr(", "));
        EXPECT_THAT(people->last.timestamp, testing::EndsWith("Z"));
    }
    EXPECT_THAT(application.events, IsEmpty()) << "the application itself has not subscribed";
    EXPECT_EQ(system.disconnect(), ok);
}

TEST_F(CppPsm, WithTwoRobotsOnlyTheBoundComponentSendsEvents) {
    GatewayProcess const gateway{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml", "--scenario",
                                  ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml", "--sim-speed", "10"}};
    use(gateway.url());
    People people;
    ASSERT_EQ(system.connect(), ok);
    EXPECT_EQ(event.subscribe("person_localized", "", id), ok) << reason();
    ASSERT_EQ(command.bind("robot2.person_localization"), ok) << reason();
    Blocking other{rois::Settings{}};
    other(other.bind<rois::PersonLocalization>("person_localization").start());
    ASSERT_TRUE(application.bell.await([&] { return application.events.size() > 1; }))
        << "a subscription receives events of both robots";
    people.bell.ring([&] { EXPECT_THAT(people.last.people, IsEmpty()) << "of the robot that is not bound"; });
    EXPECT_EQ(Person_Localization::Command{}.start(), ok) << reason();
    EXPECT_TRUE(people.bell.await([&] { return !people.last.people.empty(); }));
    EXPECT_EQ(system.disconnect(), ok);
}

// --- Broken links ---

TEST_F(CppPsm, CommandsOfALostSessionCompleteWithAbort) {
    GatewayProcess gateway{{"--sim-speed", "0"}};  // the robot never arrives
    use(gateway.url());
    ASSERT_EQ(system.connect(), ok);
    Navigation::Command navigation;
    EXPECT_EQ(navigation.set_parameter({"desk"}, 0, ""), ok) << reason();
    EXPECT_EQ(application.status_of("navigation.set_parameter.1"), RoIS_Service::OK);
    EXPECT_EQ(navigation.start(), ok) << reason();
    auto const listen = "127.0.0.1:" + std::to_string(gateway.port());
    gateway.signal(SIGKILL);
    gateway.wait();
    EXPECT_THAT(application.text_of_an_error(), StartsWith("the link is lost: "));
    EXPECT_FALSE(application.ended.contains("navigation.start.2")) << "the session may still be there";
    GatewayProcess const next{{"--listen", listen}};
    EXPECT_EQ(application.status_of("navigation.start.2"), RoIS_Service::ABORT);
    ASSERT_TRUE(application.bell.await([&] { return application.errors.size() == 2; }));
    EXPECT_EQ(system.get_error_detail(application.errors.rbegin()->first, "", results), ok);
    EXPECT_THAT(results.front().value, StartsWith("the engine's session ended with the link"));
    EXPECT_EQ(system.disconnect(), ok);
    EXPECT_EQ(application.ended.size(), 2) << "each completes once";
}

TEST_F(CppPsm, ALostSessionIsReportedAndReplaced) {
    auto gateway = std::make_unique<GatewayProcess>();
    auto const listen = "127.0.0.1:" + std::to_string(gateway->port());
    use(gateway->url());
    ASSERT_EQ(system.connect(), ok);
    EXPECT_EQ(event.subscribe("person_detected", "", id), ok);
    ASSERT_EQ(command.bind("follow"), ok);
    Follow::Command follow;
    EXPECT_EQ(follow.set_parameter("nobody", 500, 0), ok) << reason();
    EXPECT_EQ(Navigation::Command{}.set_parameter({"desk"}, 0, ""), ok) << reason();
    EXPECT_EQ(Person_Detection::Command{}.start(), ok);
    gateway.reset();
    gateway = std::make_unique<GatewayProcess>(std::vector<std::string>{"--listen", listen});
    EXPECT_TRUE(application.bell.await([&] { return application.errors.size() == 2; })) << "the link, then the session";
    RoIS_HRI::ParameterList parameters;
    EXPECT_EQ(command.get_parameter("follow", parameters), ok) << "it is bound again; " << reason();
    application.bell.ring([&] { application.events.clear(); });
    EXPECT_EQ(Person_Detection::Command{}.start(), ok) << reason();
    EXPECT_TRUE(application.bell.await([&] { return !application.events.empty(); })) << "it is subscribed to again";
    EXPECT_EQ(application.events.front().subscribe_id, id);
    EXPECT_EQ(system.disconnect(), ok);
}

TEST_F(CppPsm, ALostConnectionIsAnError) {
    auto gateway = std::make_unique<GatewayProcess>();
    use(gateway->url());
    ASSERT_EQ(system.connect(), ok);
    gateway.reset();
    RoIS_HRI::RoIS_IdentifierList list;
    EXPECT_EQ(command.search("", list), error) << "within 10 s";
    EXPECT_THAT(reason(), Not(IsEmpty()));
    EXPECT_EQ(system.disconnect(), error) << "the gateway did not answer";
    use(shared_gateway().url());
    EXPECT_EQ(system.connect(), ok) << "but a new session may begin";
}

// --- Receivers ---

// Counts events; each function call takes a moment.
class Slow : public Person_Localization::Event, public RoIS_Service::ServiceApplicationBase {
public:
    explicit Slow(std::atomic<int>& received) : received_{&received} {}
    ~Slow() override {
        Event::end_notifications();
        ServiceApplicationBase::end_notifications();
        received_ = nullptr;
    }
    void person_localized(std::string, RoIS_HRI::RoIS_IdentifierList, std::vector<std::string>) override { count(); }
    void completed(std::string, RoIS_Service::Completed_Status) override { count(); }

private:
    void count() {
        std::this_thread::sleep_for(1ms);
        ++*received_;
    }
    std::atomic<int>* received_;
};

TEST_F(CppPsm, ReceiversMayGoWhileNotificationsArrive) {
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml", "--sim-speed", "20"}};
    use(gateway.url());
    ASSERT_EQ(system.connect(), ok);
    Person_Localization::Command localization;
    EXPECT_EQ(localization.set_parameter(-1, 20), ok) << reason();
    std::atomic<int> received = 0;
    for (int i = 0; i < 50; ++i) {
        Slow receiver{received};
        EXPECT_EQ(localization.start(), ok) << reason();
        EXPECT_EQ(localization.stop(), ok) << reason();
    }
    EXPECT_EQ(system.disconnect(), ok);
    auto const until_now = received.load();
    EXPECT_GT(until_now, 0);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(received, until_now) << "nothing is reported after a disconnect";
}

// Blocks in its function until it is released.
class Stuck : public Person_Localization::Event {
public:
    ~Stuck() override { end_notifications(); }
    void person_localized(std::string, RoIS_HRI::RoIS_IdentifierList, std::vector<std::string>) override {
        bell.await([&] { return free; });
        ++received;
    }
    Bell bell;
    bool free = false;
    std::atomic<std::size_t> received = 0;
};

TEST_F(CppPsm, EventsThatWaitTooLongAreDroppedAndReportedOnce) {
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/pacing_visitor.xml", "--sim-speed", "100"}};
    use(gateway.url());
    Stuck receiver;
    ASSERT_EQ(system.connect(), ok);
    Blocking other{rois::Settings{}};
    auto events = other.events<rois::PersonLocalized>();
    Person_Localization::Command localization;
    EXPECT_EQ(localization.start(), ok) << reason();
    for (int i = 0; i < 1'200; ++i) ASSERT_TRUE(other(events.next(10s)));
    EXPECT_EQ(localization.stop(), ok) << reason();
    receiver.bell.ring([&] { receiver.free = true; });
    EXPECT_EQ(system.disconnect(), ok);
    EXPECT_GT(receiver.received, 1'000);
    EXPECT_LT(receiver.received, 1'100) << "1,024 that waited, one that was being delivered, and a few that came afterwards";
    EXPECT_EQ(application.errors.size(), 1);
}

TEST_F(CppPsm, ANotificationMayDisconnect) {
    struct Leaving : RoIS_Service::ServiceApplicationBase {
        ~Leaving() override { end_notifications(); }
        void completed(std::string, RoIS_Service::Completed_Status) override {
            auto const code = RoIS_HRI::SystemIF{}.disconnect();
            bell.ring([&] { left = code == ok; });
        }
        Bell bell;
        bool left = false;
    } leaving;
    ASSERT_EQ(system.connect(), ok);
    EXPECT_EQ(Person_Detection::Command{}.start(), ok);
    EXPECT_TRUE(leaving.bell.await([&] { return leaving.left; }));
    EXPECT_EQ(command.bind("move"), error);
}

TEST_F(CppPsm, ADisconnectEndsCommandsBeforeItReturns) {
    ASSERT_EQ(system.connect(), ok);
    Speech_Synthesis::Command synthesis;
    EXPECT_EQ(synthesis.set_parameter("A long speech about what happens to those who do not wait for its end.", "", 0, "", ""),
              ok);
    EXPECT_EQ(synthesis.start(), ok);
    EXPECT_EQ(system.disconnect(), ok);
    std::vector<RoIS_Service::Completed_Status> statuses;
    for (auto const& [what, how] : application.ended)
        if (what.starts_with("speech_synthesis.start.")) statuses.push_back(how);
    EXPECT_THAT(statuses, ElementsAre(RoIS_Service::ABORT));
}

TEST_F(CppPsm, OperationsOfManyThreadsShareTheSession) {
    ASSERT_EQ(system.connect(), ok);
    std::atomic<int> good = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            RoIS_HRI::ResultList position;
            for (int n = 0; n < 20; ++n)
                if (RoIS_HRI::QueryIF{}.query("robot_position", "", position) == ok) ++good;
        });
    }
    for (auto& each : threads) each.join();
    EXPECT_EQ(good, 80);
}

}  // namespace
