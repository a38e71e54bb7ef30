// A gateway with a journal: what clients see when it is killed, and when its disk fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "journal/state_folder.hpp"
#include "kit/application.hpp"
#include "kit/gateway_process.hpp"
#include "kit/http_client.hpp"
#include "kit/websocket_client.hpp"

namespace rois::test {

namespace {

using namespace kit;
using testing::ElementsAre;
using testing::HasSubstr;

Xml list(Command const& command) { return sequence(unit(command)); }

Command const long_speech{.component = "speech_synthesis", .id = "long", .arguments = {speech_text(std::string(2'000, 'a'))}};

Command set_volume(std::string id) {
    return {
        .component = "speech_synthesis", .type = "set_parameter", .id = std::move(id), .arguments = {{"volume", "int", {"50"}}}};
}

// The first notifications of the session, without changes of the profile: "completed long ABORT".
std::vector<std::string> notifications_of(HttpClient& client, std::size_t most) {
    std::vector<std::string> texts;
    unsigned last = 0;
    while (texts.size() < most) {
        auto const reply = client.notifications(last, 5);
        if (!reply.root().first_child()) break;
        for (auto const each : reply.root().children()) {
            last = each.attribute("sequence").as_uint();
            std::string text = each.name();
            if (text == "profile_changed") continue;
            for (auto const* part : {"command_id", "status"})
                if (auto const child = each.child(part)) text += std::string{" "} + child.text().get();
            texts.push_back(text);
        }
    }
    return texts;
}

// A gateway with a journal, whose disk fails as told.
struct GatewayWithJournal : testing::Test {
    ~GatewayWithJournal() override {
        for (auto& client : clients) client->session.clear();
    }

    HttpClient& client() { return *clients.emplace_back(std::make_unique<HttpClient>(gateway->address())); }
    HttpClient& connected() {
        auto& made = client();
        EXPECT_EQ(made.call("connect").return_code(), "OK");
        return made;
    }
    // The same session after a restart.
    HttpClient& again(std::string const& session) {
        auto& made = client();
        made.session = session;
        return made;
    }

    void start(std::vector<std::string> more = {}) {
        auto arguments = folder.arguments();
        arguments.insert(arguments.end(), more.begin(), more.end());
        gateway.emplace(arguments, kit::preloading(ROIS_BINARY_DIR "/tests/libfailing_disk.so", {{"ROIS_DISK", disk()}}));
    }
    void kill() {
        gateway->signal(SIGKILL);
        gateway->wait();
    }
    void restart() {
        kill();
        start();
    }
    std::string disk() const { return folder.name() + "/disk"; }
    void let_disk_be(std::string const& word) const { std::ofstream{disk()} << word; }

    template <class What>
    static bool eventually(What const& what) {
        auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{10};
        while (std::chrono::steady_clock::now() < until) {
            if (what()) return true;
            ::usleep(20'000);
        }
        return false;
    }

    StateFolder const folder;
    std::optional<GatewayProcess> gateway;
    std::vector<std::unique_ptr<HttpClient>> clients;
};

}  // namespace

TEST_F(GatewayWithJournal, LetsClientsGoOnAfterItWasKilled) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    ASSERT_EQ(desk.call("execute", list(long_speech)).return_code(), "OK");
    auto const session = desk.session;
    restart();
    EXPECT_THAT(gateway->log_with("can be resumed"), HasSubstr("1 session of the last start can be resumed"));
    auto& resumed = again(session);
    EXPECT_THAT(notifications_of(resumed, 1), ElementsAre("completed long ABORT"));
    EXPECT_EQ(resumed.call("execute", list(long_speech)).return_code(), "BAD_PARAMETER") << "the id is in use";
    EXPECT_EQ(resumed.call("execute", list({.component = "speech_synthesis", .type = "stop"})).return_code(), "OK")
        << "it is bound";
    EXPECT_EQ(connected().call("bind", component_ref("speech_synthesis")).return_code(), "OUT_OF_RESOURCES");
}

TEST_F(GatewayWithJournal, LetsAWebSocketResumeAfterItWasKilled) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    desk.call("execute", list(long_speech));
    auto const session = desk.session;
    restart();
    WebSocketClient socket{gateway->address()};
    socket.ask("resume", "", {{"session", session}, {"last_sequence", "0"}});
    std::vector<std::string> names;
    for (int i = 0; i < 2; ++i) names.emplace_back(socket.next_document().name());
    EXPECT_THAT(names, ElementsAre("resume_response", "completed"));
    socket.keep_session();
}

TEST_F(GatewayWithJournal, StaysStopped) {
    start();
    EXPECT_EQ(client().get("/rois/stop", {}, "POST").status, 200);
    restart();
    EXPECT_THAT(client().get("/readyz").body, HasSubstr("stopped"));
    client().get("/rois/clear", {}, "POST");
    restart();
    EXPECT_THAT(client().get("/readyz").body, Not(HasSubstr("stopped")));
}

// The stop that was answered does not wait for the step that the disk is storing.
TEST_F(GatewayWithJournal, StaysStoppedThoughTheDiskIsSlow) {
    start();
    let_disk_be("slow");
    WebSocketClient opening{gateway->address()};
    opening.ask("connect");
    EXPECT_EQ(client().get("/rois/stop", {}, "POST").status, 200);
    kill();
    let_disk_be("fine");
    start();
    EXPECT_THAT(client().get("/readyz").body, HasSubstr("stopped"));
}

TEST_F(GatewayWithJournal, RefusesCommandsOnAFullDiskAndRecovers) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    ASSERT_EQ(desk.call("execute", list(long_speech)).return_code(), "OK");
    let_disk_be("full");
    auto next = long_speech;
    next.id = "next";
    auto const refused = desk.call("execute", list(next));
    EXPECT_EQ(refused.return_code(), "OUT_OF_RESOURCES") << refused.body;
    EXPECT_THAT(refused.reason(), HasSubstr("journal"));
    EXPECT_EQ(desk.call("execute", list(set_volume("v"))).return_code(), "OUT_OF_RESOURCES");
    EXPECT_EQ(desk.call("get_profile").return_code(), "OK");
    EXPECT_EQ(desk.call("execute", list({.component = "speech_synthesis", .type = "stop", .id = "s"})).return_code(), "OK");
    EXPECT_EQ(client().get("/rois/stop", {}, "POST").status, 200);
    client().get("/rois/clear", {}, "POST");
    EXPECT_THAT(client().get("/metrics").body, HasSubstr("rois_journal_has_room 0"));
    let_disk_be("fine");
    EXPECT_TRUE(eventually([&] { return desk.call("execute", list(next)).return_code() == "OK"; }));
    auto const session = desk.session;
    restart();
    EXPECT_THAT(notifications_of(again(session), 4),
                ElementsAre("completed long ABORT", "completed s OK", "receive_error", "completed next ABORT"));
}

TEST_F(GatewayWithJournal, DoesNotStartOnAFullDisk) {
    let_disk_be("full");
    auto const ended = run_gateway({"--listen", "127.0.0.1:0", "--state", folder.name()},
                                   kit::preloading(ROIS_BINARY_DIR "/tests/libfailing_disk.so", {{"ROIS_DISK", disk()}}));
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, HasSubstr("cannot be read or written: 'database or disk is full'"));
}

TEST_F(GatewayWithJournal, TakesAtMostStateBytesAndThenRefusesCommands) {
    constexpr std::uintmax_t most = 10'000'000;
    start({"--state-bytes", std::to_string(most)});
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    std::uintmax_t largest = 0;
    int subscriptions = 0;
    std::vector<HttpClient*> subscribers;
    auto const subscribe = [&] {
        if (subscriptions % 4 == 0) subscribers.push_back(&connected());  // each session may have 1 MiB of conditions
        auto const text = std::to_string(++subscriptions) + std::string(200'000, 'x');
        auto const condition = where(either(equal("component_ref", "person_detection"), equal("component_ref", text)));
        auto const answer = subscribers.back()->call("subscribe", text_element("event_type", "person_detected") + condition);
        largest = std::max(largest, folder.bytes());
        return answer.return_code();
    };
    auto next = long_speech;
    auto const speak = [&] {
        next.id = "speech-" + std::to_string(subscriptions);
        return desk.call("execute", list(next));
    };
    while (speak().return_code() == "OK" && subscriptions < 100) subscribe();
    auto const refused = speak();
    EXPECT_EQ(refused.return_code(), "OUT_OF_RESOURCES") << refused.body;
    EXPECT_THAT(refused.reason(), HasSubstr("state_bytes"));
    for (int i = 0; i < 10; ++i) EXPECT_EQ(subscribe(), "OUT_OF_RESOURCES");
    Command const quiet{.component = "speech_synthesis", .type = "stop", .id = "quiet"};
    EXPECT_EQ(desk.call("execute", list(quiet)).return_code(), "OK");
    auto const completed = "<command_id>quiet</command_id>";
    EXPECT_TRUE(eventually([&] { return desk.notifications(0, 0).body.find(completed) != std::string::npos; }));
    EXPECT_LE(largest, most);
    for (auto* const each : subscribers) {
        EXPECT_EQ(each->call("disconnect").return_code(), "OK");
        each->session.clear();
    }
    EXPECT_TRUE(eventually([&] { return speak().return_code() == "OK"; })) << speak().body;
    EXPECT_LE(folder.bytes(), most);
}

// Without a session, SQLite must still move its log into the database. With one, its end must be stored, too.
TEST_F(GatewayWithJournal, EndsInTimeWhileTheDiskIsSlow) {
    for (bool const with_session : {false, true}) {
        start();
        auto& desk = connected();
        desk.call("bind", component_ref("speech_synthesis"));
        if (!with_session) desk.call("disconnect");
        desk.session.clear();
        let_disk_be("slow");
        auto const begun = std::chrono::steady_clock::now();
        gateway->signal(SIGTERM);
        auto const ended = gateway->wait();
        EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds{10});
        EXPECT_EQ(ended.exit_code, 0) << ended.error;
        EXPECT_THAT(ended.error, HasSubstr("the disk does not answer"));
        let_disk_be("fine");
        gateway.reset();
        clients.clear();
    }
}

TEST_F(GatewayWithJournal, EndsInTimeWhileASessionIsBeingStored) {
    start();
    let_disk_be("slow");
    WebSocketClient opening{gateway->address()};
    opening.ask("connect");
    auto& other = client();
    ASSERT_TRUE(eventually([&] { return other.get("/metrics").body.find("rois_sessions 1\n") != std::string::npos; }));
    auto const begun = std::chrono::steady_clock::now();
    gateway->signal(SIGTERM);
    auto const ended = gateway->wait();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds{10});
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    gateway.reset();
}

TEST_F(GatewayWithJournal, StopsWhileTheDiskIsSlow) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    ASSERT_EQ(desk.call("execute", list(long_speech)).return_code(), "OK");
    let_disk_be("slow");
    auto const begun = std::chrono::steady_clock::now();
    EXPECT_EQ(client().get("/rois/stop", {}, "POST").status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds{700}) << "the disk needs 3 s for each step";
    EXPECT_EQ(desk.call("execute", list({.component = "speech_synthesis", .type = "stop", .id = "s"})).return_code(), "OK");
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds{2}) << "after 1 s the disk counts as failed";
    let_disk_be("fine");
    EXPECT_THAT(gateway->log_with("the disk is slow"), HasSubstr("journal: storing took"));
}

