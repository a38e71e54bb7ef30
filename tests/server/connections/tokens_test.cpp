// Tokens: who may connect, and what each holder sees and may do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/application.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {

namespace {

using testing::HasSubstr;
using testing::Not;

struct Tokens : testing::Test {
    TokenFile file;

    // What a gateway answers to an operation: its fault, or else its return code.
    static std::string outcome(kit::HttpClient& client, std::string const& operation, Xml const& children = {},
                               Attributes const& attributes = {}) {
        auto const reply = client.call(operation, children, attributes);
        return reply.fault().empty() ? reply.return_code() : reply.fault();
    }
    static std::string bind(kit::HttpClient& client, std::string const& ref) {
        return outcome(client, "bind", component_ref(ref));
    }
};

std::string post(std::string const& path, std::string const& more = {}) {
    return "POST " + path + " HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nContent-Length: 0\r\n" + more +
           "\r\n";
}

}  // namespace

TEST_F(Tokens, AreNeededForEverythingButHealthAndTheFilesOfTheConsole) {
    file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    HttpClient stranger{gateway};
    EXPECT_EQ(stranger.get("/healthz").status, 200);
    EXPECT_EQ(stranger.get("/readyz").status, 200);
    EXPECT_EQ(stranger.get("/").status, 200);
    for (auto const* path : {"/rois", "/rois/profile", "/rois/profile/navigation", "/rois/schemas", "/rois/map", "/rois/engines",
                             "/rois/notifications", "/metrics", "/plain", "/nothing"}) {
        auto const reply = stranger.get(path);
        EXPECT_EQ(reply.status, 401) << path;
        EXPECT_EQ(reply.fault(), "unauthorized") << path;
        EXPECT_EQ(reply.header("WWW-Authenticate"), "Bearer") << path;
        EXPECT_THAT(reply.body, Not(HasSubstr("navigation"))) << path;
    }
    for (auto const* path : {"/rois", "/rois/stop", "/rois/clear"}) EXPECT_EQ(stranger.say(post(path)).status, 401) << path;
    EXPECT_EQ(kit::shake_hands(stranger).status, 401);
    EXPECT_EQ(kit::shake_hands(stranger, {}, "/rois/engines").status, 401);
}

TEST_F(Tokens, AreRefusedInTheSameWayForEveryReason) {
    auto const revoked = file.add("gone", "operator"), valid = file.add("desk", "operator");
    EXPECT_EQ(file.run({"revoke", "gone"}).exit_code, 0);
    GatewayProcess const gateway{file.of_gateway()};
    HttpClient stranger{gateway};
    auto const missing = stranger.get("/rois/profile").body;
    auto const two = "Bearer " + valid + "\r\nAuthorization: Bearer " + valid;
    for (auto const& field :
         {"Bearer " + revoked, "Bearer " + valid + "x", "Basic " + valid, std::string{"Bearer"}, valid, two}) {
        auto const reply = stranger.get("/rois/profile", {{"Authorization", field}});
        EXPECT_EQ(reply.status, 401) << field;
        EXPECT_EQ(reply.body, missing) << field;
    }
    EXPECT_EQ(stranger.get("/rois/profile", {{"authorization", "bearer " + valid}}).status, 200);
    EXPECT_EQ(stranger.get("/rois/profile?token=" + valid).status, 401) << "never in a URL";
}

