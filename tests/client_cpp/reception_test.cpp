// The example reception in C++: the same day as with the other clients gives the same history.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

// Returns the output of the reception; checks its exit code.
std::string printed(std::string const& url, std::string const& visitors, int exit_code = 0) {
    auto const ended = kit::run(ROIS_BINARY_DIR "/bin/reception", {visitors}, {}, {{"ROIS_URL", url}});
    EXPECT_EQ(ended.exit_code, exit_code) << ended.error;
    return ended.out + ended.error;
}

TEST(TheReceptionInCpp, PrintsTheExpectedHistory) {
    std::string const data = ROIS_SOURCE_DIR "/tests/server/data/";
    GatewayProcess const gateway{{"--floor-plan", data + "watchful_hall.xml", "--scenario", data + "three_visitors.xml",
                                  "--sim-speed", "20", "--seed", "7"}};
    std::ifstream expected{data + "three_visitors.txt"};
    EXPECT_EQ(printed(gateway.url(), "3"), std::string(std::istreambuf_iterator<char>{expected}, {}));
}

TEST(TheReceptionInCpp, ReportsWhyItFailed) {
    auto const& gateway = shared_gateway().url();
    for (std::string const visitors : {"abc", "0", "-3", "2abc", "1.5", "1000000"})
        EXPECT_EQ(printed(gateway, visitors, 1), "reception: VISITORS is a whole number, 1 to 999999, not '" + visitors + "'\n");
    EXPECT_THAT(printed(gateway + "/nowhere", "1", 1), testing::MatchesRegex("reception: bind_any: .*404.*\n"));
    EXPECT_THAT(printed("nowhere", "1", 1), testing::StartsWith("reception: "));
}

TEST(TheReceptionInCpp, HasFewerThan100Lines) {
    std::ifstream source{ROIS_SOURCE_DIR "/client-cpp/examples/reception.cpp"};
    auto const lines = std::count(std::istreambuf_iterator<char>{source}, {}, '\n');
    EXPECT_GT(lines, 0);
    EXPECT_LT(lines, 100);
}

}  // namespace
}  // namespace rois::test
