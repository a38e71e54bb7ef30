// Requests over HTTP: statuses of invalid and forbidden messages, and sessions (docs/clients.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/http_client.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

TEST(Message, ThatIsNotXmlIsAnsweredWith400) {
    HttpClient client;
    using namespace std::string_literals;
    for (auto const& body : {""s, " \n\t "s, "<connect"s, "<a></b>"s, request("connect") + "<again/>", "<a b='1' b='2'/>"s,
                             "\xC3\x28"s, "<a>\0</a>"s, "<a>\x01</a>"s}) {
        auto const reply = client.post(body);
        EXPECT_EQ(reply.status, 400) << body;
        EXPECT_EQ(reply.fault(), "not_well_formed") << body;
    }
}

TEST(Message, WithForbiddenXmlIsAnsweredWith400) {
    HttpClient client;
    for (std::string const body : {"<!DOCTYPE a [<!ENTITY e SYSTEM 'file:///etc/passwd'>]><a>&e;</a>", "<?pi x?><connect/>",
                                   "<?xml version='1.1'?><connect/>"}) {
        auto const reply = client.post(body);
        EXPECT_EQ(reply.status, 400) << body;
        EXPECT_NE(reply.fault(), "") << body;
    }
}

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

TEST(Session, IsSharedByConnections) {
    HttpClient desk, hall;
    desk.call("connect");
    hall.session = desk.session;
    EXPECT_EQ(hall.call("bind", component_ref("move")).return_code(), "OK");
    EXPECT_EQ(desk.call("get_parameter", component_ref("move")).return_code(), "OK");
}

TEST(Session, IsNotResumedOverHttp) {
    HttpClient client;
    client.call("connect");
    auto const reply = client.call("resume", "", {{"session", client.session}, {"last_sequence", "0"}});
    EXPECT_EQ(reply.status, 403);
    EXPECT_EQ(reply.fault(), "not_allowed");
}

TEST(Session, AboveTheLimitIsRefused) {
    GatewayProcess gateway{{"--max-sessions", "2"}};
    HttpClient first{gateway}, second{gateway}, third{gateway};
    first.call("connect");
    first.call("bind", component_ref("navigation"));
    second.call("connect");
    second.call("bind", component_ref("follow"));
    auto const reply = third.call("connect");
    EXPECT_EQ(reply.status, 429);
    EXPECT_EQ(reply.fault(), "too_many");
    second.call("disconnect");
    EXPECT_EQ(third.call("connect").return_code(), "OK");
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

TEST(Operation, AnswersWith200WhateverItsReturnCode) {
    HttpClient client;
    client.call("connect");
    auto const reply = client.call("bind", component_ref("nobody"), {{"request_id", "9"}});
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.return_code(), "BAD_PARAMETER");
    EXPECT_STREQ(reply.root().attribute("request_id").value(), "9");
    EXPECT_NE(reply.reason(), "");
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