TEST_F(Tokens, MayBeASecondSubprotocolBecauseBrowsersSendNoHeader) {
    auto const token = file.add("console", "observer");
    GatewayProcess const gateway{file.of_gateway()};
    auto const with = [&](std::string const& subprotocols) {
        HttpClient browser{gateway};
        return kit::shake_hands(browser, {{"Sec-WebSocket-Protocol", subprotocols}});
    };
    auto const accepted = with("rois.xml.v1, rois.bearer." + token);
    EXPECT_EQ(accepted.status, 101);
    EXPECT_EQ(accepted.header("Sec-WebSocket-Protocol"), "rois.xml.v1");
    auto const encoded = run_shell("printf %s '" + token + "' | base64 -w0 | tr '+/' '-_' | tr -d =").out;
    EXPECT_EQ(with("rois.xml.v1, rois.bearer." + encoded).status, 101);
    EXPECT_EQ(with("rois.xml.v1, rois.bearer.x" + token).status, 401);
    EXPECT_EQ(with("rois.xml.v1, rois.bearer." + token + ", rois.bearer." + token).status, 401);
}

TEST_F(Tokens, HaveRoles) {
    auto const observer = file.add("watcher", "observer"), service = file.add("desk", "operator");
    auto const engine = file.add("main", "engine"), administrator = file.add("chief", "administrator");
    GatewayProcess const gateway{file.of_gateway()};
    auto const as_engine = Attributes{{"role", "engine"}};

    kit::HttpClient watcher{with_token(observer, gateway)};
    EXPECT_EQ(outcome(watcher, "connect", {}, as_engine), "not_allowed");
    EXPECT_EQ(outcome(watcher, "connect"), "OK");
    EXPECT_EQ(outcome(watcher, "get_profile"), "OK");
    EXPECT_EQ(outcome(watcher, "search"), "OK");
    EXPECT_EQ(outcome(watcher, "query", text_element("query_type", "engine_status")), "OK");
    EXPECT_EQ(outcome(watcher, "subscribe", text_element("event_type", "person_detected")), "OK");
    auto const refused = watcher.call("bind", component_ref("navigation"));
    EXPECT_EQ(refused.status, 403);
    EXPECT_EQ(refused.reason(), "the token has the role observer: expected at least operator");
    EXPECT_EQ(outcome(watcher, "bind_any"), "not_allowed");
    EXPECT_EQ(outcome(watcher, "release", component_ref("navigation")), "not_allowed");
    auto const stop = "RoIS-Session: " + watcher.session + "\r\nAuthorization: Bearer " + observer + "\r\n";
    EXPECT_EQ(watcher.say(post("/rois/stop", stop)).status, 403);
    EXPECT_EQ(watcher.say(post("/rois/clear", stop)).status, 403);
    EXPECT_EQ(watcher.get("/metrics").status, 200);

    for (auto const& token : {service, engine, administrator}) {
        kit::HttpClient client{with_token(token, gateway)};
        EXPECT_EQ(outcome(client, "connect", {}, token == service ? Attributes{} : as_engine), "OK");
        EXPECT_EQ(bind(client, "navigation"), "OK");
        EXPECT_EQ(client.say(post("/rois/stop", "Authorization: Bearer " + token + "\r\n")).status, 200);
        EXPECT_EQ(client.say(post("/rois/clear", "Authorization: Bearer " + token + "\r\n")).status, 200);
    }
    kit::HttpClient desk{with_token(service, gateway)};
    EXPECT_EQ(outcome(desk, "connect", {}, as_engine), "not_allowed");
    EXPECT_EQ(kit::shake_hands(desk, {}, "/rois/engines").status, 403);
}

