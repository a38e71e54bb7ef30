// An engine that joins another one by a WebSocket to /rois/engines (docs/engines.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kit/profile_folder.hpp"
#include "server/application.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using namespace std::string_literals;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// An engine without components of its own, which others may join as `robot1`.
class Main {
public:
    GatewayProcess& gateway() { return gateway_; }
    operator GatewayProcess&() { return gateway_; }

private:
    std::string engines() const {
        folder_.put("engines.json", R"({"engines": [{"name": "robot1", "joins": "robot1", "window": 1}]})");
        return folder_.name() + "/engines.json";
    }

    kit::ProfileFolder folder_;
    GatewayProcess gateway_{{"--robots", "none", "--engines", engines()}};
};

std::unique_ptr<GatewayProcess> robot_that_joins(GatewayProcess const& main, std::string const& name = "robot1") {
    return std::make_unique<GatewayProcess>(
        std::vector<std::string>{"--join", main.url(), "--join-as", name, "--sim-speed", "20"});
}

// A client that sends what an engine sends.
struct JoiningClient : kit::WebSocketClient {
    explicit JoiningClient(GatewayProcess const& main) : kit::WebSocketClient{main.address(), "/rois/engines"} {}

    pugi::xml_node join(std::string const& name, std::string const& instance) {
        return call("join", "", {{"name", name}, {"instance", instance}});
    }
};

TEST(Joining, GivesTheMainEngineItsComponents) {
    Main main;
    auto const robot = robot_that_joins(main);
    main.gateway().log_with("present with");
    Application desk{Transport::websocket, main};
    desk.connect();
    EXPECT_THAT(desk.search(), Contains("robot1.speech_synthesis"));
    desk.bind("robot1.speech_synthesis");
    desk.execute(Command{.component = "robot1.speech_synthesis", .id = "hello", .arguments = {speech_text("Hello.")}});
    EXPECT_EQ(desk.status_of("hello"), "OK");
}

// Both have the same floor plan, and frames of the same name.
TEST(Joining, GivesTheMainEngineItsPlaces) {
    Main main;
    auto const robot = robot_that_joins(main);
    main.gateway().log_with("present with");
    Application desk{Transport::websocket, main};
    desk.connect();
    auto const in_the_hall = where(equal("location", "robot1.Reception hall"));
    for (int i = 0; i < 100 && desk.search(in_the_hall).empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds{20});
    EXPECT_THAT(desk.search(in_the_hall), Contains("robot1.navigation"));
    desk.bind("robot1.navigation");
    desk.execute(Command{.component = "robot1.navigation", .id = "go", .arguments = {target_position({"robot1.desk"})}});
    EXPECT_EQ(desk.status_of("go"), "OK");
}

TEST(Joining, IsRefusedForAnUnknownName) {
    Main main;
    auto const robot = robot_that_joins(main, "robot2");
    EXPECT_THAT(robot->log_with("refuses"),
                HasSubstr("unknown name 'robot2': expected the \"joins\" of an entry in the engines file"));
}

TEST(Joining, IsRefusedForANameThatIsInUse) {
    Main main;
    JoiningClient first{main}, second{main};
    EXPECT_STREQ(first.join("robot1", "a").attribute("return_code").value(), "OK");
    EXPECT_STREQ(first.next_document().name(), "connect");
    auto const answer = second.join("robot1", "b");
    EXPECT_STREQ(answer.attribute("return_code").value(), "BAD_PARAMETER");
    EXPECT_STREQ(answer.child("reason").text().get(), "another engine has joined as 'robot1'");
}

TEST(Joining, AgainReplacesTheOlderLink) {
    Main main;
    JoiningClient first{main}, second{main};
    EXPECT_STREQ(first.join("robot1", "a").attribute("window").value(), "1000");
    EXPECT_STREQ(second.join("robot1", "a").attribute("return_code").value(), "OK");
    EXPECT_STREQ(second.next_document().name(), "connect");
    first.next_document();
    EXPECT_THROW(first.next_document(), kit::LineEnded);
}

