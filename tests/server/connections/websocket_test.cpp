// WebSockets: the handshake, the messages, and every reason to close (docs/clients.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

std::string name_of(pugi::xml_node document) { return document.name(); }
std::string code_of(pugi::xml_node answer) { return answer.attribute("return_code").value(); }
std::string fault_of(pugi::xml_node answer) { return name_of(answer) == "fault" ? answer.attribute("code").value() : ""; }

std::string resume(WebSocketClient& client, std::string const& session, unsigned last_sequence) {
    return code_of(client.call("resume", "", {{"session", session}, {"last_sequence", std::to_string(last_sequence)}}));
}

TEST(Handshake, IsAnsweredWithTheSubprotocol) {
    HttpClient http;
    auto const reply = shake_hands(http, {{"Sec-WebSocket-Protocol", "rois.bearer.dG9rZW4, rois.xml.v1"}});
    EXPECT_EQ(reply.status, 101);
    EXPECT_EQ(reply.header("Upgrade"), "websocket");
    EXPECT_EQ(reply.header("Connection"), "Upgrade");
    EXPECT_EQ(reply.header("Sec-WebSocket-Accept"), expected_accept);
    EXPECT_EQ(reply.header("Sec-WebSocket-Protocol"), "rois.xml.v1");
}

// tests/net/upgrade_test.cpp has all reasons for a refusal.
TEST(Handshake, IsPossibleAfterARefusedHandshake) {
    HttpClient http;
    auto const reply = shake_hands(http, {{"Sec-WebSocket-Version", "8"}});
    EXPECT_EQ(reply.status, 426);
    EXPECT_EQ(reply.fault(), "upgrade_required");
    EXPECT_EQ(shake_hands(http, {{"Sec-WebSocket-Protocol", ""}}).status, 400);
    EXPECT_EQ(http.get("/rois").status, 426);
    EXPECT_EQ(shake_hands(http).status, 101);
}