TEST_F(Tokens, HideComponentsFromTheirHolders) {
    auto const token = file.add("speaker", "operator", {"--components", "speech_*", "--components", "system_information"});
    auto const all = file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    kit::HttpClient desk{with_token(all, gateway)}, speaker{with_token(token, gateway)};
    desk.call("connect");
    EXPECT_EQ(bind(desk, "navigation"), "OK");

    EXPECT_EQ(outcome(speaker, "connect"), "OK");
    for (auto const* path : {"/rois/profile", "/plain", "/metrics"}) {
        auto const seen = speaker.get(path).body;
        EXPECT_THAT(seen, Not(HasSubstr("navigation"))) << path;
        EXPECT_THAT(desk.get(path).body, HasSubstr("navigation")) << path;
    }
    EXPECT_THAT(speaker.get("/rois/profile").body, HasSubstr("speech_synthesis"));
    EXPECT_THAT(desk.get("/rois/map").body, HasSubstr("<robot "));
    EXPECT_THAT(speaker.get("/rois/map").body, AllOf(HasSubstr("<place "), Not(HasSubstr("<robot "))));
    auto const metrics = speaker.get("/metrics").body;
    EXPECT_THAT(metrics, AllOf(HasSubstr("rois_components 3\n"), Not(HasSubstr("session=\"1\""))));
    EXPECT_EQ(speaker.say(post("/rois/stop", "Authorization: Bearer " + token + "\r\n")).status, 200);
    EXPECT_EQ(speaker.say(post("/rois/clear", "Authorization: Bearer " + token + "\r\n")).status, 403)
        << "others may need the stop";
    EXPECT_EQ(desk.say(post("/rois/clear", "Authorization: Bearer " + all + "\r\n")).status, 200);
    EXPECT_EQ(speaker.get("/rois/profile/speech_synthesis").status, 200);
    EXPECT_EQ(speaker.get("/rois/profile/navigation").status, 404);
    EXPECT_THAT(speaker.call("get_profile").body, AllOf(HasSubstr("speech_synthesis"), Not(HasSubstr("navigation"))));
    EXPECT_THAT(speaker.call("search").body, AllOf(HasSubstr("speech_synthesis"), Not(HasSubstr("navigation"))));

    auto const of_unknown = [&](std::string const& operation, std::string const& ref) {
        auto reason = speaker.call(operation, component_ref(ref)).reason();
        return reason.replace(reason.find(ref), ref.size(), "X");
    };
    for (auto const* operation : {"bind", "release", "get_parameter"}) {
        EXPECT_EQ(outcome(speaker, operation, component_ref("navigation")), "BAD_PARAMETER") << operation;
        EXPECT_EQ(of_unknown(operation, "navigation"), of_unknown(operation, "nothing_at_all")) << operation;
    }
    EXPECT_EQ(bind(speaker, "speech_synthesis"), "OK");
    EXPECT_EQ(outcome(speaker, "subscribe", text_element("event_type", "person_detected")), "UNSUPPORTED");
    EXPECT_EQ(speaker.call("subscribe", text_element("event_type", "person_detected")).reason(),
              "no component has the event 'person_detected'");
    EXPECT_EQ(outcome(speaker, "query", text_element("query_type", "navigation_status")),
              outcome(speaker, "query", text_element("query_type", "nothing_at_all")));
}

TEST_F(Tokens, LimitWhatTheirHoldersCommand) {
    auto const token = file.add("speaker", "operator", {"--commands", "speech_synthesis"});
    GatewayProcess const gateway{file.of_gateway()};
    kit::HttpClient speaker{with_token(token, gateway)};
    speaker.call("connect");
    EXPECT_EQ(bind(speaker, "speech_synthesis"), "OK");
    auto const refused = speaker.call("bind", component_ref("navigation"));
    EXPECT_EQ(refused.status, 403);
    EXPECT_EQ(refused.reason(), "the token may see this component, but not command it");
    EXPECT_EQ(outcome(speaker, "subscribe", text_element("event_type", "person_detected")), "OK");
    EXPECT_THAT(speaker.call("bind_any").text("component_ref"), "") << "it has bound the only one";
    EXPECT_THAT(speaker.call("bind_any").body, HasSubstr("\"speech_synthesis\""));
}

