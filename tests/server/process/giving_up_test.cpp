// The gateway when its clock fails permanently: it halts all components, logs the reason, and exits with 70.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "kit/vocabulary.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto why = "too many exceptions in a second: all components were halted, and the gateway ends";

// A gateway whose robot drives. A test can make each of its threads fail (preload/failing_thread.cpp).
class AGatewayThatFails : public testing::Test {
protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "a sanitizer replaces malloc";
#endif
        gateway = std::make_unique<GatewayProcess>(std::vector<std::string>{"--log-level", "debug"},
                                                   kit::preloading(ROIS_BINARY_DIR "/tests/libfailing_thread.so"));
        desk = std::make_unique<HttpClient>(*gateway);
        desk->call("connect");
        desk->call("bind", component_ref("navigation"));
        auto const going = desk->call(
            "execute", kit::sequence(kit::unit(
                           {.component = "navigation", .id = "go", .arguments = {kit::target_position({"8000, 6000, 30"})}})));
        EXPECT_EQ(going.return_code(), "OK");
    }

    // Sends the signal to the gateway's clock. Its thread has no name until it runs for the first time.
    void fail_the_clock(int signal) const {
        auto const tasks = std::filesystem::path{"/proc"} / std::to_string(gateway->id()) / "task";
        for (auto const until = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < until;) {
            for (auto const& task : std::filesystem::directory_iterator{tasks}) {
                std::ifstream in{task.path() / "comm"};
                std::string name;
                in >> name;
                if (name != "clock") continue;
                EXPECT_EQ(syscall(SYS_tgkill, gateway->id(), std::stoi(task.path().filename()), signal), 0);
                return;
            }
            std::this_thread::yield();
        }
        gateway->signal(SIGKILL);
        ADD_FAILURE() << "there is no thread \"clock\"";
    }

    Ended wait() const {
        desk->session.clear();  // the gateway has ended: do not disconnect
        return gateway->wait();
    }

    std::unique_ptr<GatewayProcess> gateway;
    std::unique_ptr<HttpClient> desk;
};

}  // namespace

TEST_F(AGatewayThatFails, HaltsAllComponentsLogsTheReasonAndExitsWith70) {
    fail_the_clock(SIGUSR2);
    auto const ended = wait();
    EXPECT_EQ(ended.exit_code, 70);
    EXPECT_THAT(ended.error, HasSubstr("exception in tick, the gateway goes on: a fault that a test has made"));
    EXPECT_THAT(ended.error, HasSubstr("start of navigation, ended with ABORT: everything was stopped"));
    EXPECT_THAT(ended.error, HasSubstr(std::string{"critical "} + why));
}

TEST_F(AGatewayThatFails, LogsTheReasonAlsoWithoutMemory) {
    fail_the_clock(SIGUSR1);
    auto const ended = wait();
    EXPECT_EQ(ended.exit_code, 70);
    EXPECT_THAT(ended.error, HasSubstr(why));
}

}  // namespace rois::test
