// SIGTERM and SIGINT: clients are notified, commands end, the gateway exits with 0, or with 71 if a component has not halted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include "kit/gateway_process.hpp"
#include "kit/process.hpp"
#include "kit/profile_folder.hpp"
#include "kit/vocabulary.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;

constexpr auto unstoppable = ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml";

// Sends SIGTERM to the gateway, and waits for its end. Returns how long that has taken.
std::chrono::steady_clock::duration time_to_end(GatewayProcess& gateway, Ended& ended) {
    auto const begun = std::chrono::steady_clock::now();
    gateway.signal(SIGTERM);
    ended = gateway.wait();
    return std::chrono::steady_clock::now() - begun;
}

TEST(Shutdown, EndsWithZeroOnBothSignals) {
    for (int const number : {SIGTERM, SIGINT}) {
        GatewayProcess gateway;
        gateway.signal(number);
        auto const ended = gateway.wait();
        EXPECT_EQ(ended.exit_code, 0);
        EXPECT_THAT(ended.error, testing::HasSubstr("stopped"));
    }
}

TEST(Shutdown, EndsWithZeroAlsoIfHangUpsArriveAtItsEnd) {
    GatewayProcess gateway;
    gateway.signal(SIGTERM);
    gateway.log_with("stopped");
    for (int i = 0; i < 1'000; ++i) gateway.signal(SIGHUP);
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

// Its end takes longer than a signal needs to arrive.
TEST(Shutdown, IsNotDisturbedByHangUpsThatGoOn) {
    for (int i = 0; i < 10; ++i) {
        GatewayProcess gateway;
        gateway.signal(SIGTERM);
        {
            std::jthread const others{[&](std::stop_token const& end) {
                while (!end.stop_requested()) gateway.signal(SIGHUP);
            }};
            gateway.log_with("stopped");
            std::this_thread::sleep_for(std::chrono::milliseconds{50});
        }
        ASSERT_EQ(gateway.wait().exit_code, 0);
    }
}

// The signals that this process holds back (proc(5)).
std::uint64_t held_back_by(pid_t process) {
    std::ifstream status{"/proc/" + std::to_string(process) + "/status"};
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigBlk:")) return std::stoull(line.substr(line.find('\t')), nullptr, 16);
    return 0;
}

TEST(Shutdown, BeginsAfterTheStartIfTheSignalComesBefore) {
    kit::Pipe errors;
    auto const gateway = kit::start(kit::gateway_program, {"--listen", "127.0.0.1:0"}, {}, {.error = errors.to_write});
    ::close(errors.to_write);
    auto const patience = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    while ((held_back_by(gateway) & 1U << (SIGTERM - 1)) == 0 && std::chrono::steady_clock::now() < patience)
        std::this_thread::yield();
    ::kill(gateway, SIGTERM);
    std::string log;
    while (kit::read_some(errors.to_read, log)) continue;
    ::close(errors.to_read);
    EXPECT_EQ(kit::exit_code(gateway), 0) << log;
    EXPECT_THAT(log, testing::HasSubstr("shutting down after SIGTERM"));
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
    GatewayProcess gateway{{"--scenario", unstoppable, "--shutdown-timeout", "5"}};
    gateway.signal(SIGTERM);
    auto const ended = gateway.wait();
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.error, testing::HasSubstr("navigation no longer counts as moving: it has confirmed its halt"));
    EXPECT_THAT(ended.error, testing::Not(testing::HasSubstr("navigation did not confirm")));
}

TEST(Shutdown, NamesComponentsThatDidNotHaltInTime) {
    GatewayProcess gateway{{"--scenario", unstoppable, "--sim-speed", "0", "--shutdown-timeout", "0.5"}};
    Ended ended;
    auto const took = time_to_end(gateway, ended);
    EXPECT_GE(took, 500ms);
    EXPECT_LT(took, 4500ms) << "the default is 5 s";
    EXPECT_EQ(ended.exit_code, 71);
    EXPECT_THAT(ended.error, testing::HasSubstr("navigation did not confirm that it stands still"));
}

TEST(Shutdown, DoesNotWaitForClientsThatNeverRead) {
    GatewayProcess gateway{{"--shutdown-timeout", "0.5"}};
    WebSocketClient silent{gateway};
    silent.call("connect");
    HttpClient half{gateway};
    half.line().send("GET /heal");
    HttpClient greedy{gateway};
    stuff(greedy.line(), "GET /rois/schemas/rois.xsd HTTP/1.1\r\nHost: localhost\r\n\r\n");
    Ended ended;
    auto const took = time_to_end(gateway, ended);
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_GE(took, 500ms) << "it waits for a client that may read yet";
    EXPECT_LT(took, 4500ms) << "the default is 5 s";
}

// The thread that waits for signals has mostly no connection here.
TEST(Shutdown, EndsAtOnceAtASecondSignal) {
    for (int i = 0; i < 5; ++i) {
        GatewayProcess gateway{{"--threads", "2"}};
        WebSocketClient silent{gateway};
        silent.call("connect");
        silent.keep_session();
        gateway.signal(SIGTERM);
        std::this_thread::sleep_for(200ms);
        Ended ended;
        EXPECT_LT(time_to_end(gateway, ended), 1500ms) << "it would wait 2 s for the answer to its close frame";
        EXPECT_EQ(ended.exit_code, 0);
    }
}

// All parts of the end take as long as they may, except the journal (tests/journal/process_test.cpp).
TEST(Shutdown, EndsWithinTenSecondsWithTheLongestTimeout) {
    kit::ProfileFolder const folder;
    folder.put("engines.json", R"({"engines": [{"name": "deaf", "joins": "deaf", "command": ["sh", "-c",
        "trap '' TERM; echo deaf to SIGTERM; while true; do sleep 0.1; done"]}]})");
    GatewayProcess gateway{
        {"--scenario", unstoppable, "--sim-speed", "0", "--shutdown-timeout", "5", "--engines", folder.name() + "/engines.json"}};
    EXPECT_THAT(gateway.log_with("deaf to SIGTERM"), testing::HasSubstr("deaf to SIGTERM"));
    WebSocketClient silent{gateway};
    silent.call("connect");
    HttpClient desk{gateway}, greedy{gateway};
    desk.call("connect");
    EXPECT_EQ(desk.call("bind", component_ref("speech_synthesis")).return_code(), "OK");
    auto const speech = kit::unit({.component = "speech_synthesis", .id = "speech", .arguments = {kit::speech_text("Hello.")}});
    EXPECT_EQ(desk.call("execute", kit::sequence(speech)).return_code(), "OK");
    stuff(greedy.line(), "GET /rois/schemas/rois.xsd HTTP/1.1\r\nHost: localhost\r\n\r\n");
    Ended ended;
    auto const took = time_to_end(gateway, ended);
    EXPECT_EQ(ended.exit_code, 71) << ended.error;
    EXPECT_GE(took, 5s);
    EXPECT_LE(took, 10s);
}

// The parts after it need the other five seconds (docs/safety.md#the-end).
TEST(Shutdown, TakesNoLongerTimeout) {
    auto const refused = run_gateway({"--shutdown-timeout", "5.001", "--check-config"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.error, testing::HasSubstr("a number of seconds from 0.1 to 5"));
}

}  // namespace
}  // namespace rois::test
