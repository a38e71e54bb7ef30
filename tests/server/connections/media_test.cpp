// The limits of the media port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "server/http_client.hpp"

namespace rois::test {

// A connection beyond the limit is not served before another one has closed.
TEST(MediaConnections, AreAsManyAsTheKeyAllows) {
    GatewayProcess gateway{{"--media", "127.0.0.1:0", "--max-media-connections", "1"}};
    auto const address = gateway.media_address();
    auto first = std::make_unique<Line>(address);
    kit::HttpClient second{address};
    second.line().send("GET /unknown HTTP/1.1\r\nHost: localhost\r\n\r\n");
    second.line().set_patience(std::chrono::milliseconds{500});
    EXPECT_THROW(second.read(), LineEnded) << "the first connection is open";
    first.reset();
    second.line().set_patience(address.patience);
    EXPECT_EQ(second.read().status, 404);
}

TEST(MediaConnections, HaveTheLimitsOfRequestsThatTheKeysSet) {
    GatewayProcess gateway{
        {"--media", "127.0.0.1:0", "--max-header", "4096", "--max-header-fields", "16", "--max-target", "1024"}};
    auto const status = [&](std::string const& target, std::string const& lines) {
        return kit::HttpClient{gateway.media_address()}.say("GET " + target + " HTTP/1.1\r\n" + lines + "\r\n").status;
    };
    auto const fields = [](int number) {
        std::string lines = "Host: localhost\r\n";
        for (int i = 1; i < number; ++i) lines += "X: " + std::to_string(i) + "\r\n";
        return lines;
    };
    for (auto const& [size, expected] : {std::pair{4'000, 404}, {4'200, 431}})
        EXPECT_EQ(status("/", fields(1) + "X: " + std::string(size, 'x') + "\r\n"), expected) << size;
    for (auto const& [number, expected] : {std::pair{16, 404}, {17, 431}})
        EXPECT_EQ(status("/", fields(number)), expected) << number;
    for (auto const& [size, expected] : {std::pair{1'024, 404}, {1'025, 414}})
        EXPECT_EQ(status("/" + std::string(size - 1, 'x'), fields(1)), expected) << size;
    EXPECT_EQ(status("/", ""), 400) << "without Host";
}

TEST(MediaConnections, EndWhenARequestDoesNotArriveInTime) {
    GatewayProcess gateway{{"--media", "127.0.0.1:0", "--request-timeout", "0.2"}};
    Line line{gateway.media_address()};
    line.send("GET /unknown HTTP/1.1\r\nHo");
    line.set_patience(std::chrono::seconds{5});  // the default is 30 s
    EXPECT_TRUE(line.ends());
}

}  // namespace rois::test
