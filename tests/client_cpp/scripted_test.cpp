// Rare orders of messages, with a scripted gateway.
#include "client_cpp/rig.hpp"
#include "client_cpp/scripted_gateway.hpp"

namespace rois::test {
namespace {

class TheScript : public testing::Test {
protected:
    TheScript() { connect("one"); }
    ~TheScript() override { gateway.cut(); }

    void receive_subscribe(std::string const& event_type) {
        EXPECT_THAT(gateway.receive("subscribe"), testing::HasSubstr(">" + event_type + "<"));
    }
    void subscribe(std::string const& event_type, std::string const& id) {
        receive_subscribe(event_type);
        gateway.answer("<subscribe_id>" + id + "</subscribe_id>");
    }
    EventStream subscribed(std::string const& event_type, std::string const& id) {
        auto stream = begun(client, client.subscribe(event_type));
        subscribe(event_type, id);
        return stream.get();
    }

    // Exchanges a request, so that the client has received all earlier documents.
    void ask() {
        auto asking = begun(client, client.call(Search{}));
        gateway.receive("search");
        gateway.answer("<component_ref_list/>");
        EXPECT_EQ(asking.get().return_code, ReturnCode::ok);
    }

    // Accepts the next link, reports that the session has ended, and opens another session.
    void replace_session(std::string const& session) {
        gateway.accept();
        gateway.receive("resume");
        gateway.fault("no_session");
        connect(session);
    }
    void connect(std::string const& session) {
        gateway.accept();
        gateway.receive("connect");
        gateway.answer("<session>" + session + "</session>");
    }

    ScriptedGateway gateway;
    History history;
    Blocking robot{quick(gateway.url()), history.observers()};
    Client& client = robot.client();
};

TEST_F(TheScript, TakesNoAnswerWithoutACommandForARealSetParameter) {
    auto const answered = [&](bool check_only) {
        auto asking = begun(client, client.call(SetParameter{
                                        {.code = "lamp", .authority = {}, .codebook_ref = {}, .version = {}}, {}, check_only}));
        gateway.receive("set_parameter");
        gateway.answer("<command_id/>");
        return asking;
    };
    auto const reply = answered(false).get();
    EXPECT_EQ(reply.return_code, ReturnCode::error);
    EXPECT_THAT(reply.reason, testing::HasSubstr("no command_id"));
    EXPECT_EQ(answered(true).get().return_code, ReturnCode::ok);
}

// The client holds events back while the subscribe_id of a new subscription is unknown.
TEST_F(TheScript, DeliversHeldEventsOfTheOldSessionToItsStreams) {
    auto one = subscribed("a", "s-1");
    auto subscribing = begun(client, client.subscribe("b"));
    receive_subscribe("b");
    gateway.event(1, "s-1");
    replace_session("two");
    subscribe("a", "s-2");
    subscribe("b", "s-1");
    auto other = subscribing.get();
    ask();
    EXPECT_TRUE(robot(one.next_event(0ms)));
    EXPECT_FALSE(robot(other.next_event(0ms)));
}

TEST_F(TheScript, DropsNotificationsOfASessionThatEndedDuringTheRestore) {
    auto one = subscribed("a", "s-1");
    replace_session("two");
    receive_subscribe("a");
    gateway.event(1, "s-2");
    replace_session("three");
    subscribe("a", "s-2");
    gateway.event(1, "s-2");
    ask();
    EXPECT_TRUE(robot(one.next_event(0ms)));
    EXPECT_FALSE(robot(one.next_event(0ms)));
    EXPECT_THAT(history.notifications(), testing::SizeIs(1));
    EXPECT_THAT(history.gaps(), testing::SizeIs(1));
}

TEST_F(TheScript, DeliversNoEventsToAStreamThatTheNewSessionRefused) {
    auto one = subscribed("a", "s-1");
    auto other = subscribed("b", "s-2");
    replace_session("two");
    receive_subscribe("a");
    gateway.answer({}, "UNSUPPORTED");
    subscribe("b", "s-1");
    gateway.event(1, "s-1");
    ask();
    EXPECT_TRUE(robot(other.next_event(0ms)));
    EXPECT_FALSE(robot(one.next_event(0ms)));
    EXPECT_THAT(history.gaps().at(0).not_restored, testing::ElementsAre(testing::StartsWith("subscribe a: ")));
}

TEST_F(TheScript, RestoresBindingsWithTheirSwitching) {
    auto const binds = [](std::string const& ref, std::string const& switching) {
        return testing::AllOf(testing::HasSubstr("\"" + ref + "\""), testing::HasSubstr("switching=\"" + switching + "\""));
    };
    auto named = begun(client, client.bind("navigation", Switching::abort));
    EXPECT_THAT(gateway.receive("bind"), binds("navigation", "abort"));
    gateway.answer();
    auto again = begun(client, named.get().bind(Switching::restart));
    EXPECT_THAT(gateway.receive("bind"), binds("navigation", "restart"));
    gateway.answer();
    again.get();
    auto any = begun(client, client.bind_any(type == "Move", Switching::abort));
    EXPECT_THAT(gateway.receive("bind_any"), testing::HasSubstr("switching=\"abort\""));
    gateway.answer(R"(<component_ref xmlns:rois="http://www.omg.org/spec/RoIS/20240801" rois:code="move"/>)");
    any.get();
    replace_session("two");
    EXPECT_THAT(gateway.receive("bind"), binds("navigation", "restart")) << "the latest one";
    gateway.answer();
    EXPECT_THAT(gateway.receive("bind"), binds("move", "abort"));
    gateway.answer();
    ask();
}

TEST_F(TheScript, DeliversASwitchOnce) {
    gateway.switched(1);
    gateway.switched(1);
    ask();
    auto const all = history.notifications();
    ASSERT_THAT(all, testing::SizeIs(1));
    auto const& switched = std::get<Switched>(all[0].second);
    EXPECT_EQ(switched.component_ref.code, "navigation");
    EXPECT_EQ(switched.from, "robot1.navigation");
    EXPECT_EQ(switched.to, "robot2.navigation");
    EXPECT_EQ(switched.reason, "says the script");
}

TEST(AConnectionWithSwitches, RequestsThemInEachSession) {
    ScriptedGateway gateway;
    auto settings = quick(gateway.url());
    settings.switches = true;
    Connection const connection{settings};
    for (std::string const session : {"one", "two"}) {
        gateway.accept();
        if (session == "two") {
            gateway.receive("resume");
            gateway.fault("no_session");
            gateway.accept();
        }
        EXPECT_THAT(gateway.receive("connect"), testing::HasSubstr("switches=\"true\""));
        gateway.answer("<session>" + session + "</session>");
    }
    gateway.cut();
}

TEST_F(TheScript, RunsNoSequenceInTwoSessions) {
    auto running = begun(client, client.component("c").start());
    gateway.receive("execute");
    gateway.accept();
    gateway.receive("resume");
    gateway.answer();
    gateway.receive("execute");
    gateway.fault("no_session");
    connect("two");
    EXPECT_THROW(running.get(), Error);
    EXPECT_NO_THROW(ask());
}

}  // namespace
}  // namespace rois::test