TEST(Joining, IsRefusedWhenItIsTooOften) {
    Main main;
    std::vector<std::string> reasons;
    for (int i = 0; i < 30; ++i) {
        JoiningClient client{main};
        reasons.emplace_back(client.join("robot1", "a").child("reason").text().get());
    }
    EXPECT_THAT(std::span{reasons}.first(10), Each(IsEmpty()));
    EXPECT_THAT(reasons, Contains("'robot1' joins too often: expected at most once a second"));
}

TEST(Joining, AnswersOtherDocumentsWithAFault) {
    Main main;
    JoiningClient client{main};
    auto const fault = client.call("connect");
    EXPECT_STREQ(fault.name(), "fault");
    EXPECT_STREQ(fault.child("reason").text().get(), "unexpected element 'connect': the first document of an engine is 'join'");
    EXPECT_THROW(client.next_document(), kit::LineEnded);
}

TEST(Joining, IsRefusedForAnInstanceThatIsEmptyOrTooLong) {
    Main main;
    for (auto const& instance : {""s, std::string(129, 'a')}) {
        JoiningClient client{main};
        auto const fault = client.join("robot1", instance);
        EXPECT_STREQ(fault.name(), "fault");
        EXPECT_THAT(fault.child("reason").text().get(), HasSubstr("attribute 'instance' of 'join' has the value '"));
        EXPECT_THAT(fault.child("reason").text().get(), HasSubstr("of at least 1 characters, of at most 128 characters"));
        EXPECT_THROW(client.next_document(), kit::LineEnded);
    }
    JoiningClient client{main};
    EXPECT_STREQ(client.join("robot1", std::string(128, 'a')).attribute("return_code").value(), "OK");
}

TEST(Joining, IsNotAllowedWithoutAnEnginesFile) {
    HttpClient http;
    EXPECT_EQ(kit::shake_hands(http, {}, "/rois/engines").status, 403);
}

TEST(Engines, ThatAreAllAbsentLeaveAProfileWithoutComponents) {
    Main main;
    HttpClient http{main};
    auto const profile = http.get("/rois/profile").body;
    EXPECT_THAT(profile, HasSubstr("<rois:HRIEngineProfile"));
    EXPECT_THAT(profile, Not(HasSubstr("HRIComponent")));
    EXPECT_THAT(profile, Not(HasSubstr("SubProfile")));
}

TEST(Engines, AreListedWithTheirStates) {
    Main main;
    HttpClient http{main};
    auto const list = [&] { return http.get("/rois/engines").body; };
    while (list().find("robot1") == std::string::npos) {
    }
    EXPECT_EQ(list(),
              R"(<engines xmlns="urn:x-rois:psm:xml:message:1"><engine name="robot1" state="absent" link="joins as robot1")"
              R"( components="0" losses="0"/></engines>)");
    auto const robot = robot_that_joins(main);
    main.gateway().log_with("present with");
    while (list().find("round_trip") == std::string::npos || list().find(R"(state="present")") == std::string::npos) {
    }
    EXPECT_THAT(list(), HasSubstr(R"(components="15")"));
    auto const metrics = http.get("/metrics").body;
    EXPECT_THAT(metrics, HasSubstr("rois_engine_present{engine=\"robot1\"} 1\n"));
    EXPECT_THAT(metrics, HasSubstr("rois_engine_components{engine=\"robot1\"} 15\n"));
    EXPECT_THAT(metrics, HasSubstr("rois_engine_round_trip_seconds{engine=\"robot1\"} "));
    robot->signal(SIGKILL);
    robot->wait();
    while (list().find(R"(losses="1")") == std::string::npos) {
    }
    EXPECT_THAT(list(), HasSubstr("<last_error>"));
    EXPECT_EQ(HttpClient{}.get("/rois/engines").body, R"(<engines xmlns="urn:x-rois:psm:xml:message:1"/>)");
}