TEST_F(Tokens, OwnTheirSessions) {
    auto const one = file.add("one", "operator"), two = file.add("two", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    kit::HttpClient owner{with_token(one, gateway)}, thief{with_token(two, gateway)};
    owner.call("connect");
    thief.session = owner.session;
    auto const stolen = thief.call("get_profile");
    EXPECT_EQ(stolen.fault(), "no_session");
    EXPECT_EQ(thief.notifications(0, 0).fault(), "no_session");
    kit::WebSocketClient link{with_token(two, gateway)};
    auto const resumed = link.call("resume", {}, {{"session", owner.session}, {"last_sequence", "0"}});
    EXPECT_STREQ(resumed.name(), "fault");
    thief.session = "made-up";
    EXPECT_EQ(thief.call("get_profile").body, stolen.body) << "the same text as for an unknown session";
    thief.session.clear();
    EXPECT_EQ(outcome(owner, "get_profile"), "OK");
    kit::WebSocketClient own{with_token(one, gateway)};
    EXPECT_STREQ(own.call("resume", {}, {{"session", owner.session}, {"last_sequence", "0"}}).attribute("return_code").value(),
                 "OK");
}

TEST_F(Tokens, AreNeededToLearnWhyTheGatewayIsNotReady) {
    auto const token = file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    kit::HttpClient desk{with_token(token, gateway)};
    EXPECT_EQ(desk.say(post("/rois/stop", "Authorization: Bearer " + token + "\r\n")).status, 200);
    auto const known = desk.get("/readyz"), unknown = HttpClient{gateway}.get("/readyz");
    EXPECT_EQ(known.status, 503);
    EXPECT_THAT(known.body, HasSubstr("stopped"));
    EXPECT_EQ(unknown.status, 503);
    EXPECT_EQ(unknown.body, "not ready\n");
}

TEST_F(Tokens, WithoutRoomForASessionAreInTheAuditLog) {
    auto const token = file.add("desk", "operator"), other = file.add("other", "operator");
    auto const log = file.folder() + "/audit.log";
    {
        GatewayProcess const gateway{
            file.of_gateway({"--audit-log", log, "--max-sessions-per-address", "1", "--max-sessions", "1"})};
        kit::HttpClient first{with_token(token, gateway)}, second{with_token(token, gateway)}, third{with_token(other, gateway)};
        EXPECT_EQ(first.call("connect").return_code(), "OK");
        first.call("bind", component_ref("navigation"));  // else it gives way
        EXPECT_EQ(second.call("connect").fault(), "too_many") << "of this token";
        EXPECT_EQ(third.call("connect").fault(), "too_many") << "at all";
    }
    auto const text = run_shell("cat " + log).out;
    EXPECT_THAT(text,
                HasSubstr(R"("what":"refused","token":"desk","address":"127.0.0.1","operation":"connect","outcome":"too_many")"));
    EXPECT_THAT(text, HasSubstr(R"("what":"refused","token":"other","operation":"connect","outcome":"too_many")"));
}

TEST_F(Tokens, OfEnginesThatMayNotJoinAreInTheAuditLog) {
    auto const token = file.add("robot", "engine");
    auto const log = file.folder() + "/audit.log";
    {
        GatewayProcess const gateway{file.of_gateway({"--audit-log", log})};
        kit::HttpClient robot{with_token(token, gateway)};
        auto const refused = robot.get("/rois/engines", {{"Upgrade", "websocket"},
                                                         {"Connection", "Upgrade"},
                                                         {"Sec-WebSocket-Version", "13"},
                                                         {"Sec-WebSocket-Key", "AAAAAAAAAAAAAAAAAAAAAA=="},
                                                         {"Sec-WebSocket-Protocol", "rois.xml.v1"}});
        EXPECT_EQ(refused.status, 403);
        EXPECT_THAT(refused.reason(), HasSubstr("joining needs the key engines"));
    }
    EXPECT_THAT(run_shell("cat " + log).out, HasSubstr(R"("what":"refused","token":"robot")"));
}

TEST_F(Tokens, ThatAreWrongGet429AfterTenInAMinute) {
    auto const token = file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway()};
    HttpClient stranger{gateway};
    auto const guess = [&] { return stranger.get("/rois/profile", {{"Authorization", "Bearer guess"}}).status; };
    for (int i = 0; i < 10; ++i) EXPECT_EQ(guess(), 401) << i;
    EXPECT_EQ(guess(), 429);
    EXPECT_EQ(stranger.get("/rois/profile", {{"Authorization", "Bearer guess"}}).header("Retry-After"), "60");
    EXPECT_EQ(stranger.get("/rois/profile").status, 401) << "without a token";
    EXPECT_EQ(stranger.get("/rois/profile", {{"Authorization", "Bearer " + token}}).status, 200)
        << "another client behind this address must be able to stop the robot";
    EXPECT_EQ(guess(), 429);
}

