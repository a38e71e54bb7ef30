// The console, as a gateway that contains it serves it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "files/files.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Console : testing::Test {
    void SetUp() override {
        if (files::console().empty()) GTEST_SKIP() << "this gateway was built without it";
    }
    // Returns the files that the page loads.
    std::set<std::string> assets() {
        std::set<std::string> found;
        auto const page = client.get("/").body;
        std::regex const link{"(?:src|href)=\"([^\"]*)\""};
        for (std::sregex_iterator at{page.begin(), page.end(), link}, end; at != end; ++at) found.insert((*at)[1]);
        return found;
    }

    HttpClient client;
};

TEST_F(Console, IsServedAtTheRoot) {
    auto const page = client.get("/");
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.header("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(page.header("Cache-Control"), "no-cache");
    auto const policy = page.header("Content-Security-Policy");
    EXPECT_THAT(policy, StartsWith("default-src 'none'; script-src 'self'; style-src 'self';"));
    EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
    EXPECT_EQ(page.header("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(page.header("Referrer-Policy"), "no-referrer");
    EXPECT_THAT(page.body, Not(HasSubstr("<style"))) << "nothing inline, which the policy forbids";
    EXPECT_FALSE(std::regex_search(page.body, std::regex{"<script[^>]*>[^<]| style=| on[a-z]+="}));
    EXPECT_THAT(page.body, Not(HasSubstr("http"))) << "nothing from elsewhere";
}

TEST_F(Console, LoadsAssetsThatMayBeCachedForEver) {
    auto const found = assets();
    EXPECT_FALSE(found.empty());
    for (auto const& asset : found) {
        ASSERT_THAT(asset, StartsWith("/")) << "the page may be anywhere";
        if (!asset.starts_with("/assets/")) continue;
        auto const plain = client.get(asset);
        EXPECT_EQ(plain.status, 200) << asset;
        EXPECT_EQ(plain.header("Cache-Control"), "public, max-age=31536000, immutable") << asset;
        EXPECT_EQ(plain.header("Content-Encoding"), "") << asset;
        auto const compressed = client.get(asset, {{"Accept-Encoding", "gzip"}});
        if (compressed.header("Content-Encoding") == "gzip") {
            EXPECT_LT(compressed.body.size(), plain.body.size()) << asset;
            EXPECT_THAT(compressed.body, StartsWith("\x1f\x8b")) << asset;
            EXPECT_NE(compressed.header("ETag"), plain.header("ETag"));
        }
        EXPECT_EQ(client.get(asset, {{"If-None-Match", plain.header("ETag")}}).status, 304) << asset;
        auto const head = client.get(asset, {{"Accept-Encoding", "gzip"}}, "HEAD");
        EXPECT_EQ(head.header("Content-Length"), std::to_string(compressed.body.size())) << asset;
        EXPECT_EQ(head.body, "");
    }
}

TEST_F(Console, AnswersOtherPathsWithNotFound) {
    for (auto const* path :
         {"/assets/", "/assets/nothing.js", "/assets/../index.html", "/assets/%2e%2e/index.html", "/index.html"}) {
        auto const reply = client.get(path);
        EXPECT_EQ(reply.status, 404) << path;
        EXPECT_EQ(reply.fault(), "not_found") << path;
    }
    EXPECT_EQ(client.get("/assets/nothing.js", {}, "PUT").status, 405);
}

// The size of all files in their sent form.
TEST_F(Console, TakesLessThan300KiBCompressed) {
    constexpr std::size_t most = 300 * 1024;
    std::size_t sent = 0;
    for (auto const& [name, bytes] : files::console()) {
        if (name.ends_with(".gz")) continue;
        auto const compressed = files::console().find(name + ".gz");
        sent += compressed == files::console().end() ? bytes.size() : compressed->second.size();
    }
    RecordProperty("bytes", std::to_string(sent));
    EXPECT_LT(sent, most);
}

TEST(PlainPage, IsThereWithoutJavaScript) {
    HttpClient client;
    auto const plain = client.get("/plain");
    EXPECT_EQ(plain.status, 200);
    EXPECT_THAT(plain.body, Not(HasSubstr("<script")));
    if (files::console().empty()) {
        EXPECT_EQ(client.get("/").body, plain.body);
    }
}

}  // namespace
}  // namespace rois::test