// An engine above these sub engines: names and URLs. `more`: further keys of each entry.
class Above {
public:
    explicit Above(std::vector<std::pair<std::string, std::string>> const& engines, std::string const& more = {}) {
        std::string entries;
        for (auto const& [name, url] : engines)
            entries += (entries.empty() ? "" : ", ") + R"({"name": ")"s + name + R"(", "url": ")" + url + R"(")" + more + "}";
        folder_.put("engines.json", R"({"engines": [)" + entries + "]}");
        gateway_.emplace(std::vector<std::string>{"--robots", "none", "--engines", folder_.name() + "/engines.json"});
    }
    GatewayProcess& gateway() { return *gateway_; }

private:
    kit::ProfileFolder folder_;
    std::optional<GatewayProcess> gateway_;
};

std::string websocket_url(GatewayProcess const& gateway) { return "ws" + gateway.url().substr(std::string_view{"http"}.size()); }

TEST(Engines, ThatAreReachedOnTwoPathsAreRefused) {
    GatewayProcess hall;
    Above middle{{{"hall", websocket_url(hall)}}};
    middle.gateway().log_with("present with");
    Above top{{{"direct", websocket_url(hall)}, {"via", websocket_url(middle.gateway())}}};
    EXPECT_THAT(top.gateway().log_with("is the same engine, or has it"), HasSubstr("is the same engine, or has it"));
}

TEST(Engines, ThatGiveOneOfTheirEnginesMayBeReachedOnTwoPaths) {
    GatewayProcess hall;
    Above robot1{{{"hall", websocket_url(hall)}}, R"(, "engine": "robot1", "components": ["navigation"])"};
    Above same{{{"hall", websocket_url(hall)}}, R"(, "engine": "robot1", "components": ["speech_synthesis"])"};
    Above top{
        {{"direct", websocket_url(hall)}, {"robot1", websocket_url(robot1.gateway())}, {"same", websocket_url(same.gateway())}}};
    Application desk{Transport::websocket, top.gateway()};
    desk.connect();
    for (auto const* ref : {"direct.navigation", "robot1.navigation", "same.speech_synthesis"}) {
        for (int i = 0; i < 250 && desk.search(where(equal("component_ref", ref))).empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
        EXPECT_THAT(desk.search(), Contains(ref));
    }
}

// The program ignores SIGTERM, as does the process that it has started and whose id it says.
TEST(Programs, EndWithTheGateway) {
    for (auto const end : {SIGTERM, SIGKILL}) {
        kit::ProfileFolder folder;
        folder.put("engines.json",
                   R"({"engines": [{"name": "p", "command": ["sh", "-c", "trap '' TERM; sleep 600 & echo pid $!; wait"]}]})");
        GatewayProcess gateway{{"--robots", "none", "--engines", folder.name() + "/engines.json"}};
        std::string const mark = "program p: pid ";
        auto const log = gateway.log_with(mark);
        auto const pid = std::stoi(log.substr(log.find(mark) + mark.size()));
        EXPECT_EQ(::kill(pid, 0), 0);
        gateway.signal(end);
        gateway.wait();
        for (int i = 0; i < 2'000 && ::kill(pid, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds{5});
        EXPECT_NE(::kill(pid, 0), 0) << "after signal " << end;
    }
}

TEST(Programs, LeaveNoSocketOfTheGatewayOpen) {
    kit::ProfileFolder folder;
    folder.put("engines.json",
               R"({"engines": [{"name": "p", "command": ["sh", "-c", "ls -l /proc/$$/fd; echo done; sleep 600"]}]})");
    GatewayProcess gateway{{"--robots", "none", "--engines", folder.name() + "/engines.json"}};
    EXPECT_THAT(gateway.log_with("program p: done"), Not(HasSubstr("socket:")));
}

TEST(Joining, HappensAgainAfterTheRobotHasRestarted) {
    Main main;
    auto robot = robot_that_joins(main);
    main.gateway().log_with("present with");
    robot->signal(SIGKILL);
    robot->wait();
    robot = robot_that_joins(main);
    Application desk{Transport::websocket, main};
    desk.connect();
    while (desk.bind("robot1.speech_synthesis").return_code() != "OK") {
    }
}

}  // namespace
}  // namespace rois::test
