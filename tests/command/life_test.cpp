// Motion leases of robots that `rois` has set in motion, and stop for everything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <optional>

#include "client_cpp/rig.hpp"
#include "command/rois_fixture.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr auto empty_hall = ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml";
constexpr auto longer = 2500ms;  // than the lease of a second, with time for a busy machine
constexpr auto way = "target_position=14000, 6000";

// A shell with `rois` in its PATH that runs these lines, and then waits for its standard input.
class Shell {
public:
    Shell(std::string const& lines, std::string const& url) {
        Variables const variables{{"ROIS_URL", url}, {"PATH", ROIS_BINARY_DIR "/bin:" + std::string{getenv("PATH")}}};
        process_ = kit::start("sh", {"-c", lines + "\nread line"}, variables, {.in = in_.to_read});
        close(in_.to_read);
    }
    ~Shell() {
        signal(SIGKILL);
        kit::exit_code(process_);
        close(in_.to_write);
    }
    Shell(Shell const&) = delete;
    Shell& operator=(Shell const&) = delete;

    void signal(int number) const { kill(process_, number); }

private:
    kit::Pipe in_;
    pid_t process_ = 0;
};

class RoisAndMotion : public testing::Test {
protected:
    void SetUp() override { watcher.client().spawn(listen(watcher.client())); }
    void TearDown() override {
        watcher.client().close();
        history.await_state("closed");
    }

    static Task<> listen(Client& client) {
        auto stream = co_await client.subscribe("reached_target");
        for (bool is_open = true; is_open;) {
            auto const event = co_await stream.next_event();
            is_open = event.has_value();
        }
    }
    // Lines that bind navigation under this session file, start the robot, and then bind reaction.
    static std::string set_out(std::string const& file) {
        auto const here = " --session-file " + file;
        return "rois bind navigation" + here + " && rois start navigation '" + way + "' --no-wait" + here +
               " && rois bind reaction" + here;
    }
    // Returns why the motion was held.
    std::string held() {
        history.await_notifications(1);
        if (history.notifications().empty()) return "it was not held";
        auto const error = std::get<ReceiveError>(history.notifications().front().second);
        return find(watcher(watcher.client().get_error_detail(error.error_id)).parameters, "text")->values.front();
    }
    void await_busy(std::string const& component) {
        auto const is_busy = component_ref == component && status == "BUSY";
        while (watcher.search(is_busy).empty()) watcher(watcher.client().sleep(20ms));
    }
    void expect_moving_on() {
        await_busy("navigation");
        watcher(watcher.client().sleep(longer));
        EXPECT_THAT(history.notifications(), IsEmpty());
    }

    GatewayProcess gateway{{"--sim-speed", "1", "--motion-lease", "1", "--scenario", empty_hall}};
    Variables const at{{"ROIS_URL", gateway.url()}};
    History history;
    Blocking watcher{quick(gateway.url()), history.observers()};
};

TEST_F(RoisAndMotion, ACommandThatWaitsKeepsTheRobotGoing) {
    RoisProcess walk{{"start", "navigation", way}, at};
    expect_moving_on();
}

TEST_F(RoisAndMotion, AStoppedCommandLetsTheRobotBeHeldAndReportsTheHold) {
    RoisProcess walk{{"start", "navigation", way}, at};
    await_busy("navigation");
    walk.signal(SIGSTOP);
    EXPECT_THAT(held(), HasSubstr("its motion is held: its application gave no sign of life"));
    walk.signal(SIGCONT);
    EXPECT_THAT(walk.error_line(),
                testing::AllOf(StartsWith("rois: navigation: its motion is held: its application gave no sign of life"),
                               testing::EndsWith("; interrupt this command and run it again")));
}

TEST_F(RoisAndMotion, AHeldSessionKeepsTheRobotGoingWhileTheShellLives) {
    auto const file = file_named("walk");
    Shell const shell{set_out(file), gateway.url()};
    expect_moving_on();
    run_rois({"release", "--session-file", file}, {}, at);
}

TEST_F(RoisAndMotion, AHeldSessionLetsTheRobotBeHeldWhenTheShellHasGoneAndResumesIt) {
    auto const file = file_named("gone");
    {
        Shell const shell{set_out(file), gateway.url()};
        await_busy("navigation");
        watcher(watcher.client().sleep(longer));
        EXPECT_THAT(history.notifications(), IsEmpty());
    }
    EXPECT_THAT(held(), HasSubstr("its motion is held"));
    auto const resumed = run_rois({"resume", "navigation", "--session-file", file}, {}, at);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
    EXPECT_THAT(resumed.out, HasSubstr("resume navigation  OK\n"));
    EXPECT_THAT(resumed.error, HasSubstr("rois: navigation: its motion is held: "));
    EXPECT_THAT(resumed.error, HasSubstr(": rois resume navigation\n"));
    run_rois({"release", "--session-file", file}, {}, at);
}

