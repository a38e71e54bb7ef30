// Connections that are too slow are closed at a deadline. Others do not notice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

TEST(Deadline, EndsAnUnfinishedHeader) {
    GatewayProcess gateway{{"--request-timeout", "0.2"}};
    HttpClient client{gateway};
    auto const reply = client.say("GET /healthz HTTP/1.1\r\nHost: localhost\r\nX");
    EXPECT_EQ(reply.status, 408);
    EXPECT_EQ(reply.fault(), "too_slow");
    EXPECT_TRUE(client.line().ends());
}

TEST(Deadline, EndsAnUnfinishedBody) {
    GatewayProcess gateway{{"--request-timeout", "0.2"}};
    HttpClient client{gateway};
    EXPECT_EQ(
        client.say("POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nContent-Length: 10\r\n\r\n<conn").status,
        408);
    EXPECT_TRUE(client.line().ends());
}

TEST(Deadline, EndsASilentConnection) {
    GatewayProcess gateway{{"--idle-timeout", "0.2"}};
    HttpClient silent{gateway}, once{gateway};
    EXPECT_EQ(once.get("/healthz").status, 200);
    EXPECT_TRUE(silent.line().ends());
    EXPECT_TRUE(once.line().ends());
}

TEST(Deadline, IsNotRenewedByEmptyLines) {
    GatewayProcess const gateway{{"--idle-timeout", "0.3", "--request-timeout", "0.3"}};
    for (auto const& lines : {std::vector<std::string>{"\r\n"}, {"\r", "\n"}, {"\r", "\n\r"}}) {
        HttpClient client{gateway};
        EXPECT_EQ(client.get("/healthz").status, 200);
        for (std::size_t i = 0; i < 30; ++i) {
            client.line().send(lines[i % lines.size()]);
            std::this_thread::sleep_for(std::chrono::milliseconds{50});
        }
        client.line().set_patience(std::chrono::milliseconds{100});
        EXPECT_NO_THROW(client.line().rest()) << "it is open still";
    }
}

// Waits until the gateway has cut a connection. With the default of write_timeout, that takes 30 s.
void expect_a_cut_in_time(HttpClient& observer) {
    auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    auto const is_cut = [&] { return observer.get("/metrics").body.find("rois_connections_cut_total 1") != std::string::npos; };
    bool cut = is_cut();
    while (!cut && std::chrono::steady_clock::now() < until) cut = is_cut();
    EXPECT_TRUE(cut) << "within write_timeout";
}

TEST(Deadline, EndsAConnectionThatNeverReads) {
    GatewayProcess gateway{{"--write-timeout", "0.5", "--threads", "1"}};
    HttpClient greedy{gateway}, other{gateway};
    stuff(greedy.line(), "GET /rois/schemas/rois.xsd HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(other.get("/healthz").status, 200);
    expect_a_cut_in_time(other);
}

TEST(Deadline, EndsAWebSocketThatNeverReads) {
    GatewayProcess gateway{{"--write-timeout", "0.5", "--threads", "1"}};
    WebSocketClient greedy{gateway};
    HttpClient other{gateway};
    greedy.call("connect");
    std::string const payload = request("get_profile", kit::characters(std::string(200, ' ')));
    std::string frame{'\x81', '\xFE', static_cast<char>(payload.size() >> 8), static_cast<char>(payload.size())};
    frame += std::string(4, '\0') + payload;
    stuff(greedy.line(), frame);
    EXPECT_EQ(other.get("/healthz").status, 200);
    expect_a_cut_in_time(other);
}

TEST(Limit, OfConnectionsMakesMoreOfThemWait) {
    GatewayProcess gateway{{"--max-connections", "1"}};
    auto first = std::make_unique<HttpClient>(gateway);
    EXPECT_EQ(first->get("/healthz").status, 200);
    HttpClient second{gateway};
    second.line().send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(first->get("/healthz").status, 200);
    first.reset();
    EXPECT_EQ(second.read().status, 200);
}

TEST(Limit, OfConnectionsHoldsOverAllThreads) {
    GatewayProcess gateway{{"--max-connections", "3", "--threads", "3"}};
    std::vector<std::unique_ptr<HttpClient>> inside;
    for (int i = 0; i < 3; ++i) {
        inside.push_back(std::make_unique<HttpClient>(gateway));
        EXPECT_EQ(inside.back()->get("/healthz").status, 200);
        inside.back()->line().send("GET /metrics HTTP/1.1\r\nHost: localhost\r\n");  // so it is not idle
    }
    std::vector<std::unique_ptr<HttpClient>> outside;
    for (int i = 0; i < 8; ++i) {
        outside.push_back(std::make_unique<HttpClient>(gateway));
        outside.back()->line().send("GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    }
    inside.front()->line().send("\r\n");
    EXPECT_THAT(inside.front()->read().body, testing::HasSubstr("rois_connections{kind=\"http\"} 3\n"));
    inside.clear();
    for (auto const& client : outside) EXPECT_EQ(client->read().status, 200);
}

TEST(Limit, OfConnectionsIsKeptByCuttingTheOneThatHasBeenIdleForLongest) {
    GatewayProcess gateway{{"--max-connections", "2", "--threads", "1"}};
    HttpClient oldest{gateway}, newer{gateway};
    for (auto* client : {&oldest, &newer}) EXPECT_EQ(client->get("/healthz").status, 200);
    HttpClient late{gateway};
    EXPECT_EQ(late.get("/healthz").status, 200);
    EXPECT_EQ(newer.get("/healthz").status, 200);
    EXPECT_THROW(oldest.get("/healthz"), std::exception);
}

}  // namespace
}  // namespace rois::test
