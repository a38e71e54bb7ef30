// How the files of a console are served.
#include "net/http/web_files.hpp"

#include <gtest/gtest.h>

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
    RequestHead head;
    for (auto const& [name, value] : fields) head.message.insert(name, value);
    head.message.insert("Host", "robot.example:8080");
    return small.answer(path, head);
}

// Returns a header field of the answer.
std::string field(HttpAnswer const& answer, std::string_view name) { return std::string{answer.message[name]}; }

TEST(WebFile, HasItsType) {
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

TEST(WebFile, IsSentInTheFormThatIsTaken) {
    auto const plain = get("assets/main-1a2b.js"), compressed = get("assets/main-1a2b.js", {{"Accept-Encoding", "br, gzip"}});
    EXPECT_EQ(plain.message.body(), "let a = 1;");
    EXPECT_EQ(field(plain, "Content-Encoding"), "");
    EXPECT_EQ(compressed.message.body(), "(compressed)");
    EXPECT_EQ(field(compressed, "Content-Encoding"), "gzip");
    for (auto const& answer : {plain, compressed}) EXPECT_EQ(field(answer, "Vary"), "Accept-Encoding");
    EXPECT_NE(field(plain, "ETag"), field(compressed, "ETag")) << "they are different bytes";
    auto const only_plain = get("assets/icon-3c4d.svg", {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(only_plain.message.body(), "<svg/>") << "where there is no other form";
    EXPECT_EQ(field(only_plain, "Content-Encoding"), "");
}

TEST(WebFile, IsNotSentAgainToWhoeverHasThatForm) {
    auto const etag = field(get("index.html"), "ETag");
    auto const again = get("index.html", {{"If-None-Match", etag}});
    EXPECT_EQ(again.message.result_int(), 304);
    EXPECT_EQ(again.message.body(), "");
    EXPECT_EQ(field(again, "ETag"), etag);
    EXPECT_EQ(field(again, "Cache-Control"), "no-cache");
    auto const script = field(get("assets/main-1a2b.js"), "ETag");
    EXPECT_EQ(get("assets/main-1a2b.js", {{"If-None-Match", script}, {"Accept-Encoding", "gzip"}}).message.result_int(), 200);
}

TEST(WebFile, MayUseNothingFromElsewhere) {
    auto const page = get("index.html");
    EXPECT_EQ(field(page, "Content-Security-Policy"),
              "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' "
              "ws://robot.example:8080 wss://robot.example:8080; font-src 'self'; manifest-src 'self'; base-uri 'none'; "
              "form-action 'none'; frame-ancestors 'none'");
    EXPECT_EQ(field(page, "X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(field(page, "Referrer-Policy"), "no-referrer");
}

TEST(WebFile, IsNamedExactly) {
    for (auto const* path : {"assets/", "assets/main-1a2b.js.gz", "main-1a2b.js", "assets/../index.html", "", "INDEX.HTML"}) {
        auto const answer = get(path);
        EXPECT_EQ(answer.message.result_int(), 404) << path;
        EXPECT_EQ(answer.fault.value_or(Fault{}).code, FaultCode::not_found) << path;
    }
    EXPECT_TRUE(WebFiles{{}}.empty());
    EXPECT_FALSE(small.empty());
}

}  // namespace
}  // namespace rois::net
