// What SIGHUP changes while the gateway runs: its configuration, and that it never ends the gateway. Reading the profiles again
// is in profiles_test.cpp, the certificate in tls_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "kit/profile_folder.hpp"
#include "server/application.hpp"
#include "server/http_client.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

// The gateway with a configuration file.
struct HangUp : testing::Test {
    void put(std::string const& settings) { folder.put("gateway.json", settings); }
    std::string file() const { return folder.name() + "/gateway.json"; }

    kit::ProfileFolder folder;
};

TEST_F(HangUp, ChangesHostsOriginsAndLimits) {
    put(R"({"max_sessions": 100})");
    GatewayProcess gateway{{"--config", file()}};
    HttpClient client{gateway};
    auto const from_desk = [&] { return client.get("/healthz", {{"Origin", "https://desk.example"}}).status; };
    EXPECT_EQ(client.get("http://robots.example/healthz").status, 421);
    EXPECT_EQ(from_desk(), 403);
    client.call("connect");
    put(R"({"max_connections": 1, "hosts": "robots.example", "allowed_origins": "https://desk.example", "threads": 7,
           "media_url": "http://media.example"})");
    gateway.signal(SIGHUP);
    auto const log = gateway.log_with("the settings read again");
    EXPECT_THAT(log, HasSubstr("max_connections is now 1"));
    EXPECT_THAT(log, HasSubstr("a change of threads has no effect before the gateway starts again"));
    EXPECT_EQ(client.get("http://robots.example/healthz").status, 200);
    EXPECT_EQ(client.get("http://media.example/healthz").status, 421) << "a change of media_url has no effect";
    EXPECT_EQ(from_desk(), 200);
    EXPECT_EQ(client.call("search").return_code(), "OK") << "the session goes on";
    EXPECT_THAT(HttpClient{gateway}.get("/metrics").body, HasSubstr("rois_reloads_total{outcome=\"done\"} 1"));
    EXPECT_TRUE(client.line().ends()) << "only one connection may be open";
}

TEST_F(HangUp, ChangesTheLimitsOfTokens) {
    put("{}");
    TokenFile const tokens;
    auto const desk_token = tokens.add("desk", "operator"), hall_token = tokens.add("hall", "operator");
    GatewayProcess gateway{{"--config", file(), "--tokens", tokens.name()}};
    kit::HttpClient desk{with_token(desk_token, gateway)}, same{with_token(desk_token, gateway)};
    kit::HttpClient hall{with_token(hall_token, gateway)};
    desk.call("connect");
    desk.call("bind", component_ref("navigation"));
    put(R"({"max_sessions": 1, "max_sessions_per_address": 1, "max_wrong_tokens": 1})");
    gateway.signal(SIGHUP);
    gateway.log_with("the settings, the tokens read again");
    EXPECT_THAT(same.call("connect").reason(), HasSubstr("this token has 1 sessions open already"));
    EXPECT_THAT(hall.call("connect").reason(), HasSubstr("too many sessions are open"));
    HttpClient stranger{gateway};
    auto const guess = [&] { return stranger.get("/rois/profile", {{"Authorization", "Bearer guess"}}).status; };
    EXPECT_EQ(guess(), 401);
    EXPECT_EQ(guess(), 429);
}

// A query with a condition of so many comparisons, followed by so many spaces.
std::string query_with(int comparisons, std::size_t spaces = 0) {
    auto condition = equal("component_ref", "navigation");
    for (int i = 1; i < comparisons; ++i) condition = either(condition, equal("component_ref", "navigation"));
    return kit::request("search", where(condition)) + std::string(spaces, ' ');
}