TEST_F(Tokens, ThatAreWrongGet429AfterAsManyAsTheKeyAllows) {
    file.add("desk", "operator");
    GatewayProcess const gateway{file.of_gateway({"--max-wrong-tokens", "3"})};
    HttpClient stranger{gateway};
    auto const guess = [&] { return stranger.get("/rois/profile", {{"Authorization", "Bearer guess"}}).status; };
    for (int i = 0; i < 3; ++i) EXPECT_EQ(guess(), 401) << i;
    EXPECT_EQ(guess(), 429);
}

TEST_F(Tokens, LetOnlyAdministratorsTakeOver) {
    auto const service = file.add("desk", "operator"), administrator = file.add("chief", "administrator");
    GatewayProcess const gateway{file.of_gateway({"--audit-log", file.folder() + "/audit.log"})};
    kit::HttpClient desk{with_token(service, gateway)}, chief{with_token(administrator, gateway)};
    desk.call("connect");
    chief.call("connect");
    EXPECT_EQ(bind(desk, "navigation"), "OK");
    auto const refused = desk.call("bind", component_ref("speech_synthesis"), {{"take_over", "true"}});
    EXPECT_EQ(refused.status, 403);
    EXPECT_EQ(refused.reason(), "the token has the role operator: expected at least administrator");
    EXPECT_EQ(outcome(chief, "bind", component_ref("navigation")), "OUT_OF_RESOURCES");
    EXPECT_EQ(outcome(chief, "bind", component_ref("navigation"), {{"take_over", "true"}}), "OK");
    EXPECT_THAT(desk.notifications(0).body, HasSubstr("USER_DEFINED_ERROR"));
}

