// The `main` of the test programs. A virtual machine may stand still for seconds; then motion leases and links end as they
// should, and tests of them fail. If all tests that failed did so while the machine stood still, they run once more, in a new
// process.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto still = 300ms;
constexpr auto second_run = "ROIS_TEST_SECOND_RUN";

// Measures how long the machine stands still during each test: that long, a thread that sleeps wakes up late.
class Watch : public testing::EmptyTestEventListener {
public:
    std::string const& to_repeat() const { return to_repeat_; }  // a filter of GoogleTest; empty: nothing
    bool has_failed() const { return has_failed_; }              // without such a reason

private:
    void OnTestStart(testing::TestInfo const&) override { latest_ = Clock::duration{}; }
    void OnTestEnd(testing::TestInfo const& test) override {
        if (!test.result()->Failed()) return;
        auto const late = std::chrono::duration_cast<std::chrono::milliseconds>(latest_.load());
        if (late < still) {
            has_failed_ = true;
            return;
        }
        std::string const name = std::string{test.test_suite_name()} + "." + test.name();
        std::cerr << "The machine stood still for " << late.count() << " ms during " << name << "\n";
        to_repeat_ += (to_repeat_.empty() ? "" : ":") + name;
    }

    void watch(std::stop_token const& stop) {
        for (auto before = Clock::now(); !stop.stop_requested();) {
            std::this_thread::sleep_for(20ms);
            auto const now = Clock::now();
            latest_ = std::max(latest_.load(), now - before);
            before = now;
        }
    }

    std::string to_repeat_;
    bool has_failed_ = false;
    std::atomic<Clock::duration> latest_{};
    std::jthread thread_{[this](std::stop_token const& stop) { watch(stop); }};
};

}  // namespace

int main(int count, char** arguments) {
    testing::InitGoogleTest(&count, arguments);
    auto* const watch = new Watch;  // GoogleTest deletes it
    testing::UnitTest::GetInstance()->listeners().Append(watch);
    auto const result = RUN_ALL_TESTS();
    bool const has_failed = watch->has_failed() || testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed();
    if (watch->to_repeat().empty() || has_failed || std::getenv(second_run) != nullptr) return result;
    std::cerr << "Running once more: " << watch->to_repeat() << "\n";
    ::setenv(second_run, "1", 1);
    ::setenv("GTEST_FILTER", watch->to_repeat().c_str(), 1);
    ::unsetenv("GTEST_TOTAL_SHARDS");
    ::unsetenv("GTEST_SHARD_INDEX");
    // In a child, because this process must still end the gateways that it has started.
    std::array<char*, 2> const line{arguments[0], nullptr};
    pid_t child = 0;
    if (::posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, line.data(), environ) != 0) return result;
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : result;
}
