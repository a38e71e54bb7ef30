// Programs of the engines file, with real processes.
#include "remote/programs.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "types/text/to_number.hpp"

namespace rois::remote {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

Programs::Wanted shell(std::string const& script) {
    return {.name = "lamps", .command = {"sh", "-c", script}, .folder = "/", .url = "ws://main", .joins = "lamp"};
}

// What programs say, and what happens to them.
class TheProgram : public testing::Test {
protected:
    void run(std::string const& script) { programs->set({shell(script)}); }

    // Waits for this number of lines.
    std::vector<std::string> said(std::size_t lines) { return first(said_, lines); }
    std::vector<std::string> happened(std::size_t number) { return first(happened_, number); }

    static bool exists(std::string const& pid) { return ::kill(to_number<pid_t>(pid).value(), 0) == 0; }
    static bool ends(std::string const& pid) {
        for (int i = 0; i < 1'000 && exists(pid); ++i) std::this_thread::sleep_for(5ms);
        return !exists(pid);
    }

private:
    void add(std::vector<std::string>& lines, std::string const& line) {
        std::lock_guard const lock{mutex_};
        lines.push_back(line);
        changed_.notify_all();
    }
    std::vector<std::string> first(std::vector<std::string> const& lines, std::size_t number) {
        std::unique_lock lock{mutex_};
        changed_.wait_for(lock, 10s, [&] { return lines.size() >= number; });
        return {lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min(number, lines.size()))};
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> said_, happened_;

protected:
    static constexpr ProgramTimes times{.shortest_pause = 5ms, .longest_pause = 20ms, .immediately = 5s, .to_end = 50ms};
    // Its thread ends before the members above.
    std::unique_ptr<Programs> programs = std::make_unique<Programs>(
        Programs::Listener{
            .says = [this](std::string const&, std::string const& line) { add(said_, line); },
            .happens = [this](std::string const& name, std::string const& what) { add(happened_, name + ": " + what); }},
        times);
};

TEST_F(TheProgram, RunsInItsFolderWithTheGatewaysAddress) {
    ::setenv("ROIS_ENGINES", "engines.json", 1);
    run("pwd; echo $ROIS_URL $ROIS_NAME .$ROIS_ENGINES; sleep 60");
    EXPECT_THAT(said(2), ElementsAre("/", "ws://main lamp .")) << "without the settings of this gateway";
    ::unsetenv("ROIS_ENGINES");
}

TEST_F(TheProgram, HasEachLineOfItsOutputReported) {
    run("echo out; echo error >&2; printf 'no end'");
    EXPECT_THAT(said(3), ElementsAre("out", "error", "no end"));
}

TEST_F(TheProgram, MayWriteALineOfAnyLength) {
    run("head -c 10000 /dev/zero | tr '\\0' x; echo; echo end; sleep 60");
    auto const lines = said(4);
    EXPECT_EQ(lines.at(0).size() + lines.at(1).size() + lines.at(2).size(), 10'000U);
    EXPECT_EQ(lines.at(3), "end");
}

TEST_F(TheProgram, IsStartedAgainUntilItEndsAtOnceFiveTimes) {
    run("exit 3");
    EXPECT_THAT(happened(5), ElementsAre("lamps: its program ended with exit code 3: it is started again in 0 s",
                                         "lamps: its program ended with exit code 3: it is started again in 0 s",
                                         "lamps: its program ended with exit code 3: it is started again in 0 s",
                                         "lamps: its program ended with exit code 3: it is started again in 0 s",
                                         "lamps: its program ended with exit code 3, 5 times in a row within 5 s of its start: "
                                         "it is not started again until SIGHUP"));
    run("exit 3");
    EXPECT_EQ(happened(6).size(), 6U) << "the file was read again";
}

TEST_F(TheProgram, ThatCannotBeRunIsReported) {
    programs->set({{.name = "lamps", .command = {"/no/such/program"}, .folder = "/", .url = "", .joins = ""}});
    EXPECT_THAT(said(1).at(0), HasSubstr("it cannot be run: No such file"));
    EXPECT_THAT(happened(1).at(0), HasSubstr("exit code 127"));
}

TEST_F(TheProgram, ThatEndsByASignalIsReportedWithTheSignal) {
    run("kill -9 $$");
    EXPECT_THAT(happened(1).at(0), HasSubstr("ended by signal 9"));
}

TEST_F(TheProgram, GoesOnWithTheSameSettings) {
    run("echo $$; sleep 60");
    auto const pid = said(1).at(0);
    run("echo $$; sleep 60");
    run("echo again; sleep 60");
    EXPECT_THAT(said(2), ElementsAre(pid, "again"));
    EXPECT_TRUE(ends(pid));
    EXPECT_THAT(happened(0), ElementsAre());
}

TEST_F(TheProgram, EndsWithTheProcessesThatItHasStarted) {
    run("sleep 60 & echo $!; echo $$; wait");
    auto const pids = said(2);
    programs.reset();
    EXPECT_TRUE(ends(pids.at(0)));
    EXPECT_FALSE(exists(pids.at(1)));
}

TEST_F(TheProgram, IsKilledIfItIgnoresTheEnd) {
    run("trap '' TERM; echo $$; while :; do sleep 60; done");
    auto const pid = said(1).at(0);
    programs->set({});
    EXPECT_TRUE(ends(pid));
    EXPECT_THAT(happened(0), ElementsAre()) << "it is not wanted any more";
}

TEST_F(TheProgram, MayWriteMuchWhileItIsEnded) {
    run("while :; do echo x; done");
    EXPECT_EQ(said(1'000).size(), 1'000U);
    programs.reset();
}

}  // namespace
}  // namespace rois::remote
