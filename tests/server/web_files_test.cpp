// How the files of a console are served: here a small one.
#include "net/web_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rois::net {
namespace {

using testing::HasSubstr;
using testing::Not;

WebFiles const small{{{"index.html", "<html/>"},
                      {"assets/main-1a2b.js", "let a = 1;"},
                      {"assets/main-1a2b.js.gz", "(compressed)"},
                      {"assets/icon-3c4d.svg", "<svg/>"},
                      {"assets/font-5e6f.woff2", "font"},
                      {"assets/strange", "?"}}};

HttpAnswer get(std::string_view path, std::vector<Field> fields = {}) {
    RequestHead head;
    head.fields = std::move(fields);
    head.fields.push_back({"Host", "robot.example:8080"});
    return small.answer(path, head);
}

// Of the answer.
std::string field(HttpAnswer const& answer, std::string const& name) {
    auto const at = answer.fields().find(name + ": ");
    if (at == std::string::npos) return "";
    auto const begin = at + name.size() + 2;
    return answer.fields().substr(begin, answer.fields().find("\r\n", begin) - begin);
}

TEST(WebFile, HasItsType) {
    EXPECT_EQ(get("index.html").content_type, "text/html; charset=utf-8");
    EXPECT_EQ(get("assets/main-1a2b.js").content_type, "text/javascript; charset=utf-8");
    EXPECT_EQ(get("assets/icon-3c4d.svg").content_type, "image/svg+xml");
    EXPECT_EQ(get("assets/font-5e6f.woff2").content_type, "font/woff2");
    EXPECT_EQ(get("assets/strange").content_type, "application/octet-stream");
}

TEST(WebFile, IsKeptForEverWhenItsNameChangesWithIt) {
    EXPECT_EQ(get("assets/main-1a2b.js").cache_control, "public, max-age=31536000, immutable");
    EXPECT_EQ(get("index.html").cache_control, "no-cache");
}

TEST(WebFile, IsSentInTheFormThatIsTaken) {
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

TEST(WebFile, IsNotSentAgainToWhoeverHasThatForm) {
    auto const etag = field(get("index.html"), "ETag");
    auto const again = get("index.html", {{"If-None-Match", etag}});
    EXPECT_EQ(again.status, 304);
    EXPECT_EQ(again.body, "");
    EXPECT_EQ(field(again, "ETag"), etag);
    EXPECT_EQ(again.cache_control, "no-cache");
    auto const script = field(get("assets/main-1a2b.js"), "ETag");
    EXPECT_EQ(get("assets/main-1a2b.js", {{"If-None-Match", script}, {"Accept-Encoding", "gzip"}}).status, 200);
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
        EXPECT_EQ(answer.status, 404) << path;
        EXPECT_EQ(answer.fault.value_or(Fault{}).code, FaultCode::not_found) << path;
    }
    EXPECT_TRUE(WebFiles{{}}.empty());
    EXPECT_FALSE(small.empty());
}

}  // namespace
}  // namespace rois::net
