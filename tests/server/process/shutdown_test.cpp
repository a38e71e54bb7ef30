// SIGTERM and SIGINT: clients are notified, commands end, the gateway exits with 0, or with 71 if a component has not halted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

TEST(Shutdown, EndsWithZeroOnBothSignals) {
    for (int const number : {SIGTERM, SIGINT}) {
        GatewayProcess gateway;
        gateway.signal(number);
        auto const ended = gateway.wait();
        EXPECT_EQ(ended.exit_code, 0);
        EXPECT_THAT(ended.error, testing::HasSubstr("stopped"));
    }
}

TEST(Shutdown, SendsTheLastNotificationsToAWebSocketAndCloses) {
    GatewayProcess gateway;
    WebSocketClient client{gateway};
    client.call("connect");
    client.call("bind", component_ref("follow"));
    kit::Xml const start =
        "<rois:CommandUnitSequence><rois:command_unit_list xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
        "xsi:type=\"rois:CommandMessageType\" rois:delay_time=\"3600000\" rois:command_type=\"stop\" rois:command_id=\"late\">"
        "<rois:component_ref rois:code=\"follow\"/></rois:command_unit_list></rois:CommandUnitSequence>";
    EXPECT_STREQ(client.call("execute", start).attribute("return_code").value(), "OK");
    gateway.signal(SIGTERM);
    auto const last = client.next_document();
    EXPECT_STREQ(last.name(), "completed");
    EXPECT_STREQ(last.child("status").text().get(), "ABORT");
    EXPECT_EQ(client.await_close(), 1001);
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

TEST(Shutdown, EndsStreamsPollsAndIdleConnections) {
    GatewayProcess gateway;
    HttpClient client{gateway};
    bind_and_complete(client, 1);
    Line stream{gateway.address()}, poll{gateway.address()};
    auto const session = "RoIS-Session: " + client.session + "\r\n\r\n";
    stream.send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n" + session);
    stream.take_until("\n\n");
    poll.send("GET /rois/notifications?after=1&wait=30 HTTP/1.1\r\nHost: localhost\r\n" + session);
    while (client.get("/metrics").body.find("rois_connections_accepted_total 3") == std::string::npos) {
    }
    gateway.signal(SIGTERM);
    EXPECT_TRUE(stream.ends());
    poll.rest();
    EXPECT_TRUE(client.line().ends());
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

TEST(Shutdown, AnswersRequestsOnTheirWayWith503) {
    GatewayProcess gateway;
    HttpClient ready{gateway}, operation{gateway}, watching{gateway};
    operation.call("connect");
    EXPECT_EQ(watching.get("/readyz").status, 200);
    ready.line().send("GET /readyz HTTP/1.1\r\nHost: localhost\r\n");
    auto const body = request("search");
    operation.line().send("POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nRoIS-Session: " +
                          operation.session + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n");
    while (watching.get("/metrics").body.find("rois_connections{kind=\"http\"} 3") == std::string::npos) {
    }
    gateway.signal(SIGTERM);
    EXPECT_TRUE(watching.line().ends());
    auto const not_ready = ready.say("\r\n");
    EXPECT_EQ(not_ready.status, 503);
    EXPECT_EQ(not_ready.fault(), "shutting_down");
    auto const refused = operation.say(body);
    EXPECT_EQ(refused.status, 503);
    EXPECT_EQ(refused.fault(), "shutting_down");
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

TEST(Shutdown, WaitsUntilAllComponentsHaveHalted) {
    GatewayProcess gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--shutdown-timeout", "8"}};
    gateway.signal(SIGTERM);
    auto const ended = gateway.wait();
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.error, testing::HasSubstr("navigation has confirmed that it stands still"));
    EXPECT_THAT(ended.error, testing::Not(testing::HasSubstr("navigation did not confirm")));
}

TEST(Shutdown, NamesComponentsThatDidNotHaltInTime) {
    GatewayProcess gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--sim-speed", "0", "--shutdown-timeout", "0.5"}};
    gateway.signal(SIGTERM);
    auto const ended = gateway.wait();
    EXPECT_EQ(ended.exit_code, 71);
    EXPECT_THAT(ended.error, testing::HasSubstr("navigation did not confirm that it stands still"));
}

TEST(Shutdown, DoesNotWaitForClientsThatNeverRead) {
    GatewayProcess gateway{{"--shutdown-timeout", "0.5"}};
    WebSocketClient silent{gateway};
    silent.call("connect");
    HttpClient half{gateway};
    half.line().send("GET /heal");
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

}  // namespace
}  // namespace rois::test