TEST_F(Tokens, AreNamedInTheAuditLogAndNeverShown) {
    auto const service = file.add("desk", "operator"), administrator = file.add("chief", "administrator");
    auto const log = file.folder() + "/audit.log";
    std::string session;
    {
        GatewayProcess const gateway{file.of_gateway({"--audit-log", log})};
        kit::HttpClient desk{with_token(service, gateway)}, chief{with_token(administrator, gateway)};
        desk.call("connect");
        session = desk.session;
        desk.call("bind", component_ref("navigation"));
        Command const drive{.component = "navigation",
                            .type = "start",
                            .id = "my-secret-id",
                            .arguments = {{"target_position", "string[]", {"desk"}}}};
        EXPECT_EQ(outcome(desk, "execute", sequence(unit(drive))), "OK");
        chief.call("connect");
        chief.call("bind", component_ref("navigation"), {{"take_over", "true"}});
        desk.call("bind", component_ref("navigation"));
        desk.call("bind", component_ref("<script>"));
        desk.call("bind", component_ref("move"), {{"take_over", "true"}});
        chief.say(post("/rois/stop", "Authorization: Bearer " + administrator + "\r\n"));
        chief.say(post("/rois/clear", "Authorization: Bearer " + administrator + "\r\n"));
        auto const own_session = std::exchange(chief.session, session);
        EXPECT_EQ(chief.call("release", component_ref("move")).fault(), "no_session");
        EXPECT_EQ(chief.notifications(0, 0).fault(), "no_session");
        chief.session = own_session;
        std::string const stopped = desk.call("stop_everything").root().attribute("stop").value();
        EXPECT_EQ(chief.call("clear_stop", {}, {{"stop", stopped}}).return_code(), "OK") << "the stop of another session";
        chief.call("stop_everything");
        for (auto* one : {&desk, &chief}) one->call("clear_stop", {}, {{"stop", "0"}});
        HttpClient stranger{gateway};
        for (int i = 0; i < 30; ++i) stranger.get("/rois/profile/secret", {{"Authorization", "Bearer guess"}});
    }
    auto const text = run_shell("cat " + log).out;
    auto const without_times = run_shell("sed 's/\"time\":\"[^\"]*\",//' " + log).out;
    for (
        auto const* line :
        {R"({"what":"connected","token":"desk","session":1,"address":"127.0.0.1"})",
         R"({"what":"bound","token":"desk","session":1,"component":"navigation"})",
         R"({"what":"command begun","token":"desk","session":1,"component":"navigation","operation":"start"})",
         R"({"what":"took over","token":"chief","session":2,"component":"navigation"})",
         R"({"what":"command ended","token":"desk","session":1,"component":"navigation","operation":"start","outcome":"ABORT"})",
         R"({"what":"released","token":"desk","session":1,"component":"navigation"})",
         R"({"what":"bound","token":"chief","session":2,"component":"navigation"})",
         R"({"what":"refused","token":"desk","session":1,"component":"navigation","operation":"bind","outcome":"OUT_OF_RESOURCES"})",
         R"({"what":"refused","token":"desk","session":1,"operation":"bind","outcome":"BAD_PARAMETER"})",
         R"({"what":"refused","token":"desk","address":"127.0.0.1","operation":"bind","outcome":"not_allowed"})",
         R"({"what":"refused","token":"chief","operation":"release","outcome":"no_session"})",
         R"({"what":"refused","token":"chief","operation":"/rois/notifications","outcome":"no_session"})",
         R"({"what":"stopped everything","token":"chief","address":"127.0.0.1"})",
         R"({"what":"cleared the stop","token":"chief","address":"127.0.0.1"})",
         R"({"what":"stopped everything","token":"desk","session":1})",
         R"({"what":"stopped everything","token":"chief","session":2})",
         R"({"what":"cleared its own stop","token":"desk","session":1})",
         R"({"what":"cleared the stop","token":"chief","session":2})",
         R"({"what":"refused","address":"127.0.0.1","operation":"/rois/profile/","outcome":"unauthorized"})"})
        EXPECT_THAT(without_times, HasSubstr(std::string{line} + "\n"));
    EXPECT_THAT(text, Not(HasSubstr(R"("cleared its own stop","token":"chief")")));
    for (auto const& secret : {service, administrator, session, std::string{"guess"}, std::string{"my-secret-id"},
                               std::string{"script"}, std::string{"secret"}})
        EXPECT_THAT(text, Not(HasSubstr(secret)));
    EXPECT_LT(std::ranges::count(text, '\n'), 60) << "refusals do not flood it";
    EXPECT_EQ(run_shell("stat -c %a " + log).out, "600\n");
}

TEST_F(Tokens, HaveTheirAuditLogAlsoOfCommandsThatOutliveTheirSession) {
    auto const token = file.add("desk", "operator");
    auto const log = file.folder() + "/audit.log";
    {
        GatewayProcess const gateway{
            file.of_gateway({"--audit-log", log, "--on-session-end", "continue", "--sim-speed", "0.01"})};
        kit::HttpClient desk{with_token(token, gateway)};
        desk.call("connect");
        desk.call("bind", component_ref("speech_synthesis"));
        Command const say{
            .component = "speech_synthesis", .type = "start", .id = {}, .arguments = {{"speech_text", "string", {"Welcome."}}}};
        EXPECT_EQ(outcome(desk, "execute", sequence(unit(say))), "OK");
        desk.call("disconnect");
    }
    auto const without_times = run_shell("sed 's/\"time\":\"[^\"]*\",//' " + log).out;
    auto const of_speech = std::string{R"("session":1,"component":"speech_synthesis")"};
    EXPECT_THAT(without_times, HasSubstr(R"({"what":"released","token":"desk",)" + of_speech + "}\n"));
    EXPECT_THAT(without_times,
                HasSubstr(R"({"what":"command ended",)" + of_speech + R"(,"operation":"start","outcome":"ABORT"})" + "\n"));
}

