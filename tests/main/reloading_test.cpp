// Reading the files again after SIGHUP: all changes or none, in order, and the end while a file does not answer.
#include "main/reloading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <future>
#include <memory>
#include <mutex>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gateway/process/telemetry.hpp"

namespace rois {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class ReloadingTest : public testing::Test {
protected:
    ReloadingTest() {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
    }
    ~ReloadingTest() override { spdlog::set_default_logger(std::move(before_)); }

    // A part that notes its calls.
    Reloading::Part part(
        std::string const& name, std::function<void()> prepare = [] {}, std::function<void()> change = [] {}) {
        return {name, [this, name, prepare, change]() -> std::function<void()> {
                    note("read " + name);
                    prepare();
                    return [this, name, change] {
                        change();
                        note("changed " + name);
                    };
                }};
    }
    void note(std::string text) {
        std::lock_guard const lock{mutex_};
        noted_.push_back(std::move(text));
    }
    std::vector<std::string> noted() {
        std::lock_guard const lock{mutex_};
        return noted_;
    }
    // Reads all parts once.
    std::vector<std::string> read(std::vector<Reloading::Part> parts) {
        std::promise<void> begun;
        auto const prepare = parts.front().prepare;
        parts.front().prepare = [&] {
            begun.set_value();
            return prepare();
        };
        Reloading reloading{std::move(parts), telemetry};
        reloading.ask();
        begun.get_future().wait();
        EXPECT_TRUE(reloading.finish(10s));
        return noted();
    }

    Telemetry telemetry;
    std::ostringstream log;

private:
    std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
    std::mutex mutex_;
    std::vector<std::string> noted_;
};

[[noreturn]] void fail() { throw std::runtime_error{"not valid"}; }
[[noreturn]] void have_no_memory() { throw std::bad_alloc{}; }

TEST_F(ReloadingTest, ReadsAllPartsBeforeItChangesOne) {
    EXPECT_THAT(read({part("a"), part("b")}), ElementsAre("read a", "read b", "changed a", "changed b"));
}

TEST_F(ReloadingTest, ChangesNothingIfOnePartIsNotValid) {
    EXPECT_THAT(read({part("a"), part("b", fail), part("c")}), ElementsAre("read a", "read b", "read c"));
}

TEST_F(ReloadingTest, ChangesNothingIfTheFirstChangeFails) {
    EXPECT_THAT(read({part(
                          "a", [] {}, fail),
                      part("b")}),
                ElementsAre("read a", "read b"));
}

TEST_F(ReloadingTest, LeavesTheLastPartsUnchangedWithoutMemory) {
    EXPECT_THAT(read({part("a"),
                      part(
                          "b", [] {}, have_no_memory),
                      part("c")}),
                ElementsAre("read a", "read b", "read c", "changed a"));
    EXPECT_THAT(log.str(), testing::HasSubstr("SIGHUP: only a changed: b: std::bad_alloc"));
}

TEST_F(ReloadingTest, DoesNotWaitForAFileThatDoesNotAnswer) {
    std::promise<void> begun, answer;
    auto answered = answer.get_future().share();
    Reloading reloading{{part("a",
                              [&begun, answered] {
                                  begun.set_value();
                                  answered.wait();
                              })},
                        telemetry};
    reloading.ask();
    begun.get_future().wait();
    EXPECT_FALSE(reloading.finish(1ms));
    answer.set_value();
}

}  // namespace
}  // namespace rois
