// Requests behind one that a component does not answer (decisions 36 and 37).
#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "kit/profile_folder.hpp"
#include "server/conversation.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;
using kit::component_ref;

// One component answers no queries. The gateway waits for it for `question_deadline`.
struct SlowGateway : GatewayProcess {
    explicit SlowGateway(std::string const& question_deadline, std::vector<std::string> const& more = {})
        : GatewayProcess{arguments(question_deadline, more)} {}

private:
    static std::vector<std::string> arguments(std::string const& question_deadline, std::vector<std::string> const& more) {
        std::vector<std::string> all{"--scenario",          ROIS_SOURCE_DIR "/tests/server/data/silent.xml",
                                     "--sim-speed",         "20",
                                     "--question-deadline", question_deadline};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

Xml position_query() { return text_element("query_type", "robot_position"); }

std::string return_code(pugi::xml_node answer) { return answer.attribute("return_code").value(); }

// Waits until /metrics has this line.
bool metrics_come_to(GatewayProcess& gateway, std::string const& line) {
    HttpClient observer{gateway};
    for (auto const end = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < end;) {
        if (observer.get("/metrics").body.find(line) != std::string::npos) return true;
        std::this_thread::sleep_for(5ms);
    }
    return false;
}

std::string post_in(std::string const& session, std::string const& body) {
    return "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nRoIS-Session: " + session +
           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

Xml stop_of_speech() { return kit::sequence(kit::unit({.component = "speech_synthesis", .type = "stop", .id = "stop"})); }

// The robot speaks. Two requests wait for a silent component, and a stop of the speech is behind them. `arrived` returns the
// return code of the first answer if it has arrived. Expects that the stop does not act before.
void expect_no_stop_before_the_first_answer(GatewayProcess& gateway, auto const& arrived) {
    HttpClient observer{gateway};
    std::optional<std::string> first;
    while (!first) {
        auto const metrics = observer.get("/metrics").body;
        first = arrived();
        if (!first) {
            ASSERT_THAT(metrics, HasSubstr("rois_commands_completed_total{status=\"ABORT\"} 0\n"));
        }
    }
    EXPECT_EQ(*first, "TIMEOUT");
    EXPECT_TRUE(metrics_come_to(gateway, "rois_commands_completed_total{status=\"ABORT\"} 1")) << "then it acts";
}

// Calls `read` without waiting for bytes that have not arrived. Returns nothing if they have not.
std::optional<std::string> read_now(Line& line, auto const& read) {
    std::optional<std::string> found;
    line.set_patience(0ms);
    try {
        found = read();
    } catch (LineEnded const&) {
        found.reset();
    }
    line.set_patience(20s);
    return found;
}

struct Slow : testing::Test {
    SlowGateway gateway{"60"};
    WebSocketClient desk{gateway};

    Slow() {
        desk.call("connect");
        for (auto const* ref : {"navigation", "speech_synthesis"}) desk.call("bind", component_ref(ref));
    }
    ~Slow() override { desk.keep_session(); }
};

// Begins to speak. Then sends, without waiting for answers, two queries that no component answers, and a stop.
void stop_behind_two_queries(HttpClient& desk) {
    desk.call("connect");
    desk.call("bind", component_ref("speech_synthesis"));
    EXPECT_EQ(desk.call("execute", kit::sequence(kit::unit(speak_long("speech")))).return_code(), "OK");
    auto const query = post_in(desk.session, kit::request("query", position_query()));
    desk.line().send(query + query + post_in(desk.session, kit::request("execute", stop_of_speech())));
}

}  // namespace

TEST(AQueryWithoutAnAnswer, TimesOut) {
    SlowGateway gateway{"0.3"};
    HttpClient desk{gateway};
    desk.call("connect");
    auto const answer = desk.call("query", position_query());
    EXPECT_EQ(answer.return_code(), "TIMEOUT");
    EXPECT_THAT(answer.reason(), HasSubstr("within 0.3 s"));
    EXPECT_THAT(desk.call("search", where(equal("status", "ERROR"))).body, HasSubstr("system_information"));
}

TEST(AnAnswerThatIsLate, ComesAlsoAfterTheIdleTimeout) {
    SlowGateway gateway{"0.5", {"--idle-timeout", "0.1"}};
    HttpClient desk{gateway};
    desk.call("connect");
    EXPECT_EQ(desk.say(post_in(desk.session, kit::request("query", position_query())), "POST").return_code(), "TIMEOUT");
}

TEST_F(Slow, AStopBehindASlowQueryActsAtOnce) {
    desk.call(
        "execute",
        kit::sequence(kit::unit({.component = "navigation", .id = "go", .arguments = {target_position({"11000, 1000, 0"})}})));
    desk.ask("query", position_query());
    desk.ask("execute", kit::sequence(kit::unit({.component = "navigation", .type = "stop", .id = "stop"})));
    EXPECT_TRUE(metrics_come_to(gateway, "rois_commands_completed_total{status=\"ABORT\"} 1"));
}

// With the default, which is 16, the stop acts at once.
TEST(RequestsInFlight, OfAWebSocketAreAsManyAsTheKeyAllows) {
    SlowGateway gateway{"1", {"--max-requests-in-flight", "2"}};
    WebSocketClient desk{gateway};
    desk.call("connect");
    desk.call("bind", component_ref("speech_synthesis"));
    EXPECT_EQ(return_code(desk.call("execute", kit::sequence(kit::unit(speak_long("speech"))))), "OK");
    for (int i = 0; i < 2; ++i) desk.ask("query", position_query());
    desk.ask("execute", stop_of_speech());
    expect_no_stop_before_the_first_answer(
        gateway, [&] { return read_now(desk.line(), [&] { return return_code(desk.next_document()); }); });
}

TEST(RequestsInFlight, OverHttpAreAsManyAsTheKeyAllows) {
    SlowGateway gateway{"1", {"--max-requests-in-flight", "2"}};
    HttpClient desk{gateway};
    stop_behind_two_queries(desk);
    expect_no_stop_before_the_first_answer(gateway,
                                           [&] { return read_now(desk.line(), [&] { return desk.read().return_code(); }); });
    EXPECT_EQ(desk.read().return_code(), "TIMEOUT");
    EXPECT_STREQ(desk.read().root().name(), "execute_response");
}

// The counter-case over HTTP.
TEST(AnswersBehindASlowOne, DoNotKeepAStopFromActingOverHttp) {
    SlowGateway gateway{"60"};
    HttpClient desk{gateway};
    stop_behind_two_queries(desk);
    EXPECT_TRUE(metrics_come_to(gateway, "rois_commands_completed_total{status=\"ABORT\"} 1"));
    desk.session.clear();
}

TEST_F(Slow, ADelayedAnswerHoldsBackNothingElse) {
    desk.call("execute",
              kit::sequence(kit::unit({.component = "speech_synthesis", .id = "say", .arguments = {speech_text("Hello.")}})));
    desk.ask("query", position_query());
    auto const notification = desk.next_document();
    EXPECT_STREQ(notification.name(), "completed");
    EXPECT_STREQ(notification.child("command_id").text().get(), "say");
}

TEST_F(Slow, NotificationsWaitForTheAnswerThatCausedThem) {
    desk.ask("query", position_query());
    desk.ask("execute", kit::sequence(kit::unit({.component = "navigation", .type = "stop", .id = "stop"})));
    EXPECT_TRUE(metrics_come_to(gateway, "rois_commands_completed_total{status=\"OK\"} 1"));
    desk.send("", kit::Kind::ping);
    EXPECT_EQ(desk.next().kind, kit::Kind::pong) << "neither the answer nor its `completed` was sent";
}

TEST(AnswersBehindASlowOne, KeepTheOrderOfTheirRequestsOnAWebSocket) {
    SlowGateway gateway{"0.5"};
    WebSocketClient desk{gateway};
    desk.call("connect");
    desk.call("bind", component_ref("navigation"));
    desk.ask("query", position_query());
    desk.ask("execute", kit::sequence(kit::unit({.component = "navigation", .type = "stop", .id = "stop"})));
    desk.ask("search");
    EXPECT_EQ(return_code(desk.next_document()), "TIMEOUT");
    auto const executed = desk.next_document();
    EXPECT_STREQ(executed.name(), "execute_response");
    std::vector<std::string> rest;
    for (int i = 0; i < 2; ++i) rest.emplace_back(desk.next_document().name());
    EXPECT_THAT(rest, testing::UnorderedElementsAre("search_response", "completed"));
}

TEST(AnswersBehindASlowOne, ComeAtOnceToAnEngine) {
    SlowGateway gateway{"60"};
    WebSocketClient engine{gateway};
    engine.call("connect", {}, {{"role", "engine"}});
    for (int i = 0; i < 100; ++i) engine.ask("query", position_query());
    engine.ask("bind", component_ref("navigation"));
    engine.ask("execute", kit::sequence(kit::unit({.component = "navigation", .type = "stop", .id = "stop"})));
    engine.ask("connect", {}, {{"role", "engine"}});
    std::vector<std::string> answers;
    while (answers.size() < 3)
        if (std::string_view const name = engine.next_document().name(); name.ends_with("_response")) answers.emplace_back(name);
    EXPECT_THAT(answers, testing::ElementsAre("bind_response", "execute_response", "connect_response"));
    engine.keep_session();
}

// Otherwise the other engine would begin its commands in another order.
TEST(AnswersOfPromptComponents, KeepTheOrderOfTheirRequestsForAnEngine) {
    GatewayProcess const robot;
    kit::ProfileFolder const folder;
    folder.put("engines.json", R"({"engines": [{"name": "robot", "url": ")" + robot.url() + R"("}]})");
    GatewayProcess gateway{{"--robots", "none", "--engines", folder.name() + "/engines.json"}};
    gateway.log_with("present with");
    WebSocketClient engine{gateway};
    engine.call("connect", {}, {{"role", "engine"}});
    auto const ref = component_ref("robot.navigation");
    auto const next = [&](std::string_view name) {
        auto answer = engine.next_document();
        while (name != answer.name()) answer = engine.next_document();
        return answer;
    };
    engine.ask("bind", ref);
    next("bind_response");
    std::vector<int> answers;
    for (int i = 0; i < 1000; i += 2) {
        for (int id : {i, i + 1})
            engine.ask("set_parameter", ref + kit::parameters({{"time_limit", "int", {std::to_string(7'000 + id)}}}),
                       {{"request_id", std::to_string(id)}});
        for (int n = 0; n < 2; ++n) answers.push_back(next("set_parameter_response").attribute("request_id").as_int());
    }
    EXPECT_TRUE(std::ranges::is_sorted(answers));
}

TEST(AnswersBehindASlowOne, KeepTheOrderOfTheirRequestsOverHttp) {
    SlowGateway gateway{"0.5"};
    HttpClient desk{gateway};
    desk.call("connect");
    auto const post = [&](std::string const& body) { return post_in(desk.session, body); };
    auto const query = post(kit::request("query", position_query()));
    EXPECT_EQ(desk.say(query + post(kit::request("search")) +
                           "POST /rois/stop HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n" +
                           "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n",
                       "POST")
                  .return_code(),
              "TIMEOUT");
    EXPECT_STREQ(desk.read().root().name(), "search_response");
    EXPECT_STREQ(desk.read().root().name(), "stop_state");
    EXPECT_EQ(desk.read().status, 200);
}

TEST(AnswersBehindASlowOne, ComeBeforeAnOrderlyEnd) {
    SlowGateway gateway{"0.3"};
    WebSocketClient desk{gateway};
    desk.call("connect");
    desk.ask("query", position_query());
    desk.ask("disconnect");
    auto const query = desk.next_document();
    EXPECT_TRUE(return_code(query) == "TIMEOUT" || std::string_view{query.name()} == "fault") << query.name();
    EXPECT_STREQ(desk.next_document().name(), "disconnect_response");
    desk.keep_session();
}

TEST(AStopOfEverything, ActsAtOnceBehindASlowRequest) {
    SlowGateway gateway{"60"};
    HttpClient desk{gateway};
    desk.call("connect");
    auto const body = kit::request("query", position_query());
    desk.line().send("POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nRoIS-Session: " + desk.session +
                     "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body +
                     "POST /rois/stop HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n");
    EXPECT_TRUE(metrics_come_to(gateway, "rois_everything_stopped 1"));
    desk.session.clear();
}

}  // namespace rois::test
