// The `rois` program with a session that a process in the background holds under a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <memory>

#include "command/rois_fixture.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using RoisWithASessionFile = Rois;

pid_t holder_of(std::string const& file) { return json::parse(text_of(file))["process"]; }

TEST_F(RoisWithASessionFile, HoldsASessionInTheBackgroundUnderAFile) {
    auto const file = file_named("held");
    EXPECT_THAT(run({"bind", "reaction", "--session-file", file}).out, StartsWith("bound reaction\nsession "));
    auto const mode = std::filesystem::status(file).permissions() & std::filesystem::perms::all;
    EXPECT_EQ(mode, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write) << "the session is a secret";
    expect(5, "OUT_OF_RESOURCES", {"start", "reaction", "reaction_ref=9"});
    EXPECT_EQ(run_rois({"start", "reaction", "reaction_ref=9", "--session-file", file}).out, "start reaction  OK\n")
        << "the file also says where the engine is";
    EXPECT_EQ(run({"bind", "speech_synthesis", "--session-file", file}).out, "bound speech_synthesis\n") << "the same session";
    EXPECT_EQ(run({"release", "reaction", "--session-file", file}).exit_code, 0);
    EXPECT_EQ(run({"start", "reaction", "reaction_ref=9"}).exit_code, 0);
    EXPECT_EQ(run_rois({"release"}, {}, {{"ROIS_SESSION_FILE", file}}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(run({"start", "speech_synthesis", "speech_text=Hi."}).exit_code, 0) << "released when its holder has ended";
}

TEST_F(RoisWithASessionFile, SaysWhatIsWrongWithASessionFile) {
    auto const none = file_named("none");
    expect(2, "no process holds a session under this file", {"start", "reaction", "--session-file", none});
    expect(2, "no process holds a session under this file", {"release", "--session-file", none});
    expect(2, "not both", {"start", "reaction", "--session-file", none, "--session", "s"});
    expect(3, "unknown component 'elevator'; there are ", {"bind", "elevator", "--session-file", none});
    EXPECT_FALSE(std::filesystem::exists(none));
    auto const pipe = file_named("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (std::string const command : {"bind", "start"})
        expect(2, "this is not a regular file", {command, "reaction", "--session-file", pipe});
    auto const foreign = file_with("foreign", "a letter");
    expect(2, "was not written by rois bind", {"bind", "reaction", "--session-file", foreign});
    EXPECT_EQ(text_of(foreign), "a letter");
    expect(2, "cannot be written", {"bind", "reaction", "--session-file", "/no/such/folder/file"});
    expect(2, "record has a session of its own", {"record", file_named("r"), "--session-file", none});
    auto const left = file_with("left", R"({"url":"http://127.0.0.1:1","session":"s","process":1})");
    expect(2, "no process holds a session under this file", {"start", "reaction", "--session-file", left});
    EXPECT_EQ(run({"bind", "reaction", "--session-file", left}).exit_code, 0) << "its holder was killed";
    EXPECT_EQ(run({"release", "--session-file", left}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, SharesTheSessionOfTheOtherWhenTwoBindAtOnce) {
    auto const file = file_named("both");
    for (int round = 0; round < 5; ++round) {
        RoisProcess one{{"bind", "sound_detection", "--session-file", file}, at()};
        RoisProcess other{{"bind", "sound_localization", "--session-file", file}, at()};
        for (auto* const each : {&one, &other}) {
            auto const ended = each->wait();
            EXPECT_EQ(ended.exit_code, 0) << ended.error;
        }
        for (std::string const ref : {"sound_detection", "sound_localization"})
            EXPECT_EQ(run({"start", ref, "--session-file", file}).exit_code, 0) << ref << " is bound in this session";
        EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
        EXPECT_FALSE(std::filesystem::exists(file));
    }
}

TEST_F(RoisWithASessionFile, EndsTheSessionOfAHolderThatWasKilled) {
    auto const file = file_named("killed");
    ASSERT_EQ(run({"bind", "navigation", "--session-file", file}).exit_code, 0);
    kill(holder_of(file), SIGKILL);
    Ended again;  // the lock goes with the process
    for (int i = 0; i < 500 && again.exit_code != 2; ++i) again = run({"get", "navigation", "--session-file", file});
    EXPECT_THAT(again.error, HasSubstr("no process holds a session under this file"));
    again = run({"bind", "navigation", "--session-file", file});
    EXPECT_EQ(again.exit_code, 0) << again.out << again.error;
    EXPECT_THAT(again.out, StartsWith("bound navigation\nsession "));
    EXPECT_EQ(run({"stop", "navigation", "--session-file", file}).exit_code, 0);
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST(ASessionFileWhoseGatewayHasRestarted, IsWithoutAHolder) {
    auto gateway = std::make_unique<GatewayProcess>();
    auto const port = std::to_string(gateway->port());
    auto const file = file_named("restarted");
    Variables const there{{"ROIS_URL", gateway->url()}, {"ROIS_SESSION_FILE", file}};
    ASSERT_EQ(run_rois({"bind", "navigation"}, {}, there).exit_code, 0);
    auto const holder = holder_of(file);
    kill(holder, SIGSTOP);  // it notices nothing
    gateway.reset();
    GatewayProcess const again{{"--listen", "127.0.0.1:" + port}};
    auto const refused = run_rois({"stop", "navigation"}, {}, there);
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_THAT(refused.error, HasSubstr("no process holds a session under this file; rois bind "));
    auto const bound = run_rois({"bind", "navigation"}, {}, there);
    EXPECT_EQ(bound.exit_code, 0) << bound.error;
    EXPECT_THAT(bound.out, StartsWith("bound navigation\nsession "));
    EXPECT_NE(holder_of(file), holder);
    EXPECT_EQ(run_rois({"stop", "navigation"}, {}, there).exit_code, 0);
    EXPECT_EQ(run_rois({"release"}, {}, there).exit_code, 0);
}

}  // namespace
}  // namespace rois::test
