// Tokens that are revoked or expire: what they have begun ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <string>

#include "kit/received_media.hpp"
#include "server/application.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {

namespace {

using testing::HasSubstr;

struct EndedTokens : testing::Test {
    TokenFile file;

    static std::string bind(kit::HttpClient& client, std::string const& ref) {
        return client.call("bind", component_ref(ref)).return_code();
    }
};

}  // namespace

TEST_F(EndedTokens, EndTheirSessionsWithinASecondOfBeingRevoked) {
    auto const token = file.add("desk", "operator"), other = file.add("other", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    kit::HttpClient colleague{with_token(other, gateway)};
    colleague.call("connect");
    kit::WebSocketClient desk{with_token(token, gateway)};
    desk.call("connect");
    EXPECT_STREQ(desk.call("bind", component_ref("navigation")).attribute("return_code").value(), "OK");
    kit::HttpClient over_http{with_token(token, gateway)}, stream{with_token(token, gateway)};
    over_http.call("connect");
    stream.session = over_http.session;
    EXPECT_EQ(stream.get("/rois/notifications", {{"Accept", "text/event-stream"}}).status, 200);

    EXPECT_EQ(file.run({"revoke", "desk"}).exit_code, 0);
    auto const revoked_at = std::chrono::steady_clock::now();
    EXPECT_EQ(desk.await_close(), 1008);
    EXPECT_TRUE(stream.line().ends());
    EXPECT_LT(std::chrono::steady_clock::now() - revoked_at, std::chrono::seconds{1});
    EXPECT_EQ(over_http.call("get_profile").status, 401);
    over_http.session.clear();
    stream.session.clear();
    EXPECT_EQ(bind(colleague, "navigation"), "OK") << "the component is free, and other sessions go on";
}

TEST_F(EndedTokens, TellTheirWebSocketsHowTheirCommandsHaveEnded) {
    std::map<std::string, std::string> tokens;
    for (auto const* name : {"a", "b", "c"}) tokens[name] = file.add(name, "operator");
    GatewayProcess const gateway{file.of_gateway()};
    for (auto const& [name, token] : tokens) {  // the connection may notice it before the session ends, or after
        kit::WebSocketClient desk{with_token(token, gateway)};
        desk.call("connect");
        desk.call("bind", component_ref("navigation"));
        Command const drive{.component = "navigation",
                            .type = "start",
                            .id = "drive",
                            .arguments = {{"target_position", "string[]", {"9000, 1000"}}}};
        EXPECT_STREQ(desk.call("execute", sequence(unit(drive))).attribute("return_code").value(), "OK");
        EXPECT_EQ(file.run({"revoke", name}).exit_code, 0);
        EXPECT_STREQ(desk.next_document().name(), "completed");
        EXPECT_EQ(desk.await_close(), 1008);
        desk.keep_session();
    }
}

TEST_F(EndedTokens, EndTheirStreamsWithinASecondOfBeingRevoked) {
    auto const token = file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway({"--media", "127.0.0.1:0"})};
    kit::HttpClient desk{with_token(token, gateway)};
    desk.call("connect");
    EXPECT_EQ(bind(desk, "audio_streaming"), "OK");
    Command const connecting{.component = "audio_streaming", .type = "connect_stream", .id = "stream"};
    EXPECT_EQ(desk.call("execute", sequence(unit(connecting))).return_code(), "OK");
    EXPECT_THAT(desk.notifications(0).body, HasSubstr("completed"));
    Document const result{desk.call("get_command_result", text_element("command_id", "stream")).body};
    auto const url = result.values().at("transport_parameters").front();
    MediaReceiver receiving{url};
    EXPECT_THAT(receiving.head(), testing::StartsWith("HTTP/1.1 200 "));

    EXPECT_EQ(file.run({"revoke", "desk"}).exit_code, 0);
    auto const revoked_at = std::chrono::steady_clock::now();
    receiving.line().rest();
    EXPECT_LT(std::chrono::steady_clock::now() - revoked_at, std::chrono::seconds{1});
    EXPECT_THAT(MediaReceiver{url}.head(), testing::StartsWith("HTTP/1.1 404 "));
    desk.session.clear();
}

TEST_F(EndedTokens, EndTheirSessionsWithinASecondOfExpiring) {
    auto const ends = std::chrono::ceil<std::chrono::seconds>(std::chrono::system_clock::now() + std::chrono::seconds{2});
    auto const seconds = std::to_string(std::chrono::system_clock::to_time_t(ends));
    auto const when = run_shell("printf %s $(date -u -d @" + seconds + " +%FT%TZ)").out;
    auto const token = file.add("desk", "operator", {"--expires", when});
    GatewayProcess const gateway{file.of_gateway()};
    kit::WebSocketClient desk{with_token(token, gateway)};
    desk.call("connect");
    desk.keep_session();
    EXPECT_EQ(desk.await_close(), 1008);
    EXPECT_GE(std::chrono::system_clock::now(), ends);
    EXPECT_LT(std::chrono::system_clock::now(), ends + std::chrono::seconds{1});
    EXPECT_EQ(kit::HttpClient{with_token(token, gateway)}.get("/rois/profile").status, 401);
}

TEST_F(EndedTokens, ClearNoStopWithTheRestOfARequestThatBeganBefore) {
    auto const token = file.add("desk", "operator"), other = file.add("other", "operator");
    {
        GatewayProcess const gateway{file.of_gateway({"--audit-log", file.folder() + "/audit.log"})};
        auto const post = [](std::string const& path, std::string const& of, std::string const& length) {
            return "POST " + path + " HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + of +
                   "\r\nContent-Length: " + length + "\r\n\r\n";
        };
        HttpClient colleague{gateway}, late{gateway};
        EXPECT_EQ(colleague.say(post("/rois/stop", other, "0")).status, 200);
        late.line().send(post("/rois/clear", token, "5") + "ab");
        kit::WebSocketClient desk{with_token(token, gateway)};
        desk.call("connect");
        desk.keep_session();

        EXPECT_EQ(file.run({"revoke", "desk"}).exit_code, 0);
        EXPECT_EQ(desk.await_close(), 1008);
        late.line().send("cde");
        EXPECT_EQ(late.read("POST").status, 401);
        EXPECT_EQ(late.say(post("/rois/clear", other, "0")).status, 200) << "the connection goes on";
    }
    EXPECT_THAT(run_shell("cat " + file.folder() + "/audit.log").out,
                HasSubstr(R"("what":"refused","address":"127.0.0.1","operation":"/rois/clear","outcome":"unauthorized")"));
}

}  // namespace rois::test
