// The example that uses only section 7.7, against the real gateway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "kit/gateway_process.hpp"

namespace rois::test {
namespace {

constexpr auto source_file = ROIS_SOURCE_DIR "/client-cpp/examples/greeting.cpp";

TEST(AProgramOfTheCppPsm, GreetsAVisitor) {
    std::string const visitor = ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml";
    kit::GatewayProcess const gateway{{"--scenario", visitor, "--sim-speed", "20", "--seed", "7"}};
    auto const ended = kit::run(ROIS_BINARY_DIR "/bin/greeting", {}, {}, {{"ROIS_URL", gateway.url()}});
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_EQ(ended.out, "greeted a visitor\n");
}

TEST(AProgramOfTheCppPsm, HasAtMost80LinesAndIncludesOnlyHeadersOfThePsm) {
    std::ifstream source{source_file};
    int lines = 0;
    for (std::string line; std::getline(source, line); ++lines) {
        if (!line.starts_with("#include \"")) continue;
        EXPECT_THAT(line, testing::StartsWith("#include \"RoIS_"));
    }
    EXPECT_GT(lines, 0);
    EXPECT_LE(lines, 80);
}

}  // namespace
}  // namespace rois::test