TEST(Handshake, ReleasesTheMemoryOfItsHead) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "memory that was given back still counts";
#endif
    GatewayProcess gateway{{"--threads", "1"}};
    std::vector<std::unique_ptr<HttpClient>> applications;
    auto const connect = [&](std::size_t many) {
        for (std::size_t i = 0; i < many; ++i) {
            applications.push_back(std::make_unique<HttpClient>(gateway));
            ASSERT_EQ(shake_hands(*applications.back(), {{"Cookie", std::string(12'000, 'x')}}).status, 101);
        }
    };
    connect(20);
    auto const before = gateway.resident_bytes();
    connect(200);
    EXPECT_LT((gateway.resident_bytes() - before) / 200, 9'000U);
}

TEST(Handshake, AcceptsOnlyPagesOfThisServerAndAllowedOrigins) {
    GatewayProcess gateway{{"--allowed-origins", "https://console.example http://other.example:81"}};
    for (auto const* origin : {"http://localhost", "HTTP://LocalHost:80", "https://console.example", "http://other.example:81"}) {
        HttpClient http{gateway};
        EXPECT_EQ(shake_hands(http, {{"Origin", origin}}).status, 101) << origin;
    }
    HttpClient http{gateway};
    for (auto const* origin :
         {"http://evil.example", "http://localhost:81", "http://localhost.evil.example", "null", "http://other.example"}) {
        auto const reply = shake_hands(http, {{"Origin", origin}});
        EXPECT_EQ(reply.status, 403) << origin;
        EXPECT_EQ(reply.fault(), "not_allowed") << origin;
    }
}

TEST(WebSocket, AnswersBeforeItNotifies) {
    WebSocketClient client;
    EXPECT_EQ(code_of(client.call("connect")), "OK");
    EXPECT_EQ(code_of(client.call("bind", component_ref("navigation"))), "OK");
    for (unsigned i = 1; i <= 20; ++i) {
        auto const answer =
            client.call("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000), {{"request_id", "r"}});
        EXPECT_EQ(name_of(answer), "set_parameter_response");
        EXPECT_STREQ(answer.attribute("request_id").value(), "r");
        std::string const command_id = answer.child("command_id").text().get();
        auto const notification = client.next_document();
        EXPECT_EQ(notification.attribute("sequence").as_uint(), i);
        EXPECT_EQ(notification.child("command_id").text().get(), command_id);
    }
}

TEST(WebSocket, AnswersManyRequestsInOrder) {
    WebSocketClient client;
    client.call("connect");
    for (int i = 0; i < 200; ++i) {
        std::string const behind(i % 20 == 0 ? 100'000 : 0, ' ');  // the gateway reads long documents on another thread
        client.send(request("search", "", {{"request_id", std::to_string(i)}}) + behind);
    }
    for (int i = 0; i < 200; ++i) EXPECT_EQ(client.next_document().attribute("request_id").as_int(), i);
}

TEST(WebSocket, LivesThroughFaults) {
    WebSocketClient client;
    client.send("<oops");
    EXPECT_EQ(fault_of(client.next_document()), "not_well_formed");
    client.send("");
    EXPECT_EQ(fault_of(client.next_document()), "not_well_formed");
    EXPECT_EQ(fault_of(client.call("search")), "no_session");
    EXPECT_EQ(fault_of(client.call("resume", "", {{"session", "unknown"}, {"last_sequence", "0"}})), "no_session");
    EXPECT_EQ(code_of(client.call("connect")), "OK");
    EXPECT_EQ(fault_of(client.call("search", "<nonsense/>")), "invalid");
    EXPECT_EQ(code_of(client.call("search")), "OK");
}

TEST(WebSocket, StaysOpenAfterDisconnectForAnotherSession) {
    WebSocketClient client;
    client.call("connect");
    auto const first = client.session();
    EXPECT_EQ(code_of(client.call("disconnect")), "OK");
    EXPECT_EQ(fault_of(client.call("search")), "no_session");
    EXPECT_EQ(code_of(client.call("connect")), "OK");
    EXPECT_NE(client.session(), first);
    client.call("bind", component_ref("navigation"));
    client.call("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000));
    EXPECT_EQ(name_of(client.next_document()), "completed");
}

TEST(WebSocket, ReceivesTheLastNotificationsBeforeDisconnectIsAnswered) {
    WebSocketClient client;
    bind_and_complete(client, 0);
    client.ask("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000));
    client.ask("disconnect");
    EXPECT_EQ(name_of(client.next_document()), "set_parameter_response");
    EXPECT_EQ(name_of(client.next_document()), "completed");
    EXPECT_EQ(name_of(client.next_document()), "disconnect_response");
    EXPECT_EQ(fault_of(client.call("search")), "no_session");
}

TEST(WebSocket, ReceivesTheLastNotificationsOfASessionThatEndsElsewhere) {
    WebSocketClient client;
    bind_and_complete(client, 1);
    HttpClient http;
    http.session = client.session();
    EXPECT_EQ(http.call("disconnect").return_code(), "OK");
    EXPECT_EQ(fault_of(client.call("search")), "no_session");
    EXPECT_EQ(code_of(client.call("connect")), "OK");
}

// The gateway reads from each connection once, then from the next: one busy connection does not delay the others.
TEST(WebSocket, OneThatNeverStopsDoesNotDelayTheOthers) {
    GatewayProcess const gateway{{"--threads", "1"}};
    auto const frame = std::string{"\x81\xFE\x01\x00\0\0\0\0<x/>", 12} + std::string(252, ' ');
    std::string many;
    for (int i = 0; i < 100; ++i) many += frame;
    WebSocketClient talker{gateway};
    {
        std::jthread const listens{[&] {
            try {
                while (true) talker.line().take(4'096);
            } catch (LineEnded const&) {
            }
        }};
        std::jthread const talks{[&](std::stop_token const& enough) {
            while (!enough.stop_requested()) talker.line().send(many);
            talker.line().finish();
        }};
        for (int i = 0; i < 10; ++i) {
            HttpClient other{gateway};
            other.line().set_patience(std::chrono::seconds{3});
            EXPECT_EQ(other.get("/healthz").status, 200);
        }
    }
}

TEST(Resume, GoesOnAfterTheLastSequence) {
    std::string session;
    {
        WebSocketClient client;
        bind_and_complete(client, 3);
        session = client.session();
        client.keep_session();
    }
    WebSocketClient again;
    EXPECT_EQ(resume(again, session, 1), "OK");
    EXPECT_EQ(again.next_document().attribute("sequence").as_uint(), 2u);
    EXPECT_EQ(again.next_document().attribute("sequence").as_uint(), 3u);
    EXPECT_EQ(code_of(again.call("get_parameter", component_ref("navigation"))), "OK") << "the binding is still there";
    EXPECT_EQ(code_of(again.call("disconnect")), "OK");
}

TEST(Resume, OfItsOwnSessionReceivesTheNotificationsAgain) {
    WebSocketClient client;
    bind_and_complete(client, 2);
    EXPECT_EQ(resume(client, client.session(), 0), "OK");
    EXPECT_EQ(client.next_document().attribute("sequence").as_uint(), 1u);
    EXPECT_EQ(client.next_document().attribute("sequence").as_uint(), 2u);
    EXPECT_EQ(code_of(client.call("disconnect")), "OK");
}

std::string return_code(pugi::xml_node answer) { return answer.attribute("return_code").value(); }

TEST(Link, OfAWebSocketThatVanishesIsLostWithItsSession) {
    GatewayProcess gateway{{"--session-timeout", "0.1", "--resume-window", "0.1"}};
    {
        WebSocketClient vanishing{gateway};
        bind_and_complete(vanishing, 0);
        vanishing.keep_session();
    }
    WebSocketClient waiting{gateway};  // its session ends with the connection
    waiting.call("connect");
    while (return_code(waiting.call("bind", component_ref("navigation"))) == "OUT_OF_RESOURCES") {
    }
    EXPECT_EQ(return_code(waiting.call("get_parameter", component_ref("navigation"))), "OK");
}

TEST(Ping, GetsItsPongInOrderWithTheAnswers) {
    WebSocketClient client;
    client.call("connect");
    for (int i = 0; i < 25; ++i) {
        auto const number = std::to_string(i);
        client.send("before " + number, Kind::ping);
        client.ask("search", "", {{"request_id", number}});
        client.send("", Kind::ping);
    }
    for (int i = 0; i < 25; ++i) {
        auto const number = std::to_string(i);
        auto const before = client.next();
        EXPECT_EQ(before.kind, Kind::pong);
        EXPECT_EQ(before.payload, "before " + number);
        EXPECT_THAT(client.next().payload, testing::HasSubstr("request_id=\"" + number + '"'));
        auto const after = client.next();
        EXPECT_EQ(after.kind, Kind::pong);
        EXPECT_EQ(after.payload, "");
    }
}

TEST(Ping, FloodOfAPeerThatReadsNothingIsCutAndTakesNoMemory) {
    GatewayProcess const gateway{{"--write-timeout", "0.5"}};
    WebSocketClient client{gateway};
    std::string pings;
    for (int i = 0; i < 1'000; ++i) pings += std::string{"\x89\xFD\0\0\0\0", 6} + std::string(125, 'p');
    auto const before = gateway.resident_bytes();
    for (int i = 0; i < 1'000; ++i) client.line().send(pings);  // 131 MB; bytes after the cut are dropped
    EXPECT_LT(gateway.resident_bytes(), before + (8 << 20));
    EXPECT_EQ(HttpClient{gateway}.get("/healthz").status, 200);
}

TEST(Ping, GoesToSilentClientsAndClosesThoseThatStaySilent) {
    GatewayProcess gateway{{"--ping-interval", "0.2"}};
    WebSocketClient client{gateway};
    EXPECT_EQ(client.next().kind, Kind::ping);
    client.send("", Kind::pong);
    EXPECT_EQ(client.next().kind, Kind::ping);
    EXPECT_TRUE(client.line().ends());
}

TEST(Close, IsAnsweredWithItsCode) {
    WebSocketClient client;
    client.send(
        "\x0F\xA0"
        "bye",
        Kind::close);  // 4000
    EXPECT_EQ(client.next().close_code(), 4000);
    EXPECT_TRUE(client.line().ends());
}

TEST(Close, With1009ForAMessageThatIsTooLarge) {
    WebSocketClient client;
    auto const document = request("connect");
    client.send(document + std::string((1 << 20) - document.size(), ' '));
    EXPECT_EQ(code_of(client.next_document()), "OK");
    client.send(std::string((1 << 20) + 1, ' '));
    EXPECT_EQ(client.await_close(), 1009);
}

TEST(Close, With1008ForEndlessFragments) {
    WebSocketClient client;
    client.send_raw(0x01, "");
    for (int i = 0; i < 1'024; ++i) client.send_raw(0x00, "");
    EXPECT_EQ(client.await_close(), 1008);
}

TEST(Close, With1008ForAMessageThatDoesNotEnd) {
    GatewayProcess gateway{{"--request-timeout", "0.2"}};
    WebSocketClient client{gateway};
    client.send_raw(0x01, "<connect");
    EXPECT_EQ(client.await_close(), 1008);
}

// With steady traffic, part of the next message has nearly always arrived.
TEST(Close, IsNotCausedBySteadyTraffic) {
    GatewayProcess const gateway{{"--request-timeout", "0.3"}};
    WebSocketClient client{gateway};
    client.call("connect");
    auto const document = request("search") + std::string(200, ' ');
    std::string const frame = std::string{"\x81\xFE", 2} + static_cast<char>(document.size() >> 8) +
                              static_cast<char>(document.size() & 0xFF) + std::string(4, '\0') + document;
    client.line().send(frame.substr(0, 20));
    auto const until = std::chrono::steady_clock::now() + std::chrono::milliseconds{1'200};
    do {
        client.line().send(frame.substr(20) + frame.substr(0, 20));  // the end of a frame and the beginning of the next
        EXPECT_EQ(name_of(client.next_document()), "search_response");
    } while (std::chrono::steady_clock::now() < until && !testing::Test::HasFailure());
    EXPECT_EQ(client.await_close(), 1008) << "the last one does not end";
}

TEST(Close, With1008ForAMessageThatDoesNotEndAmongPings) {
    GatewayProcess const gateway{{"--request-timeout", "0.3"}};
    WebSocketClient client{gateway};
    client.send_raw(0x01, "<connect");
    auto const begun = std::chrono::steady_clock::now();
    auto kind = Kind::pong;
    while (kind == Kind::pong && std::chrono::steady_clock::now() < begun + std::chrono::seconds{10}) {
        client.send("", Kind::ping);
        kind = client.next().kind;
        std::this_thread::sleep_for(std::chrono::milliseconds{40});
    }
    EXPECT_EQ(kind, Kind::close);
}

TEST(Close, With1008ForAFloodOfControlFrames) {
    for (auto const kind : {Kind::ping, Kind::pong}) {
        WebSocketClient client;
        client.call("connect");
        for (int i = 0; i < 50; ++i) client.send("", kind);
        for (int i = 0; i < 50 && kind == Kind::ping; ++i) EXPECT_EQ(client.next().kind, Kind::pong);
        EXPECT_EQ(code_of(client.call("search")), "OK") << "50 within a second are none";
        WebSocketClient greedy;
        greedy.call("connect");
        for (int i = 0; i < 51; ++i) greedy.send("", kind);
        EXPECT_EQ(greedy.await_close(), 1008);
    }
}

TEST(Close, With1008AfterTooManySessions) {
    GatewayProcess gateway{{"--max-sessions", "1"}};
    WebSocketClient first{gateway}, second{gateway};
    first.call("connect");
    EXPECT_EQ(fault_of(second.call("connect")), "too_many");
    EXPECT_EQ(second.await_close(), 1008);
}

TEST(Fragments, AreOneMessage) {
    WebSocketClient client;
    auto const document = request("connect");
    client.send_raw(0x01, document.substr(0, 10));
    client.send("between", Kind::ping);
    EXPECT_EQ(client.next().kind, Kind::pong);
    client.send_raw(0x00, "");
    client.send_raw(0x80, document.substr(10));
    EXPECT_EQ(code_of(client.next_document()), "OK");
}

}  // namespace
}  // namespace rois::test
