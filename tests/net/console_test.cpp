// How the files of a console are served.
#include <gtest/gtest.h>

#include "net/answers.hpp"
#include "net/http/documents.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"

namespace rois::net {
namespace {

WebFiles const small{{{"index.html", "<html/>"},
                      {"assets/main-1a2b.js", "let a = 1;"},
                      {"assets/main-1a2b.js.gz", "(compressed)"},
                      {"assets/icon-3c4d.svg", "<svg/>"},
                      {"assets/font-5e6f.woff2", "font"},
                      {"assets/strange", "?"}}};

using Fields = std::vector<std::pair<std::string, std::string>>;

HttpAnswer get(std::string_view path, Fields const& fields = {}) {
    std::string request = "GET / HTTP/1.1\r\nHost: robot.example:8080\r\n";
    for (auto const& [name, value] : fields) request.append(name).append(": ").append(value).append("\r\n");
    RequestHead head;
    EXPECT_FALSE(read_head(request + "\r\n", Settings{}, head));
    return file_answer(small.find(path), head);
}

TEST(WebFile, HasTheMediaTypeOfItsName) {
    EXPECT_EQ(field(get("index.html"), "Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(field(get("assets/main-1a2b.js"), "Content-Type"), "text/javascript; charset=utf-8");
    EXPECT_EQ(field(get("assets/icon-3c4d.svg"), "Content-Type"), "image/svg+xml");
    EXPECT_EQ(field(get("assets/font-5e6f.woff2"), "Content-Type"), "font/woff2");
    EXPECT_EQ(field(get("assets/strange"), "Content-Type"), "application/octet-stream");
}

TEST(WebFile, IsKeptForEverWhenItsNameChangesWithIt) {
    EXPECT_EQ(field(get("assets/main-1a2b.js"), "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(field(get("index.html"), "Cache-Control"), "no-cache");
}

TEST(WebFile, IsSentCompressedIfTheClientAcceptsGzip) {
    auto const plain = get("assets/main-1a2b.js"), compressed = get("assets/main-1a2b.js", {{"Accept-Encoding", "br, gzip"}});
    EXPECT_EQ(plain.body, "let a = 1;");
    EXPECT_EQ(field(plain, "Content-Encoding"), "");
    EXPECT_EQ(compressed.body, "(compressed)");
    EXPECT_EQ(field(compressed, "Content-Encoding"), "gzip");
    for (auto const& answer : {plain, compressed}) EXPECT_EQ(field(answer, "Vary"), "Accept-Encoding");
    EXPECT_NE(field(plain, "ETag"), field(compressed, "ETag")) << "they are different bytes";
    auto const only_plain = get("assets/icon-3c4d.svg", {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(only_plain.body, "<svg/>") << "where there is no other form";
    EXPECT_EQ(field(only_plain, "Content-Encoding"), "");
}

TEST(WebFile, IsNotSentAgainIfTheClientHasIt) {
    auto const etag = field(get("index.html"), "ETag");
    auto const again = get("index.html", {{"If-None-Match", etag}});
    EXPECT_EQ(again.status, http::status::not_modified);
    EXPECT_EQ(again.body, "");
    EXPECT_EQ(field(again, "ETag"), etag);
    EXPECT_EQ(field(again, "Cache-Control"), "no-cache");
    auto const script = field(get("assets/main-1a2b.js"), "ETag");
    EXPECT_EQ(get("assets/main-1a2b.js", {{"If-None-Match", script}, {"Accept-Encoding", "gzip"}}).status, http::status::ok);
}

TEST(WebFile, HasAPolicyAgainstContentOfOtherServers) {
    auto const page = get("index.html");
    EXPECT_EQ(field(page, "Content-Security-Policy"),
              "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' "
              "ws://robot.example:8080 wss://robot.example:8080; font-src 'self'; manifest-src 'self'; base-uri 'none'; "
              "form-action 'none'; frame-ancestors 'none'");
    EXPECT_EQ(field(page, "X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(field(page, "Referrer-Policy"), "no-referrer");
}

TEST(WebFile, IsNotFoundByOtherSpellingsOfItsPath) {
    for (auto const* path : {"assets/", "assets/main-1a2b.js.gz", "main-1a2b.js", "assets/../index.html", "", "INDEX.HTML"}) {
        auto const answer = get(path);
        EXPECT_EQ(answer.status, http::status::not_found) << path;
        EXPECT_EQ(answer.fault.value_or(Fault{}).code, FaultCode::not_found) << path;
    }
    EXPECT_TRUE(WebFiles{{}}.empty());
    EXPECT_FALSE(small.empty());
}

}  // namespace
}  // namespace rois::net
