// The motion lease (decision 33) and stop for everything (decision 34), over real connections, while the robot drives.
#include <signal.h>

#include <chrono>
#include <thread>

#include "files/files.hpp"
#include "server/conversation.hpp"
#include "server/websocket_client.hpp"
#include "xml/profiles/document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

auto const far_away = target_position({"14000, 6000", "1000, 6000", "14000, 6000", "1000, 6000"});

// Another application, which receives the errors of navigation.
class Watcher : public Application {
public:
    explicit Watcher(GatewayProcess const& gateway) : Application{Transport::websocket, gateway} {
        connect();
        subscribe("reached_target");
    }

    // Returns why the motion was held, and when.
    std::string held() {
        while (true) {
            auto const notification = receive();
            if (notification.name() != "receive_error") continue;
            held_at = Clock::now();
            return ask("get_error_detail", text_element("error_id", notification.text("error_id"))).values()["text"].at(0);
        }
    }

    Clock::time_point held_at;
};

class Drive : public testing::Test {
protected:
    // Binds navigation and starts to drive.
    static void set_out(auto& driver) {
        driver.call("bind", component_ref("navigation"));
        auto const started =
            driver.call("execute", sequence(unit(Command{.component = "navigation", .id = "go", .arguments = {far_away}})));
        EXPECT_THAT(whole(started), HasSubstr("return_code=\"OK\""));
    }
    static std::string whole(HttpReply const& reply) { return reply.body; }
    static std::string whole(pugi::xml_node node) {
        return std::string{"return_code=\""} + node.attribute("return_code").value() + '"';
    }

    GatewayProcess gateway{{"--sim-speed", "1", "--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml"}};
    Watcher watcher{gateway};
};

TEST_F(Drive, IsHeldAtOnceWhenTheWebSocketIsReset) {
    std::optional<WebSocketClient> driver{std::in_place, gateway};
    driver->call("connect");
    set_out(*driver);
    driver->keep_session();
    driver.reset();
    auto const gone_at = Clock::now();
    EXPECT_THAT(watcher.held(), HasSubstr("its motion is held: its application gave no sign of life"));
    EXPECT_LT(watcher.held_at - gone_at, 1s) << "0.3 s, and some for a machine that is busy";
}

TEST_F(Drive, IsHeldWhenAWebSocketIsSilent) {
    WebSocketClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease", "1000"}});
    set_out(driver);
    auto const last_sign_of_life = Clock::now();
    watcher.held();
    EXPECT_GT(watcher.held_at - last_sign_of_life, 900ms);
    EXPECT_LT(watcher.held_at - last_sign_of_life, 3s);
}

TEST_F(Drive, GoesOnWhileAWebSocketAnswersPings) {
    WebSocketClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease", "1000"}});
    set_out(driver);
    for (int pings = 0; pings < 4;) {
        auto const frame = driver.next();
        if (frame.kind != kit::Kind::ping) continue;
        driver.send(frame.payload, kit::Kind::pong);
        ++pings;
    }
    EXPECT_FALSE(watcher.receive_now());
}

TEST_F(Drive, IsHeldDespitePongsWithoutAPing) {
    WebSocketClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease", "1000"}});
    set_out(driver);
    std::string first;
    auto kind = kit::Kind::ping;
    for (int pings = 0; pings < 8 && kind == kit::Kind::ping; ++pings) {
        auto const frame = driver.next();
        kind = frame.kind;
        if (first.empty()) first = frame.payload;
        driver.send(first, kit::Kind::pong);
        driver.send("", kit::Kind::pong);
    }
    ASSERT_EQ(kind, kit::Kind::text) << "receive_error: it was held";
    EXPECT_THAT(watcher.held(), HasSubstr("gave no sign of life"));
}

TEST_F(Drive, IsHeldDespitePongsIfOnlyRequestsRenewTheLease) {
    WebSocketClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease", "1000"}, {"motion_proof", "request"}});
    set_out(driver);
    for (int pings = 0; pings < 2;) {
        auto const frame = driver.next();
        if (frame.kind == kit::Kind::text) break;  // receive_error: it was held
        driver.send(frame.payload, kit::Kind::pong);
    }
    EXPECT_THAT(watcher.held(), HasSubstr("gave no sign of life"));
}

TEST_F(Drive, IsHeldWhenOnlyTheRequestsStop) {
    HttpClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease_http", "1000"}});
    set_out(driver);
    auto const last_sign_of_life = Clock::now();
    watcher.held();
    EXPECT_GT(watcher.held_at - last_sign_of_life, 900ms);
    EXPECT_LT(watcher.held_at - last_sign_of_life, 3s);
    EXPECT_EQ(driver.call("query", "<query_type>robot_position</query_type>").status, 200);
}

TEST_F(Drive, GoesOnWithAnEventStreamAndIsHeldWhenThatCloses) {
    HttpClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease_http", "1000"}});
    std::optional<Line> stream{std::in_place, gateway.address()};
    stream->send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
                 driver.session + "\r\n\r\n");
    stream->take_until("\r\n\r\n");
    set_out(driver);
    Application other{Transport::http, gateway};
    other.connect();
    for (auto const until = Clock::now() + 1500ms; Clock::now() < until;) other.query("robot_position");
    EXPECT_FALSE(watcher.receive_now());
    stream.reset();
    auto const gone_at = Clock::now();
    watcher.held();
    EXPECT_LT(watcher.held_at - gone_at, 1s);
}