TEST_F(Tokens, CountAndNameTheirSessionsAlsoAfterARestart) {
    auto const token = file.add("desk", "operator");
    auto const log = file.folder() + "/audit.log";
    auto const arguments =
        file.of_gateway({"--state", file.folder() + "/state", "--audit-log", log, "--max-sessions-per-address", "2"});
    std::string session;
    {
        GatewayProcess gateway{arguments};
        kit::HttpClient one{with_token(token, gateway)}, two{with_token(token, gateway)};
        for (auto* client : {&one, &two}) {
            EXPECT_EQ(outcome(*client, "connect"), "OK");
            session = std::exchange(client->session, "");
        }
        gateway.signal(SIGKILL);
        gateway.wait();
    }
    {
        GatewayProcess const gateway{arguments};
        kit::HttpClient third{with_token(token, gateway)}, second{with_token(token, gateway)};
        EXPECT_EQ(third.call("connect").status, 429);
        second.session = session;
        EXPECT_EQ(bind(second, "navigation"), "OK");
    }
    EXPECT_THAT(run_shell("cat " + log).out, HasSubstr(R"("what":"bound","token":"desk","session":2,"component":"navigation"})"));
}

// A bind and a release write two lines of about 100 bytes: 300 of each make more than three files of 10,000 bytes.
TEST_F(Tokens, FillAsManyFilesOfTheAuditLogAsTheKeysAllow) {
    auto const log = file.folder() + "/audit.log";
    auto const token = file.add("desk", "operator");
    {
        GatewayProcess const gateway{
            file.of_gateway({"--audit-log", log, "--audit-log-bytes", "10000", "--audit-log-files", "2"})};
        kit::HttpClient desk{with_token(token, gateway)};
        desk.call("connect");
        for (int i = 0; i < 300; ++i) {
            EXPECT_EQ(bind(desk, "navigation"), "OK");
            EXPECT_EQ(outcome(desk, "release", component_ref("navigation")), "OK");
        }
    }
    auto const size_of = [&](std::string const& name) {
        std::error_code missing;
        auto const size = std::filesystem::file_size(file.folder() + "/" + name, missing);
        return missing ? 0 : size;
    };
    for (auto const* name : {"audit.log", "audit.1.log", "audit.2.log"}) {
        EXPECT_GT(size_of(name), 0U) << name;
        EXPECT_LE(size_of(name), 10'000U) << name;
    }
    EXPECT_GT(size_of("audit.1.log"), 9'000U);
    EXPECT_FALSE(std::filesystem::exists(file.folder() + "/audit.3.log"));
}

TEST_F(Tokens, CountTheSessionsOfTheirHolders) {
    auto const one = file.add("one", "operator"), two = file.add("two", "operator");
    GatewayProcess const gateway{file.of_gateway({"--max-sessions-per-address", "2"})};
    std::vector<std::unique_ptr<kit::HttpClient>> clients;
    auto const connect = [&](std::string const& token) {
        auto& client = clients.emplace_back(std::make_unique<kit::HttpClient>(with_token(token, gateway)));
        return client->call("connect");
    };
    EXPECT_EQ(connect(one).status, 200);
    EXPECT_EQ(connect(one).status, 200);
    auto const third = connect(one);
    EXPECT_EQ(third.status, 429);
    EXPECT_THAT(third.reason(), HasSubstr("this token has 2 sessions open already"));
    EXPECT_EQ(connect(two).status, 200);
}

}  // namespace rois::test
