// Exceptions that the gateway survives, and the rate at which it ends.
#include <gtest/gtest.h>

#include <stdexcept>

#include "gateway/process/troubles.hpp"

namespace rois {

using namespace std::chrono_literals;

namespace {

struct ATrouble : testing::Test {
    Telemetry telemetry;
    int given_up = 0;
    Troubles troubles{telemetry, [this] { ++given_up; }};
    Steady now{1h};

    void after(std::chrono::milliseconds time, Troubles::Where where = Troubles::Where::tick) {
        now += time;
        troubles.report(where, std::make_exception_ptr(std::runtime_error{"no memory"}), now);
    }
};

}  // namespace

TEST_F(ATrouble, IsCounted) {
    after(0ms);
    after(0ms, Troubles::Where::wake);
    auto const text = telemetry.text({}, {});
    EXPECT_NE(text.find("rois_internal_exceptions_total{where=\"tick\"} 1"), std::string::npos);
    EXPECT_NE(text.find("rois_internal_exceptions_total{where=\"wake\"} 1"), std::string::npos);
}

TEST_F(ATrouble, IsTooMuchAtTheThirdIncidentWithinASecond) {
    after(0ms);
    after(500ms);
    EXPECT_EQ(given_up, 0);
    after(500ms);
    EXPECT_EQ(given_up, 1);
    after(200ms);
    EXPECT_EQ(given_up, 1) << "once";
}

TEST_F(ATrouble, IsNotTooMuchInMoreThanASecond) {
    for (int i = 0; i < 100; ++i) after(501ms);
    EXPECT_EQ(given_up, 0);
}

TEST_F(ATrouble, IsOneIncidentForATenthOfASecond) {
    for (int i = 0; i < 20; ++i) after(9ms);
    EXPECT_EQ(given_up, 0) << "from 9 to 180 ms: two incidents";
    for (int i = 0; i < 5; ++i) after(9ms);
    EXPECT_EQ(given_up, 1) << "this rate of exceptions is too high";
}

TEST_F(ATrouble, OfAConnectionIsItsOwn) {
    for (int i = 0; i < 100; ++i) after(150ms, Troubles::Where::connection);
    EXPECT_EQ(given_up, 0);
}

}  // namespace rois
