#include <gtest/gtest.h>

#include <variant>

#include "net/http/http_head.hpp"

namespace rois::net {
namespace {

std::variant<RequestHead, Fault> read(std::string_view text) {
    static std::string kept;
    kept = text;
    RequestHead head;
    if (auto fault = read_head(kept, Settings{}, head)) return *fault;
    return head;
}

FaultCode fault(std::string_view text) {
    auto const result = read(text);
    EXPECT_TRUE(std::holds_alternative<Fault>(result)) << text;
    return std::holds_alternative<Fault>(result) ? std::get<Fault>(result).code : FaultCode::invalid;
}

TEST(HttpHead, HasItsPartsAsViews) {
    auto const result = read(
        "GET /rois/notifications?after=3&wait=&after=4 HTTP/1.1\r\nHost: h\r\nAccept:  text/plain ,TEXT/Event-Stream\t\r\n\r\n");
    auto const& head = std::get<RequestHead>(result);
    EXPECT_EQ(head.method(), "GET");
    EXPECT_EQ(head.path, "/rois/notifications");
    EXPECT_EQ(head.parameter("after"), "3");
    EXPECT_EQ(head.parameter("wait"), "");
    EXPECT_FALSE(head.parameter("aft"));
    EXPECT_TRUE(head.lists("accept", "text/event-stream"));
    EXPECT_FALSE(head.lists("accept", "text"));
    EXPECT_TRUE(head.keep_alive());
}

TEST(HttpHead, MayHaveATargetWithAnAuthority) {
    auto const result = read("GET http://h:80/healthz?x HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_EQ(std::get<RequestHead>(result).path, "/healthz");
    auto const bare = read("GET http://h HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_EQ(std::get<RequestHead>(bare).path, "/");
    auto const other = read("GET http://other:81?x/y HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_EQ(std::get<RequestHead>(other).authority(), "other:81");
    EXPECT_EQ(std::get<RequestHead>(other).path, "/");
    EXPECT_EQ(std::get<RequestHead>(other).query, "x/y");
    EXPECT_EQ(std::get<RequestHead>(read("GET / HTTP/1.1\r\nHost: h\r\n\r\n")).authority(), "h");
}

TEST(HttpHead, MayEndTheConnection) {
    EXPECT_FALSE(std::get<RequestHead>(read("GET / HTTP/1.1\r\nHost: h\r\nConnection: x, Close\r\n\r\n")).keep_alive());
    EXPECT_FALSE(std::get<RequestHead>(read("GET / HTTP/1.0\r\n\r\n")).keep_alive());
}

TEST(HttpHead, IsRejectedIfItIsNotHttp) {
    for (auto const* text :
         {"GET /\r\n\r\n", "GET / HTTP/2.0\r\nHost: h\r\n\r\n", "GET  / HTTP/1.1\r\nHost: h\r\n\r\n",
          "G{T / HTTP/1.1\r\nHost: h\r\n\r\n", "GET rois HTTP/1.1\r\nHost: h\r\n\r\n", "GET /a\tb HTTP/1.1\r\nHost: h\r\n\r\n",
          "GET / HTTP/1.1\nHost: h\r\n\r\n", "GET / HTTP/1.1\r\nHost: h\r\n folded\r\n\r\n",
          "GET / HTTP/1.1\r\nX:\r\n\t\r\nHost: h\r\n\r\n", "GET / HTTP/1.1\r\nHost : h\r\n\r\n",
          "GET / HTTP/1.1\r\nHost: h\r\nNameless\r\n\r\n", "GET / HTTP/1.1\r\nHost: h\r\nX: a\rb\r\n\r\n",
          "CONNECT  HTTP/1.1\r\nHost: h\r\n\r\n", "GET / HTTP/1.1\r\nHost: h\r\n: nameless\r\n\r\n",
          "GET / HTTP/1.1 \r\nHost: h\r\n\r\n", "GET / HTTP/1.1\r\nHost: h\r\nConnection: close; x\r\n\r\n",
          "GET / HTTP/1.1\r\nHost: h\r\nX: a\x7f\r\n\r\n", "GET / HTTP/1.1\r\nHost: h\r\nHost: h\r\n\r\n",
          "GET / HTTP/1.1\r\n\r\n"}) {
        EXPECT_EQ(fault(text), FaultCode::not_well_formed) << text;
    }
}

TEST(HttpHead, HasAtMostOneContentLength) {
    auto const with = [](std::string_view line) { return "POST /rois HTTP/1.1\r\nHost: h\r\n" + std::string{line} + "\r\n\r\n"; };
    EXPECT_EQ(std::get<RequestHead>(read(with("Content-Length: 12"))).content_length, 12u);
    EXPECT_EQ(std::get<RequestHead>(read(with("Content-Length: 18446744073709551615"))).content_length, UINT64_MAX);
    for (auto const* line :
         {"Content-Length: -1", "Content-Length: 1e3", "Content-Length: +1", "Content-Length: 99999999999999999999999",
          "Content-Length:", "Content-Length: 1, 1", "Content-Length: 1\r\nContent-Length: 1"}) {
        EXPECT_EQ(fault(with(line)), FaultCode::not_well_formed) << line;
    }
    EXPECT_EQ(fault(with("Transfer-Encoding: chunked")), FaultCode::length_required);
}

TEST(HttpHead, HasAtMostAHundredFields) {
    auto const with = [](int fields) {
        std::string text = "GET / HTTP/1.1\r\nHost: h\r\n";
        for (int i = 1; i < fields; ++i) text += "X: y\r\n";
        return text + "\r\n";
    };
    EXPECT_TRUE(std::holds_alternative<RequestHead>(read(with(100))));
    EXPECT_EQ(fault(with(101)), FaultCode::header_too_large);
}

TEST(HttpHead, LimitsTheTarget) {
    auto const with = [](std::size_t bytes) { return "GET /" + std::string(bytes - 1, 'x') + " HTTP/1.1\r\nHost: h\r\n\r\n"; };
    EXPECT_TRUE(std::holds_alternative<RequestHead>(read(with(4096))));
    EXPECT_EQ(fault(with(4097)), FaultCode::uri_too_long);
}

TEST(HttpHead, KeepsItsPartsWhenItIsMoved) {
    RequestHead head;
    ASSERT_FALSE(
        read_head("GET http://h/a/long/path/beyond/any/short/string?query HTTP/1.1\r\nHost: h\r\n\r\n", Settings{}, head));
    auto const moved = std::move(head);
    EXPECT_EQ(moved.path, "/a/long/path/beyond/any/short/string");
    EXPECT_EQ(moved.query, "query");
    EXPECT_EQ(moved.target_authority, "h");
}

TEST(HttpHead, ReplacesAnEarlierHead) {
    RequestHead head;
    ASSERT_FALSE(read_head("POST /rois?a HTTP/1.0\r\nHost: h\r\nContent-Length: 5\r\n\r\n", Settings{}, head));
    ASSERT_FALSE(read_head("GET /healthz HTTP/1.1\r\nHost: other\r\n\r\n", Settings{}, head));
    EXPECT_EQ(head.query, "");
    EXPECT_FALSE(head.is_http_1_0());
    EXPECT_EQ(head.content_length, 0u);
    EXPECT_EQ(head.field("Host"), "other");
    EXPECT_EQ(head.message.count("Content-Length"), 0u);
}

TEST(HttpHead, EndsAtAnEmptyLine) {
    std::string const text = "GET / HTTP/1.1\r\nHost: h\r\n\r\nbody";
    for (std::size_t cut = 0, searched = 0; cut < text.size(); ++cut) {
        auto const size = find_head(std::string_view{text}.substr(0, cut), searched);
        EXPECT_EQ(size, cut >= 27 ? 27u : 0u);
    }
}

TEST(HttpHead, MayAcceptGzip) {
    auto const takes = [](std::string const& lines) {
        return std::get<RequestHead>(read("GET / HTTP/1.1\r\nHost: h\r\n" + lines + "\r\n")).takes_gzip();
    };
    auto const encoding = [&](std::string const& value) { return takes("Accept-Encoding: " + value + "\r\n"); };
    for (auto const* yes : {"gzip", "GZIP", "gzip, deflate, br", "br;q=1.0, gzip;q=0.8, *;q=0.1", "*", "identity, *;q=0.5",
                            "gzip; q=0.001", "*;q=0, gzip"})
        EXPECT_TRUE(encoding(yes)) << yes;
    for (auto const* no : {"", "identity", "br", "gzip;q=0", "gzip ; q=0.000", "*;q=0", "gzip;Q=0, *", "xgzip"})
        EXPECT_FALSE(encoding(no)) << no;
    EXPECT_FALSE(takes("")) << "without Accept-Encoding";
    EXPECT_TRUE(takes("Accept-Encoding: br\r\nAccept-Encoding: gzip\r\n"));
}

TEST(HttpHead, ReplacesAHostWithUnusualCharacters) {
    auto const host = [](std::string const& value) {
        auto const text = "GET / HTTP/1.1\r\nHost: " + value + "\r\n\r\n";
        auto const result = read(text);
        return std::string{std::get<RequestHead>(result).host()};
    };
    EXPECT_EQ(host("robot.example:8080"), "robot.example:8080");
    EXPECT_EQ(host("[::1]:8080"), "[::1]:8080");
    EXPECT_EQ(host("$(reboot);"), "localhost");
    EXPECT_EQ(host(""), "localhost");
}

}  // namespace
}  // namespace rois::net
