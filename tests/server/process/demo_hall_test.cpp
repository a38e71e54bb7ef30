// The demo of `./dev run --demo hall`: five gateways in three levels, with the files of docker/hall, but on free ports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

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
    Demo() {
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
            arguments.insert(arguments.end(), {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml"});
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

    kit::ProfileFolder engines_;
    std::map<std::string, std::string> addresses_;  // in the files: those of the running gateways
    std::vector<std::unique_ptr<GatewayProcess>> gateways_;
    std::map<std::string, std::size_t> places_;
};

// Where robot1 is in the world: mm.
std::pair<double, double> place_of_robot1(Application& in_hall) {
    auto const answer = in_hall.query("robot_position", where(equal("component_ref", "robot1.system_information")));
    std::istringstream text{answer.values()["position_data"].at(0)};
    double x = 0, y = 0;
    char comma = 0;
    text >> x >> comma >> y;
    return {x, y};
}

// How far robot1 drives in half a second, in mm. `desk` sends signs of life.
double driven(Application& in_hall, Application& desk) {
    auto const [x, y] = place_of_robot1(in_hall);
    for (int i = 0; i < 5; ++i) {
        std::this_thread::sleep_for(100ms);
        desk.search();
    }
    auto const [later_x, later_y] = place_of_robot1(in_hall);
    return std::hypot(later_x - x, later_y - y);
}

TEST(DemoHall, HoldsTheRobotWhoseEngineIsKilled) {
    Demo demo;
    Application desk{Transport::websocket, demo["main"]}, in_hall{Transport::http, demo["hall"]};
    desk.connect();
    in_hall.connect();
    auto const are_there = IsSupersetOf({"robot1.navigation", "robot2.navigation", "robot2.speech_synthesis",
                                         "room.person_localization", "room.system_information"});
    for (int i = 0; i < 250 && !testing::Value(desk.search(), are_there); ++i) std::this_thread::sleep_for(20ms);
    auto const all = desk.search();
    EXPECT_THAT(all, are_there);
    EXPECT_EQ(all.size(), 40u) << "2 robots of 15 components, and a room of 10";
    EXPECT_THAT(all, testing::Each(testing::ContainsRegex("^(robot1|robot2|room)\\.[a-z_]+$")));

    EXPECT_EQ(desk.bind("robot1.navigation").return_code(), "OK");
    auto const there_and_back = target_position({"2000, 6000", "12500, 6000", "2000, 6000", "12500, 6000"});
    EXPECT_EQ(desk.execute(Command{.component = "robot1.navigation", .id = "go", .arguments = {there_and_back}}).return_code(),
              "OK");
    double fastest = 0;
    for (int i = 0; i < 10 && fastest < 300; ++i) fastest = std::max(fastest, driven(in_hall, desk));
    EXPECT_GT(fastest, 300) << "at 900 mm/s";

    demo.kill("robot1");
    auto const killed = Clock::now();
    auto stood = killed;
    do stood = Clock::now();
    while (driven(in_hall, desk) > 100 && stood < killed + 10s);
    EXPECT_LT(stood - killed, 4s);
    EXPECT_EQ(desk.status_of("go"), "ABORT");
    EXPECT_LT(driven(in_hall, desk), 100) << "noise";
    EXPECT_THAT(desk.search(), Contains("room.person_localization"));
    desk.bind("robot2.speech_synthesis");
    desk.execute(Command{.component = "robot2.speech_synthesis", .id = "hello", .arguments = {speech_text("Hello.")}});
    EXPECT_EQ(desk.status_of("hello"), "OK");
    // Only robot1's engine could confirm to the main engine that the robot stands: with SIGTERM it would wait for that.
    desk.disconnect();
    demo.kill("main");
}

}  // namespace
}  // namespace rois::test