TEST_F(HangUp, ChangesTheLimitsOfDocuments) {
    put("{}");
    GatewayProcess gateway{{"--config", file()}};
    HttpClient client{gateway};
    WebSocketClient socket{gateway};
    client.call("connect");
    socket.call("connect");
    auto const by_socket = [&](std::string const& document) {
        socket.send_raw(0x81, document);
        return socket.next_document();
    };
    for (auto const spaces : {0, 40'000}) {  // another thread reads long documents
        EXPECT_EQ(client.post(query_with(20, spaces)).status, 200);
        EXPECT_STREQ(by_socket(query_with(20, spaces)).name(), "search_response");
    }
    put(R"({"max_elements": 20, "max_body": 50000})");
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("the settings read again"), HasSubstr("max_elements is now 20"));
    for (auto const spaces : {0, 40'000}) {
        EXPECT_THAT(client.post(query_with(20, spaces)).reason(), HasSubstr("too many elements"));
        EXPECT_STREQ(by_socket(query_with(20, spaces)).name(), "fault");
        EXPECT_EQ(client.post(query_with(2, spaces)).status, 200);
    }
    EXPECT_EQ(client.post(query_with(2, 50'000)).status, 413);
    socket.send_raw(0x81, query_with(2, 50'000));
    EXPECT_EQ(socket.await_close(), 1009);
}

TEST_F(HangUp, ChangesTheMemoryAndTheFiles) {
    put("{}");
    auto const audit_log = folder.name() + "/audit.log";
    GatewayProcess gateway{{"--config", file(), "--audit-log", audit_log, "--state", folder.name() + "/state"}};
    HttpClient client{gateway};
    EXPECT_THAT(client.get("/metrics").body, HasSubstr("rois_memory_budget_bytes 536870912\n"));
    put(R"({"memory_budget": "1GiB", "audit_log_bytes": 10000, "audit_log_files": 1, "state_bytes": 10000000})");
    gateway.signal(SIGHUP);
    gateway.log_with("the settings read again");
    EXPECT_THAT(client.get("/metrics").body, HasSubstr("rois_memory_budget_bytes 1073741824\n"));
    client.call("connect");
    for (int i = 0; i < 200; ++i) {
        EXPECT_EQ(client.call("bind", component_ref("navigation")).return_code(), "OK");
        EXPECT_EQ(client.call("release", component_ref("navigation")).return_code(), "OK");
    }
    client.call("disconnect");
    client.session.clear();
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder.name() + "/audit.1.log"));
    EXPECT_FALSE(std::filesystem::exists(folder.name() + "/audit.2.log"));
}

TEST_F(HangUp, ChangesNothingIfOneFileIsInvalid) {
    put(R"({"max_sessions": 100})");
    TokenFile const tokens;
    auto const token = tokens.add("desk", "operator");
    GatewayProcess gateway{{"--config", file(), "--tokens", tokens.name(), "--profiles", folder.name()}};
    put(R"({"max_sessions": "many", "hosts": "robots.example"})");
    folder.put("lamp.xml", "<rois");
    gateway.signal(SIGHUP);
    auto const log = gateway.log_with("nothing is changed: the settings");
    EXPECT_THAT(log, HasSubstr("SIGHUP: nothing is changed: the folder of profiles: lamp.xml:1:"));
    EXPECT_THAT(log, HasSubstr("SIGHUP: nothing is changed: the settings: " + file()));
    HttpClient client{gateway};
    EXPECT_EQ(client.get("http://robots.example/healthz").status, 421);
    auto const metrics = client.get("/metrics", {{"Authorization", "Bearer " + token}}).body;
    EXPECT_THAT(metrics, HasSubstr("rois_reloads_total{outcome=\"refused\"} 1"));
    EXPECT_THAT(metrics, HasSubstr("rois_reloads_total{outcome=\"done\"} 0"));
}

TEST_F(HangUp, ReadsNoFileThatIsTooLarge) {
    put("{}");
    GatewayProcess gateway{{"--config", file()}};
    std::filesystem::resize_file(file(), 10'000'001);
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("nothing is changed: the settings"), HasSubstr("has 10000001 bytes: expected at most 10000000"));
}

// Opening it would wait for a program that writes.
TEST_F(HangUp, ReadsNoPipe) {
    put("{}");
    GatewayProcess gateway{{"--config", file()}};
    ASSERT_EQ(::unlink(file().c_str()), 0);
    ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("nothing is changed: the settings"), HasSubstr("this is not a regular file"));
    ASSERT_EQ(::unlink(file().c_str()), 0);
    put("{}");
    gateway.signal(SIGHUP);
    gateway.log_with("the settings read again");
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 0);
}

TEST_F(HangUp, NeverEndsTheGateway) {
    GatewayProcess gateway;
    for (int i = 0; i < 20; ++i) gateway.signal(SIGHUP);
    gateway.log_with("read again");
    EXPECT_EQ(HttpClient{gateway}.get("/healthz").status, 200);
}

// Returns whether the process ignores or handles SIGHUP (proc(5)).
bool survives_hang_up(pid_t process) {
    std::ifstream status{"/proc/" + std::to_string(process) + "/status"};
    for (std::string line; std::getline(status, line);) {
        bool const is_mask = line.starts_with("SigIgn:") || line.starts_with("SigCgt:");
        if (is_mask && (std::stoull(line.substr(line.find('\t')), nullptr, 16) & 1U << (SIGHUP - 1)) != 0) return true;
    }
    return false;
}

TEST_F(HangUp, DoesNotEndAGatewayThatStarts) {
    kit::Pipe errors;
    auto const gateway = kit::start(kit::gateway_program, {"--listen", "127.0.0.1:0"}, {}, {.error = errors.to_write});
    ::close(errors.to_write);
    auto const patience = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    while (!survives_hang_up(gateway) && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
    std::string log;
    {
        std::jthread const others{[&](std::stop_token const& end) {
            for (; !end.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds{1})) ::kill(gateway, SIGHUP);
        }};
        while (log.find("listening on") == log.npos && kit::read_some(errors.to_read, log)) continue;
    }
    ::kill(gateway, SIGTERM);
    while (kit::read_some(errors.to_read, log)) continue;
    ::close(errors.to_read);
    EXPECT_EQ(kit::exit_code(gateway), 0) << log;
}

}  // namespace
}  // namespace rois::test