TEST_F(GatewayWithJournal, HaltsAndEndsWhenTheDiskDoesNotWrite) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    let_disk_be("broken");
    EXPECT_THROW(desk.call("execute", list(long_speech)), LineEnded) << "it is not acknowledged";
    auto const ended = gateway->wait();
    EXPECT_EQ(ended.exit_code, 70);
    EXPECT_THAT(ended.error, HasSubstr("journal"));
    EXPECT_THAT(ended.error, HasSubstr("all components were halted"));
    gateway.reset();
    let_disk_be("fine");
    start();
    EXPECT_THAT(client().get("/readyz").body, Not(HasSubstr("stopped"))) << "a halt is not a stop of everything";
}

// One call of the system fails, the n-th of its kind: a write ("full 3") or an fdatasync ("broken 3").
struct GatewayWithFailingCall : GatewayWithJournal, testing::WithParamInterface<std::tuple<char const*, int>> {};

TEST_P(GatewayWithFailingCall, CompletesEachAcknowledgedCommandOnce) {
    start();
    auto& desk = connected();
    auto const session = desk.session;
    desk.call("bind", component_ref("speech_synthesis"));
    auto const [word, call] = GetParam();
    let_disk_be(word + std::string{" "} + std::to_string(call));
    std::set<std::string> acknowledged, undecided;  // undecided: without an answer
    auto const send = [&](HttpClient& client, std::string const& id) {
        undecided = {id};
        auto const answer = client.call("execute", list(set_volume(id)));
        EXPECT_THAT(answer.return_code(), testing::AnyOf("OK", "OUT_OF_RESOURCES")) << answer.body;
        if (answer.return_code() == "OK") acknowledged.insert(id);
        undecided.clear();
    };
    try {
        for (int i = 0; i < 12; ++i) send(desk, "c" + std::to_string(i));
        EXPECT_STREQ(word, "full") << "with a file that may not be stored, the gateway ends";
        kill();
    } catch (LineEnded const&) {
        EXPECT_STREQ(word, "broken") << "without one of its writes, the gateway goes on";
        EXPECT_EQ(gateway->wait().exit_code, 70);
    }
    let_disk_be("fine");
    start();
    auto const may_complete = undecided;
    send(again(session), "last");
    std::map<std::string, int> completed;
    for (unsigned last = 0; !completed.contains("last");) {
        auto const reply = again(session).notifications(last, 5);
        for (auto const each : reply.root().children()) {
            last = each.attribute("sequence").as_uint();
            if (auto const id = each.child("command_id")) ++completed[id.text().get()];
        }
        ASSERT_TRUE(reply.root().first_child()) << "no end of the last command";
    }
    for (auto const& id : acknowledged) EXPECT_EQ(completed[id], 1) << id;
    for (auto const& [id, times] : completed) {
        EXPECT_EQ(times, 1) << id;
        EXPECT_TRUE(acknowledged.contains(id) || may_complete.contains(id)) << id << " was refused";
    }
}

