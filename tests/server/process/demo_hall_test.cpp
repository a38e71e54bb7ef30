// The demo of `./dev run --demo hall`: five gateways in three levels, with the files of docker/hall, but on free ports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "kit/http_client.hpp"
#include "kit/process.hpp"
#include "kit/profile_folder.hpp"
#include "server/application.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::IsSupersetOf;
using Clock = std::chrono::steady_clock;

std::string const folder = ROIS_SOURCE_DIR "/docker/hall/";

std::string text_of(std::string const& file) {
    std::ifstream const stream{folder + file};
    EXPECT_TRUE(stream) << folder + file;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

// The gateways, by their names. They end in the reverse order of their start.
class Demo {
public:
    explicit Demo(std::string visitors) : visitors_{std::move(visitors)} {
        for (auto const* name : {"hall", "robot1", "robot2", "room", "main"}) start(name);
    }
    ~Demo() {
        while (!gateways_.empty()) gateways_.pop_back();
    }
    Demo(Demo const&) = delete;
    Demo& operator=(Demo const&) = delete;

    GatewayProcess& operator[](std::string const& name) { return *gateways_.at(places_.at(name)); }
    void kill(std::string const& name) {
        (*this)[name].signal(SIGKILL);
        (*this)[name].wait();
    }

private:
    void start(std::string const& name) {
        std::vector<std::string> arguments{"--config", folder + name + ".json", "--floor-plan", folder + "hall.xml"};
        if (name == "hall") {
            arguments.insert(arguments.end(), {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/" + visitors_});
        } else {
            auto engines = text_of("engines/" + name + ".json");
            for (auto const& [address, instead] : addresses_)
                if (auto const at = engines.find(address); at != engines.npos) engines.replace(at, address.size(), instead);
            engines_.put(name + ".json", engines);
            arguments.insert(arguments.end(), {"--engines", engines_.name() + "/" + name + ".json"});
        }
        auto const& gateway = *gateways_.emplace_back(std::make_unique<GatewayProcess>(arguments));
        places_[name] = gateways_.size() - 1;
        auto const settings = text_of(name + ".json");
        auto const at = settings.find("127.0.0.1:");
        addresses_[settings.substr(at, settings.find('"', at) - at)] = "127.0.0.1:" + std::to_string(gateway.port());
    }

    std::string const visitors_;
    kit::ProfileFolder engines_;
    std::map<std::string, std::string> addresses_;  // in the files: those of the running gateways
    std::vector<std::unique_ptr<GatewayProcess>> gateways_;
    std::map<std::string, std::size_t> places_;
};

// Returns the position of a robot in the world, in mm.
using Place = std::pair<double, double>;
Place place_of(std::string const& robot, Application& in_hall) {
    auto const answer = in_hall.query("robot_position", where(equal("component_ref", robot + ".system_information")));
    std::istringstream text{answer.values()["position_data"].at(0)};
    double x = 0, y = 0;
    char comma = 0;
    text >> x >> comma >> y;
    return {x, y};
}

double distance(Place const& a, Place const& b) { return std::hypot(a.first - b.first, a.second - b.second); }

// How far a robot drives in half a second, in mm. `desk` sends signs of life.
double driven(std::string const& robot, Application& in_hall, Application& desk) {
    auto const before = place_of(robot, in_hall);
    for (int i = 0; i < 5; ++i) {
        std::this_thread::sleep_for(100ms);
        desk.search();
    }
    return distance(before, place_of(robot, in_hall));
}

// The components of all units.
std::vector<std::string> members(Application& desk) {
    return desk.search(where(both(like("component_ref", "*.*"), like("engine", "*"))));
}

// Waits until they have all told their states.
void await_members(Application& desk) {
    auto const ready = where(both(both(like("component_ref", "*.*"), like("engine", "*")), equal("status", "READY")));
    for (int i = 0; i < 250 && desk.search(ready).size() < 40; ++i) std::this_thread::sleep_for(20ms);
}

TEST(DemoHall, GoesOnWithTheOtherRobotIfTheEngineOfOneIsKilled) {
    Demo demo{"empty_hall.xml"};
    Application desk{Transport::websocket, demo["main"]}, in_hall{Transport::http, demo["hall"]};
    desk.connect();
    in_hall.connect();
    await_members(desk);
    EXPECT_THAT(members(desk), IsSupersetOf({"robot1.navigation", "robot2.navigation", "robot2.speech_synthesis",
                                             "room.person_localization", "room.system_information"}));
    EXPECT_EQ(members(desk).size(), 40u) << "2 robots of 15 components, and a room of 10";
    EXPECT_LT(distance(place_of("room", in_hall), {10'000, 6'000}), 200) << "measured, with noise";
    EXPECT_THAT(desk.search(), IsSupersetOf({"navigation", "person_localization", "room.system_information"}));
    EXPECT_THAT(desk.search(), testing::Not(Contains("robot1.navigation")));

    auto watch = std::async(std::launch::async, [url = demo["main"].url()] {
        return kit::run(ROIS_BINARY_DIR "/bin/rois", {"watch", "switched", "--count", "1", "--for", "60", "--url", url});
    });
    EXPECT_EQ(desk.ask("bind", component_ref("navigation"), {{"switching", "restart"}}).return_code(), "OK");
    auto const there_and_back = target_position({"2000, 6000", "12500, 6000", "2000, 6000", "12500, 6000"});
    auto const go = desk.execute(Command{.component = "navigation", .id = "go", .arguments = {there_and_back}});
    EXPECT_EQ(go.return_code(), "OK") << go.reason();
    double fastest = 0;
    for (int i = 0; i < 10 && fastest < 300; ++i) fastest = std::max(fastest, driven("robot1", in_hall, desk));
    EXPECT_GT(fastest, 300) << "robot1 is nearer, and drives at 900 mm/s";

    demo.kill("robot1");
    auto const killed = Clock::now();
    while (driven("robot1", in_hall, desk) > 200 && Clock::now() < killed + 10s) continue;
    EXPECT_LT(Clock::now() - killed, 4s);
    while (driven("robot2", in_hall, desk) < 300 && Clock::now() < killed + 20s) continue;
    EXPECT_LT(Clock::now() - killed, 6s) << "robot2 has driven for a while";
    EXPECT_THAT(watch.get().out, testing::HasSubstr("from robot1.navigation to robot2.navigation"));
    auto const stop = desk.execute(Command{.component = "navigation", .type = "stop", .id = "stop"});
    EXPECT_EQ(stop.return_code(), "OK") << stop.reason();
    EXPECT_EQ(desk.status_of("go"), "ABORT");
    EXPECT_EQ(desk.status_of("stop"), "OK");
    EXPECT_LT(driven("robot2", in_hall, desk), 200) << "noise";
    desk.bind("speech_synthesis");
    desk.execute(Command{.component = "speech_synthesis", .id = "hello", .arguments = {speech_text("Hello.")}});
    EXPECT_EQ(desk.status_of("hello"), "OK");
    // Only robot1's engine could confirm to the main engine that the robot stands: with SIGTERM it would wait for that.
    desk.disconnect();
    demo.kill("main");
}

// ROIS_DEMO_TIMES: how often; once by default.
TEST(DemoHall, GreetsAVisitorWithTheOtherRobotIfOneIsKilledOnItsWay) {
    auto const* times = std::getenv("ROIS_DEMO_TIMES");
    for (int i = 0; i < (times == nullptr ? 1 : std::atoi(times)) && !HasFailure(); ++i) {
        Demo demo{"one_visitor.xml"};
        Application desk{Transport::http, demo["main"]}, in_hall{Transport::http, demo["hall"]};
        desk.connect();
        in_hall.connect();
        await_members(desk);
        std::map<std::string, Place> starts{{"robot1", place_of("robot1", in_hall)}, {"robot2", place_of("robot2", in_hall)}};
        auto reception = std::async(std::launch::async, [&] {
            return kit::run(ROIS_BINARY_DIR "/bin/rois",
                            {"scenario", ROIS_SOURCE_DIR "/client-cpp/scenarios/reception.xml", "visitors=1", "identifying=3",
                             "listening=5", "--url", demo["main"].url()});
        });
        auto const is_on_its_way = [&](auto const& start) {
            return distance(start.second, place_of(start.first, in_hall)) > 700;
        };
        auto first = starts.end();
        for (int look = 0; look < 300 && first == starts.end(); ++look) {
            std::this_thread::sleep_for(50ms);
            first = std::ranges::find_if(starts, is_on_its_way);
        }
        ASSERT_NE(first, starts.end()) << "no robot approaches the visitor";
        auto const killed = first->first, other = killed == "robot1" ? std::string{"robot2"} : std::string{"robot1"};
        demo.kill(killed);
        auto const then = Clock::now();
        while (driven(killed, in_hall, desk) > 200 && Clock::now() < then + 10s) continue;
        EXPECT_LT(Clock::now() - then, 4s) << killed << " stands still";
        while (!is_on_its_way(*starts.find(other)) && Clock::now() < then + 20s) std::this_thread::sleep_for(50ms);
        EXPECT_LT(Clock::now() - then, 6s) << other << " has driven 0.7 m, which takes a second";
        auto const ended = reception.get();
        EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.error;
        EXPECT_THAT(ended.out, testing::HasSubstr("visitors received: 1"));
        desk.disconnect();
        demo.kill("main");
    }
}

}  // namespace
}  // namespace rois::test
