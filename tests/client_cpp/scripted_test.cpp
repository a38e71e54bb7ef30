// What the real gateway seldom does: step by step, before one that the test plays.
#include "client_cpp/rig.hpp"
#include "client_cpp/scripted_gateway.hpp"

namespace rois::test {
namespace {

class TheScript : public testing::Test {
protected:
    TheScript() { connect("one"); }
    ~TheScript() override { gateway.cut(); }

    void hear_subscribe(std::string const& event_type) {
        EXPECT_THAT(gateway.hear("subscribe"), testing::HasSubstr(">" + event_type + "<"));
    }
    void subscribe(std::string const& event_type, std::string const& id) {
        hear_subscribe(event_type);
        gateway.answer("<subscribe_id>" + id + "</subscribe_id>");
    }
    EventStream subscribed(std::string const& event_type, std::string const& id) {
        auto stream = begun(client, client.subscribe(event_type));
        subscribe(event_type, id);
        return stream.get();
    }

    // A question that is the next that is heard; all that was said before the answer is heard then.
    void ask() {
        auto asking = begun(client, client.call(Search{}));
        gateway.hear("search");
        gateway.answer("<component_ref_list/>");
        EXPECT_EQ(asking.get().return_code, ReturnCode::ok);
    }

    // The next link is there, and the session is not.
    void begin_anew(std::string const& session) {
        gateway.accept();
        gateway.hear("resume");
        gateway.fault("no_session");
        connect(session);
    }
    void connect(std::string const& session) {
        gateway.accept();
        gateway.hear("connect");
        gateway.answer("<session>" + session + "</session>");
    }

    ScriptedGateway gateway;
    History history;
    Blocking robot{quick(gateway.url()), history.observers()};
    Client& client = robot.client();
};

// They wait while it is not known yet whose events a new subscription's are.
TEST_F(TheScript, TellsEventsOfASessionThatIsGoneToThoseWhoHeardThemThere) {
    auto one = subscribed("a", "s-1");
    auto subscribing = begun(client, client.subscribe("b"));
    hear_subscribe("b");
    gateway.event(1, "s-1");
    begin_anew("two");
    subscribe("a", "s-2");
    subscribe("b", "s-1");
    auto other = subscribing.get();
    ask();
    EXPECT_TRUE(robot(one.next_event(0ms)));
    EXPECT_FALSE(robot(other.next_event(0ms)));
}

TEST_F(TheScript, TellsNothingOfASessionThatWasGoneBeforeAllWasMadeAnew) {
    auto one = subscribed("a", "s-1");
    begin_anew("two");
    hear_subscribe("a");
    gateway.event(1, "s-2");
    begin_anew("three");
    subscribe("a", "s-2");
    gateway.event(1, "s-2");
    ask();
    EXPECT_TRUE(robot(one.next_event(0ms)));
    EXPECT_FALSE(robot(one.next_event(0ms)));
    EXPECT_THAT(history.notifications(), testing::SizeIs(1));
    EXPECT_THAT(history.gaps(), testing::SizeIs(1));
}

TEST_F(TheScript, TellsNoEventsToWhomANewSessionRefuses) {
    auto one = subscribed("a", "s-1");
    auto other = subscribed("b", "s-2");
    begin_anew("two");
    hear_subscribe("a");
    gateway.answer({}, "UNSUPPORTED");
    subscribe("b", "s-1");
    gateway.event(1, "s-1");
    ask();
    EXPECT_TRUE(robot(other.next_event(0ms)));
    EXPECT_FALSE(robot(one.next_event(0ms)));
    EXPECT_THAT(history.gaps().at(0).not_restored, testing::ElementsAre(testing::StartsWith("subscribe a: ")));
}

TEST_F(TheScript, RunsNoSequenceInTwoSessions) {
    auto running = begun(client, client.component("c").start());
    gateway.hear("execute");
    gateway.accept();
    gateway.hear("resume");
    gateway.answer();
    gateway.hear("execute");
    gateway.fault("no_session");
    connect("two");
    EXPECT_THROW(running.get(), Error);
    EXPECT_NO_THROW(ask());
}

}  // namespace
}  // namespace rois::test
