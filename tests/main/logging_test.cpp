// The lines of the log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include "main/logging.hpp"

namespace rois::test {
namespace {

using testing::MatchesRegex;

constexpr auto words = "a \"quoted\"\nline";

// Returns the lines that a log with these settings writes to standard error.
std::string logged(LogFormat format, LogLevel level) {
    testing::internal::CaptureStderr();
    {
        auto const queue = set_up_logging(format, level);
        LogFlush const flush;
        spdlog::debug("a detail");
        spdlog::info("{}", words);
        spdlog::error("trouble");
    }
    return testing::internal::GetCapturedStderr();
}

TEST(Logging, WritesJsonObjects) {
    EXPECT_THAT(logged(LogFormat::json, LogLevel::info),
                MatchesRegex(R"(\{"time":"2[^"]*Z","level":"info","message":"a \\"quoted\\"\\nline"\}
\{"time":"2[^"]*Z","level":"error","message":"trouble"\}
)"));
}

TEST(Logging, WritesTimeLevelAndText) {
    EXPECT_THAT(logged(LogFormat::text, LogLevel::error), MatchesRegex("2[^ ]*Z error trouble\n"));
}

TEST(Logging, OmitsLinesBelowItsLevel) {
    EXPECT_THAT(logged(LogFormat::text, LogLevel::debug), testing::HasSubstr(" debug a detail\n"));
    EXPECT_THAT(logged(LogFormat::text, LogLevel::info), testing::Not(testing::HasSubstr("a detail")));
}

}  // namespace
}  // namespace rois::test