TEST_F(Drive, GoesOnWhenItIsResumed) {
    WebSocketClient driver{gateway};
    driver.call("connect", {}, {{"motion_lease", "1000"}});
    set_out(driver);
    watcher.held();
    driver.ask("execute", sequence(unit(Command{.component = "navigation", .type = "resume", .id = "on"})));
    auto document = driver.next_document();
    while (std::string{document.name()} != "completed") document = driver.next_document();
    EXPECT_STREQ(document.child("command_id").text().get(), "on");
    EXPECT_STREQ(document.child("status").text().get(), "OK");
}

TEST_F(Drive, RefusesALeaseThatIsTooLong) {
    WebSocketClient driver{gateway};
    auto const refused = driver.call("connect", {}, {{"motion_lease", "5000"}});
    EXPECT_STREQ(refused.attribute("return_code").value(), "BAD_PARAMETER");
    EXPECT_STREQ(refused.child("reason").text().get(), "motion_lease must be 1000 to 2000 milliseconds, not 5000");
}

TEST_F(Drive, IsHeldWhenTheGatewayWasSuspended) {
    WebSocketClient driver{gateway};
    driver.call("connect");
    set_out(driver);
    gateway.signal(SIGSTOP);
    for (auto const until = Clock::now() + 2500ms; Clock::now() < until;) std::this_thread::sleep_until(until);
    gateway.signal(SIGCONT);
    EXPECT_THAT(watcher.held(), HasSubstr("the engine stood still for"));
}

// --- Stop for everything ---

std::string what_is_wrong_with(HttpReply const& reply) {
    static xml::Platform const platform;
    static auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    try {
        xml::Document::parse(schemas, "the answer", reply.body);
        return reply.header("Content-Type") == "application/xml; charset=utf-8" ? ""
                                                                                : "its Content-Type is not that of documents";
    } catch (std::exception const& wrong) {
        return wrong.what();
    }
}

// Waits until all components have confirmed that they stand still. Returns the last answer of /readyz.
HttpReply ready_when_all_are_halted(HttpClient& client) {
    while (true) {
        auto ready = client.get("/readyz");
        if (ready.body.find("has not confirmed") == std::string::npos) return ready;
        std::this_thread::sleep_for(20ms);
    }
}

TEST_F(Drive, IsStoppedByStopForEverythingAndNothingStartsUntilItIsCleared) {
    WebSocketClient driver{gateway};
    driver.call("connect");
    set_out(driver);
    HttpClient anybody{gateway};
    auto const stopped = anybody.get("/rois/stop", {}, "POST");
    EXPECT_EQ(stopped.status, 200);
    EXPECT_EQ(what_is_wrong_with(stopped), "") << stopped.body;
    EXPECT_STREQ(stopped.root().name(), "stop_state");
    EXPECT_EQ(stopped.text("stopped"), "true");
    EXPECT_THAT(watcher.held(), HasSubstr("everything was stopped"));
    auto const ready = ready_when_all_are_halted(anybody);
    EXPECT_EQ(ready.status, 503);
    EXPECT_EQ(ready.body, "stopped: nothing starts until POST /rois/clear\n");
    EXPECT_THAT(anybody.get("/metrics").body, HasSubstr("rois_everything_stopped 1"));
    Application desk{Transport::http, gateway};
    desk.connect();
    desk.bind("speech_synthesis");
    EXPECT_THAT(desk.execute(speak("Hello.")), IsRefused("ERROR", "everything was stopped"));
    EXPECT_EQ(desk.receive().name(), "receive_error");
    auto const cleared = anybody.get("/rois/clear", {}, "POST");
    EXPECT_EQ(cleared.status, 200);
    EXPECT_EQ(what_is_wrong_with(cleared), "") << cleared.body;
    EXPECT_EQ(cleared.text("stopped"), "false");
    EXPECT_FALSE(cleared.root().child("not_halted"));
    EXPECT_THAT(desk.execute(speak("Hello.")), IsOk());
    EXPECT_EQ(anybody.get("/readyz").status, 200);
}

TEST(StopForEverything, NamesTheComponentsThatHaveNotConfirmed) {
    GatewayProcess gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--sim-speed", "0", "--shutdown-timeout", "0.1"}};
    HttpClient anybody{gateway};
    for (auto const* path : {"/rois/stop", "/rois/clear"}) {
        auto const reply = anybody.get(path, {}, "POST");
        EXPECT_EQ(reply.status, 200) << path;
        EXPECT_EQ(what_is_wrong_with(reply), "") << reply.body;
        EXPECT_EQ(reply.text("not_halted"), "navigation") << path;
    }
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 71);
}

TEST_F(Drive, StopForEverythingIsAPost) {
    HttpClient anybody{gateway};
    EXPECT_EQ(anybody.get("/rois/stop").status, 405);
    EXPECT_EQ(anybody.get("/rois/clear").status, 405);
    EXPECT_EQ(anybody.get("/readyz").status, 200);
}

}  // namespace
}  // namespace rois::test
