// Requests over HTTP: statuses of invalid and forbidden messages, and sessions (docs/clients.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/http_client.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

TEST(Message, ThatIsInvalidIsAnsweredWith422AndThePlace) {
    HttpClient client;
    auto const reply = client.post(request("bind", "\n<component/>", {{"request_id", "r7"}}));
    EXPECT_EQ(reply.status, 422);
    EXPECT_EQ(reply.fault(), "invalid");
    EXPECT_STREQ(reply.root().attribute("line").value(), "2");
    EXPECT_STREQ(reply.root().attribute("request_id").value(), "r7");
    EXPECT_EQ(client.post("<unknown/>").status, 422);
}

TEST(Session, IsNamedInBodyAndHeader) {
    HttpClient client;
    auto const reply = client.call("connect");
    EXPECT_EQ(reply.status, 200);
    EXPECT_GE(client.session.size(), 22u);
    EXPECT_EQ(reply.header("RoIS-Session"), client.session);
    auto const again = client.call("connect");
    EXPECT_EQ(again.return_code(), "OK");
    EXPECT_EQ(again.header("RoIS-Session"), reply.header("RoIS-Session"));
    EXPECT_EQ(client.call("search").header("RoIS-Session"), "");
}

TEST(Session, ThatIsMissingUnknownOrEndedIsTheSame403) {
    HttpClient client;
    auto const missing = client.call("search");
    EXPECT_EQ(missing.status, 403);
    EXPECT_EQ(missing.fault(), "no_session");
    client.session = "unknown";
    auto const unknown = client.call("search");
    client.call("connect");
    EXPECT_NE(client.session, "unknown");
    EXPECT_EQ(client.call("disconnect").return_code(), "OK");
    auto const ended = client.call("search");
    for (auto const& reply : {unknown, ended}) {
        EXPECT_EQ(reply.status, 403);
        EXPECT_EQ(reply.body, missing.body);
    }
    EXPECT_EQ(client.notifications(0, 0).body, missing.body);
}

TEST(Session, WithTwoHeadersIsInvalid) {
    HttpClient client;
    client.call("connect");
    auto const body = request("search");
    auto const line = "RoIS-Session: " + client.session + "\r\n";
    EXPECT_EQ(client
                  .say("POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\n" + line + line +
                       "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body)
                  .fault(),
              "no_session");
}

TEST(Session, EndsAfterItsTimeoutWithoutRequests) {
    GatewayProcess gateway{{"--session-timeout", "0.2", "--resume-window", "0.1"}};
    HttpClient gone{gateway};
    gone.call("connect");
    gone.call("bind", component_ref("move"));
    WebSocketClient waiting{gateway};  // its session ends with the connection
    waiting.call("connect");
    std::string bound;
    do {
        bound = waiting.call("bind", component_ref("move")).attribute("return_code").value();
    } while (bound == "OUT_OF_RESOURCES");
    EXPECT_EQ(bound, "OK");
    EXPECT_EQ(gone.call("search").fault(), "no_session");
}

TEST(Operation, BindOfFiftyConcurrentClientsSucceedsForOne) {
    std::vector<std::unique_ptr<HttpClient>> racers;
    for (int i = 0; i < 50; ++i) {
        racers.push_back(std::make_unique<HttpClient>());
        racers.back()->call("connect");
    }
    auto const body = request("bind", component_ref("gesture_recognition"));
    for (auto& racer : racers) {
        racer->line().send("POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nRoIS-Session: " + racer->session +
                           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }
    int bound = 0, refused = 0;
    for (auto& racer : racers) {
        auto const code = racer->read().return_code();
        bound += code == "OK";
        refused += code == "OUT_OF_RESOURCES";
    }
    EXPECT_EQ(bound, 1);
    EXPECT_EQ(refused, 49);
    for (auto& racer : racers) racer->call("disconnect");
}

}  // namespace
}  // namespace rois::test