TEST_F(RoisAndMotion, AHeldSessionLetsTheRobotBeHeldWhenTheShellIsStopped) {
    auto const file = file_named("stopped");
    Shell const shell{set_out(file), gateway.url()};
    await_busy("reaction");
    shell.signal(SIGSTOP);
    EXPECT_THAT(held(), HasSubstr("its motion is held"));
    run_rois({"release", "--session-file", file}, {}, at);
}

TEST_F(RoisAndMotion, ACommandThatOnlyWatchesDoesNotKeepTheRobotGoing) {
    auto const file = file_named("watched");
    std::optional<Shell> shell{std::in_place, "rois bind navigation --session-file " + file, gateway.url()};
    await_busy("navigation");
    RoisProcess watch{{"watch", "--session-file", file}, at};
    run_rois({"start", "navigation", way, "--no-wait", "--session-file", file}, {}, at);
    shell.reset();
    EXPECT_THAT(held(), HasSubstr("its motion is held"));
    EXPECT_THAT(watch.error_line(), HasSubstr("its motion is held"));
    run_rois({"release", "--session-file", file}, {}, at);
}

// --- Stop for everything ---

TEST_F(RoisAndMotion, StopAllHaltsEverythingUntilClear) {
    RoisProcess walk{{"start", "navigation", way}, at};
    await_busy("navigation");
    auto const stopped = run_rois({"stop-all"}, {}, at);
    EXPECT_EQ(stopped.exit_code, 0) << stopped.error;
    EXPECT_EQ(stopped.out, "stopped everything at " + gateway.url() + "; nothing starts until: rois clear\n");
    EXPECT_EQ(walk.wait().exit_code, 7) << "ABORT";

    auto const refused = run_rois({"start", "navigation", way}, {}, at);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.out + refused.error, HasSubstr("everything was stopped"));
    auto const health = run_rois({"health"}, {}, at);
    EXPECT_EQ(health.exit_code, 1);
    EXPECT_EQ(health.error,
              "rois: not healthy: everything is stopped at " + gateway.url() + "; nothing starts until: rois clear\n");
    EXPECT_TRUE(json::parse(run_rois({"health", "--json"}, {}, at).out)["stopped"]);

    auto const cleared = run_rois({"clear", "--json"}, {}, at);
    EXPECT_EQ(cleared.exit_code, 0) << cleared.error;
    EXPECT_EQ(json::parse(cleared.out), (json{{"operation", "clear"}, {"url", gateway.url()}, {"stopped", false}}));
    EXPECT_EQ(run_rois({"health"}, {}, at).exit_code, 0);
}

TEST_F(RoisAndMotion, StopAllWritesADocument) {
    auto const stopped = run_rois({"stop-all", "--json"}, {}, at);
    EXPECT_EQ(json::parse(stopped.out),
              (json{{"operation", "stop_all"}, {"url", gateway.url()}, {"stopped", true}, {"not_confirmed", json::array()}}));
    EXPECT_THAT(run_rois({"stop-all", "--xml"}, {}, at).out, StartsWith("<stop_all "));
}

TEST(RoisStopAll, NamesComponentsThatHaveNotConfirmed) {
    GatewayProcess gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--sim-speed", "0", "--shutdown-timeout", "0.1"}};
    Variables const at{{"ROIS_URL", gateway.url()}};
    auto const stopped = run_rois({"stop-all"}, {}, at);
    EXPECT_EQ(stopped.exit_code, 6);
    EXPECT_THAT(stopped.out, StartsWith("stopped everything at "));
    EXPECT_EQ(stopped.error,
              "rois: these components have not confirmed that they stand still: navigation; the gateway repeats their halt\n");
    EXPECT_EQ(json::parse(run_rois({"stop-all", "--json"}, {}, at).out)["not_confirmed"], json{"navigation"});
    EXPECT_THAT(run_rois({"health"}, {}, at).error, HasSubstr("; not confirmed that they stand still: navigation\n"));
    EXPECT_EQ(json::parse(run_rois({"health", "--json"}, {}, at).out)["not_confirmed"], json{"navigation"});
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 71);
}

TEST_F(RoisAndMotion, StopAllFindsTheGatewayOfASessionFileAndNeedsNoHolder) {
    auto const file = file_named("elsewhere");
    Shell const shell{"rois bind move --session-file " + file, gateway.url()};
    await_busy("move");
    Variables const variables{{"ROIS_URL", ""}, {"ROIS_SESSION_FILE", file}};
    EXPECT_EQ(run_rois({"stop-all"}, {}, variables).out,
              "stopped everything at " + gateway.url() + "; nothing starts until: rois clear\n");
    EXPECT_EQ(run_rois({"release"}, {}, variables).exit_code, 0);
    EXPECT_EQ(run_rois({"clear"}, {}, {{"ROIS_URL", gateway.url()}, {"ROIS_SESSION_FILE", file}}).exit_code, 0);
}

TEST(RoisStopAll, ReportsThatNoGatewayAnswers) {
    auto const ended = run_rois({"stop-all"}, {}, {{"ROIS_URL", "http://127.0.0.1:1"}});
    EXPECT_EQ(ended.exit_code, 8);
    EXPECT_THAT(ended.error, HasSubstr("Connection refused"));
}

}  // namespace
}  // namespace rois::test
