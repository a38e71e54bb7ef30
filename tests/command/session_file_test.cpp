// The `rois` program with a session that a process in the background holds under a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "command/rois_fixture.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using RoisWithASessionFile = Rois;

pid_t holder_of(std::string const& file) { return json::parse(text_of(file))["process"]; }

std::string secret_file_with(std::string const& name, std::string const& text) {
    auto file = file_with(name, text);
    chmod(file.c_str(), S_IRUSR | S_IWUSR);
    return file;
}

// Kills the holder, and waits until its lock has gone with it.
void kill_holder(std::string const& file) {
    kill(holder_of(file), SIGKILL);
    Ended ended;
    for (int i = 0; i < 500 && ended.exit_code != 2; ++i)
        ended = run_rois({"get", "navigation", "--session-file", file}, {}, {{"ROIS_URL", ""}});
    EXPECT_THAT(ended.error, HasSubstr("no process holds a session under this file"));
}

bool is_free(std::string const& component, std::string const& url) {
    auto const found = run_rois({"search", "name = " + component + " and bound = false"}, {}, {{"ROIS_URL", url}});
    return found.out.starts_with(component);
}

TEST_F(RoisWithASessionFile, HoldsASessionInTheBackgroundUnderAFile) {
    auto const file = file_named("held");
    EXPECT_THAT(run({"bind", "reaction", "--session-file", file}).out, StartsWith("bound reaction\nsession "));
    auto const mode = std::filesystem::status(file).permissions() & std::filesystem::perms::all;
    EXPECT_EQ(mode, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write) << "the session is a secret";
    expect(5, "OUT_OF_RESOURCES", {"start", "reaction", "reaction_ref=9"});
    EXPECT_EQ(run_rois({"start", "reaction", "reaction_ref=9", "--session-file", file}, {}, {{"ROIS_URL", ""}}).out,
              "start reaction  OK\n")
        << "the file names the gateway, too";
    EXPECT_EQ(run({"bind", "speech_synthesis", "--session-file", file}).out, "bound speech_synthesis\n") << "the same session";
    EXPECT_EQ(run({"release", "reaction", "--session-file", file}).exit_code, 0);
    EXPECT_EQ(run({"start", "reaction", "reaction_ref=9"}).exit_code, 0);
    EXPECT_EQ(run_rois({"release"}, {}, {{"ROIS_URL", ""}, {"ROIS_SESSION_FILE", file}}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(run({"start", "speech_synthesis", "speech_text=Hi."}).exit_code, 0) << "released when its holder has ended";
}

TEST_F(RoisWithASessionFile, ExplainsAnInvalidSessionFile) {
    auto const none = file_named("none");
    expect(2, "no process holds a session under this file", {"start", "reaction", "--session-file", none});
    expect(2, "no process holds a session under this file", {"release", "--session-file", none});
    expect(2, "name two sessions; give only one", {"start", "reaction", "--session-file", none, "--session", "s"});
    expect(3, "unknown component 'elevator'; there are ", {"bind", "elevator", "--session-file", none});
    EXPECT_FALSE(std::filesystem::exists(none));
    auto const pipe = file_named("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (std::string const command : {"bind", "start"})
        expect(2, "this is not a regular file", {command, "reaction", "--session-file", pipe});
    auto const foreign = secret_file_with("foreign", "a letter");
    expect(2, "was not written by rois bind", {"bind", "reaction", "--session-file", foreign});
    EXPECT_EQ(text_of(foreign), "a letter");
    expect(2, "cannot be written", {"bind", "reaction", "--session-file", "/no/such/folder/file"});
    expect(2, "record has a session of its own", {"record", file_named("r"), "--session-file", none});
    auto const left = secret_file_with("left", R"({"url":"http://127.0.0.1:1","session":"s","process":1})");
    expect(2, "no process holds a session under this file", {"start", "reaction", "--session-file", left});
    expect(0, "the session that a killed process left at http://127.0.0.1:1 could not be ended: ",
           {"bind", "reaction", "--session-file", left});
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
    kill_holder(file);
    auto const again = run({"bind", "navigation", "--session-file", file});
    EXPECT_EQ(again.exit_code, 0) << again.out << again.error;
    EXPECT_THAT(again.out, StartsWith("bound navigation\nsession "));
    EXPECT_EQ(run({"stop", "navigation", "--session-file", file}).exit_code, 0);
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, EndsALeftSessionAtItsOwnGateway) {
    GatewayProcess const other;
    auto const file = file_named("left_elsewhere");
    ASSERT_EQ(run_rois({"bind", "navigation", "--session-file", file}, {}, {{"ROIS_URL", other.url()}}).exit_code, 0);
    kill_holder(file);
    ASSERT_FALSE(is_free("navigation", other.url()));
    EXPECT_EQ(run({"bind", "reaction", "--session-file", file}).error, "");
    EXPECT_TRUE(is_free("navigation", other.url()));
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, RefusesAnotherGatewayThanThatOfTheFile) {
    GatewayProcess const other;
    auto const file = file_named("here");
    ASSERT_EQ(run({"bind", "reaction", "--session-file", file}).exit_code, 0);
    auto const says = "the session of this file is at " + shared_gateway().url() + ", not at " + other.url();
    for (std::string const command : {"bind", "stop"}) {
        expect(2, says, {command, "reaction", "--session-file", file, "--url", other.url()});
        auto const ended = run_rois({command, "reaction", "--session-file", file}, {}, {{"ROIS_URL", other.url()}});
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_THAT(ended.error, HasSubstr(says));
    }
    auto const same = "WS" + shared_gateway().url().substr(4) + "/";
    EXPECT_EQ(run({"stop", "reaction", "--session-file", file, "--url", same}).exit_code, 0) << same;
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, KeepsTheFileOfTheNextHolderAndEndsTheFirst) {
    auto const file = file_named("removed");
    ASSERT_EQ(run({"bind", "reaction", "--session-file", file}).exit_code, 0);
    std::filesystem::remove(file);
    ASSERT_EQ(run({"bind", "move", "--session-file", file}).exit_code, 0);
    bool ended = false;  // it looks once a second
    for (int i = 0; i < 500 && !ended; ++i) ended = is_free("reaction", shared_gateway().url());
    EXPECT_TRUE(ended) << "no command could find the first holder any more";
    EXPECT_EQ(run({"stop", "move", "--session-file", file}).exit_code, 0);
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, TrustsNoFileThatOthersCouldReadOrWrite) {
    auto const file = file_named("trusted");
    ASSERT_EQ(run({"bind", "reaction", "--session-file", file}).exit_code, 0);
    auto const link = file_named("link");
    std::filesystem::create_symlink(file, link);
    auto const refused_with = [&](std::string const& says, std::string const& name) {
        for (std::string const command : {"bind", "stop"}) expect(2, says, {command, "reaction", "--session-file", name});
    };
    refused_with("this is a symbolic link; name the file itself", link);
    chmod(file.c_str(), 0640);
    refused_with("other users can read it", file);
    chmod(file.c_str(), 0600);
    if (geteuid() == 0) {
        EXPECT_EQ(chown(file.c_str(), 65'534, static_cast<gid_t>(-1)), 0);
        refused_with("it belongs to another user", file);
        EXPECT_EQ(chown(file.c_str(), 0, static_cast<gid_t>(-1)), 0);
    }
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
    auto const empty = file_with("empty", "");
    EXPECT_EQ(run({"bind", "reaction", "--session-file", empty}).exit_code, 0) << "it becomes readable only to its owner";
    EXPECT_EQ(run({"release", "--session-file", empty}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, ReleasesTheComponentsThatARefusedBindHasBound) {
    auto const file = file_named("partly");
    ASSERT_EQ(run({"bind", "reaction", "--session-file", file}).exit_code, 0);
    expect(3, "unknown component 'elevator'; there are ", {"bind", "reaction", "move", "elevator", "--session-file", file});
    EXPECT_TRUE(is_free("move", shared_gateway().url()));
    EXPECT_FALSE(is_free("reaction", shared_gateway().url())) << "bound before";
    expect(4, "; the engine has ", {"bind", "move", "--where", "type = Elevator", "--session-file", file});
    EXPECT_TRUE(is_free("move", shared_gateway().url()));
    expect(3, "unknown component 'elevator'; there are ", {"release", "elevator", "--session-file", file});
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, CountsTheEventsOfItsOwnSubscriptionFromNowOn) {
    auto const file = file_named("events");
    ASSERT_EQ(run({"bind", "person_detection", "--session-file", file}).exit_code, 0);
    auto const watched = [&](std::string const& sense) {
        std::vector<json> events;
        for (auto const& one :
             objects({"watch", sense + "_detected", "--start", sense + "_detection", "--count", "1", "--session-file", file}))
            if (one.contains("event_type")) events.push_back(one);
        EXPECT_EQ(events.size(), 1u) << sense;
        EXPECT_EQ(events.at(0)["event_type"], sense + "_detected");
        return events.at(0)["event_id"];
    };
    auto const first = watched("person");
    EXPECT_NE(watched("person"), first) << "earlier events do not count";
    watched("sound");
    RoisProcess subscribed{{"subscribe", "person_detected", "--count", "1", "--session-file", file}, at()};
    EXPECT_THAT(subscribed.line(), StartsWith("s-"));
    EXPECT_EQ(run({"start", "person_detection", "--session-file", file}).exit_code, 0);
    auto const ended = subscribed.wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_THAT(ended.out, HasSubstr("person_detected  person_detection  timestamp="));
    expect(6, "only 0 of 2 events arrived",
           {"subscribe", "reached_target", "--count", "2", "--for", "0", "--session-file", file});
    EXPECT_EQ(run({"release", "--session-file", file}).exit_code, 0);
}

TEST_F(RoisWithASessionFile, ChecksAScenarioBesideAHeldSession) {
    auto const checked = run_rois({"scenario", "--check", ROIS_SOURCE_DIR "/client-cpp/scenarios/reception.xml"}, {},
                                  {{"ROIS_SESSION_FILE", file_named("none")}});
    EXPECT_EQ(checked.out, "scenario ok\n") << checked.error;
}

TEST(ABindInTheBackground, EndsWithTheProgramThatWaitsForIt) {
    auto gateway = std::make_unique<GatewayProcess>();
    auto const port = std::to_string(gateway->port());
    auto const file = file_named("orphan");
    Variables const there{{"ROIS_URL", gateway->url()}, {"ROIS_SESSION_FILE", file}};
    gateway.reset();
    for (int const number : {SIGTERM, SIGKILL}) {
        RoisProcess binding{{"bind", "navigation", "--timeout", "60"}, there};
        EXPECT_THAT(binding.error_line(), HasSubstr("trying again"));
        binding.signal(number);
        GatewayProcess const again{{"--listen", "127.0.0.1:" + port}};
        EXPECT_EQ(binding.wait().exit_code, -number);
        EXPECT_FALSE(std::filesystem::exists(file)) << "nothing holds a session";
        run_rois({"release"}, {}, there);
    }
}

TEST(ASessionFileWhoseGatewayHasRestarted, IsWithoutAHolder) {
    auto gateway = std::make_unique<GatewayProcess>();
    auto const port = std::to_string(gateway->port());
    auto const file = file_named("restarted");
    Variables const there{{"ROIS_URL", gateway->url()}, {"ROIS_SESSION_FILE", file}};
    ASSERT_EQ(run_rois({"bind", "navigation"}, {}, there).exit_code, 0);
    auto const holder = holder_of(file);
    kill(holder, SIGSTOP);  // it does not notice the end of its session
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