INSTANTIATE_TEST_SUITE_P(Each, GatewayWithFailingCall, testing::Combine(testing::Values("full", "broken"), testing::Range(1, 9)),
                         [](auto const& each) {
                             return std::get<0>(each.param) + ("_" + std::to_string(std::get<1>(each.param)));
                         });

TEST_F(GatewayWithJournal, DoesNotStartWithAJournalThatIsNotItsOwn) {
    start();
    auto const second = run_gateway({"--listen", "127.0.0.1:0", "--state", folder.name()});
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_THAT(second.error, HasSubstr("is in use by another gateway"));
    kill();
    gateway.reset();
    std::ofstream{folder.file()} << "something else";
    auto const damaged = run_gateway({"--listen", "127.0.0.1:0", "--state", folder.name()});
    EXPECT_EQ(damaged.exit_code, 2);
    EXPECT_THAT(damaged.error, HasSubstr("is not a journal of rois-gateway"));
    EXPECT_EQ(std::ranges::count(damaged.error, '\n'), 1);
}

// The sub engine has not died. A command that ended there meanwhile has its own result; one that still ran is stopped.
TEST_F(GatewayWithJournal, AsksASubEngineHowItsCommandsHaveEnded) {
    GatewayProcess robot{{"--sim-speed", "4", "--log-level", "debug"}};
    std::ofstream{folder.name() + "/engines.json"} << R"({"engines": [{"name": "robot1", "url": "ws://127.0.0.1:)" << robot.port()
                                                   << R"("}]})";
    std::vector<std::string> const main{"--robots", "none", "--engines", folder.name() + "/engines.json"};
    auto const listed = [&](HttpClient& application, std::string const& ref) {
        return eventually([&] { return application.call("get_profile").body.find(ref) != std::string::npos; });
    };
    start(main);
    auto& desk = connected();
    ASSERT_TRUE(listed(desk, "robot1.speech_synthesis"));
    desk.call("bind", component_ref("robot1.speech_synthesis"));
    desk.call("bind", component_ref("robot1.navigation"));
    Command const speech{.component = "robot1.speech_synthesis",
                         .id = "short",
                         .arguments = {speech_text("Good morning. This takes some seconds.")}};
    Command const drive{.component = "robot1.navigation", .id = "drive", .arguments = {target_position({"9000, 2000, 0"})}};
    ASSERT_EQ(desk.call("execute", list(drive)).return_code(), "OK");
    ASSERT_EQ(desk.call("execute", list(speech)).return_code(), "OK");
    auto const session = desk.session;
    auto const began = "start of speech_synthesis, begins";
    ASSERT_THAT(robot.log_with(began), HasSubstr(began));
    kill();
    EXPECT_TRUE(eventually([&] {
        return HttpClient{robot.address()}.get("/metrics").body.find("rois_commands_completed_total{status=\"OK\"} 1") !=
               std::string::npos;
    }));
    start(main);
    auto& resumed = again(session);
    auto ends = notifications_of(resumed, 2);
    std::ranges::sort(ends);
    EXPECT_THAT(ends, ElementsAre("completed drive ABORT", "completed short OK"));
    ASSERT_TRUE(listed(resumed, "robot1.speech_synthesis"));
    EXPECT_TRUE(eventually([&] {
        return resumed.call("execute", list({.component = "robot1.speech_synthesis", .type = "stop"})).return_code() == "OK";
    })) << "it is bound again";
}

TEST_F(GatewayWithJournal, LeavesNothingToContinueAfterSigterm) {
    start();
    auto& desk = connected();
    desk.call("bind", component_ref("speech_synthesis"));
    desk.session.clear();
    gateway.reset();
    start();
    EXPECT_EQ(connected().call("bind", component_ref("speech_synthesis")).return_code(), "OK");
}

}  // namespace rois::test
