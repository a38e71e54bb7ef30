// The reception as an application in C++: the same day as with every client, the same history.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

std::string printed_by(std::string const& command) {
    std::string text;
    auto* const pipe = popen(command.c_str(), "r");
    for (int c = std::getc(pipe); c != EOF; c = std::getc(pipe)) text.push_back(static_cast<char>(c));
    EXPECT_EQ(pclose(pipe), 0) << text;
    return text;
}

TEST(TheReceptionInCpp, TellsTheHistoryOfTheDay) {
    std::string const data = ROIS_SOURCE_DIR "/tests/server/data/";
    GatewayProcess const gateway{{"--floor-plan", data + "watchful_hall.xml", "--scenario", data + "three_visitors.xml",
                                  "--sim-speed", "20", "--seed", "7"}};
    std::ifstream expected{data + "three_visitors.txt"};
    EXPECT_EQ(printed_by("ROIS_URL=" + gateway.url() + " " ROIS_BINARY_DIR "/bin/reception 3"),
              std::string(std::istreambuf_iterator<char>{expected}, {}));
}

TEST(TheReceptionInCpp, IsShort) {
    std::ifstream source{ROIS_SOURCE_DIR "/client-cpp/examples/reception.cpp"};
    auto const lines = std::count(std::istreambuf_iterator<char>{source}, {}, '\n');
    EXPECT_GT(lines, 0);
    EXPECT_LT(lines, 100);
}

}  // namespace
}  // namespace rois::test
