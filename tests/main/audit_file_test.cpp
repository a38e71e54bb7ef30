// The file of the audit log.
#include "main/audit_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "main/settings.hpp"
#include "main/temporary_file.hpp"

namespace rois::test {

namespace {

Steady present{};
Steady now() { return present; }

struct OfAudit : testing::Test {
    TemporaryFile file{""};

    std::string content(std::string const& name) const {
        std::ostringstream text;
        text << std::ifstream{name}.rdbuf();
        return text.str();
    }
    static std::size_t lines(std::string const& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }
};

}  // namespace

TEST_F(OfAudit, LeavesRefusalsOutAndCountsThem) {
    {
        AuditFile audit{file.name(), {.now = now}};
        for (int i = 0; i < 15; ++i) audit.note({.what = "refused", .token = "desk"});
        audit.note({.what = "refused", .token = "other"});
        for (int i = 0; i < 15; ++i) audit.note({.what = "bound", .token = "desk"});
        present += std::chrono::seconds{1};
        audit.note({.what = "refused", .token = "desk"});
        audit.note({.what = "refused", .token = "desk"});
        EXPECT_EQ(audit.lost(), 0u);
    }
    auto const text = content(file.name());
    EXPECT_EQ(lines(text), 10u + 1 + 15 + 2);
    EXPECT_THAT(text, testing::HasSubstr(R"("token":"desk","left_out":5})"));
}

TEST_F(OfAudit, BelongsToOneGateway) {
    AuditFile const audit{file.name(), {}};
    try {
        AuditFile const another{file.name(), {}};
        FAIL() << "both would rename it";
    } catch (BadSettings const& problem) {
        EXPECT_THAT(problem.what(), testing::HasSubstr("is in use by another gateway"));
    }
}

TEST_F(OfAudit, GoesOnBehindALineThatWasCutShort) {
    std::ofstream{file.name()} << R"({"time":"2026-11-29T10:15:30.123Z","wha)";
    {
        AuditFile audit{file.name(), {}};
        audit.note({.what = "bound", .token = "desk"});
    }
    EXPECT_THAT(content(file.name()), testing::HasSubstr("wha\n{\"time\":"));
}

TEST_F(OfAudit, IsNotAddedToAFileOfAnotherKind) {
    std::string const log = R"({"time":"2026-11-29T10:15:30.123Z","level":"info","message":"listening"})";
    for (auto const& text : {std::string{R"({"tokens": []})"}, log}) {
        std::ofstream{file.name()} << text;
        try {
            AuditFile const audit{file.name(), {}};
            FAIL() << "it would damage the file";
        } catch (BadSettings const& problem) {
            EXPECT_THAT(problem.what(), testing::HasSubstr("is another file"));
        }
        EXPECT_EQ(content(file.name()), text);
    }
}

TEST_F(OfAudit, LeavesSessionsOutIfThereAreTooMany) {
    {
        AuditFile audit{file.name(), {.now = now}};
        for (int i = 0; i < 1'000; ++i) {
            audit.note({.what = "connected", .token = "watcher"});
            audit.note({.what = "disconnected", .token = "watcher"});
        }
        audit.note({.what = "stopped everything", .token = "watcher"});
        audit.note({.what = "refused", .token = "watcher"});
        audit.note({.what = "connected", .token = "desk"});
    }
    auto const text = content(file.name());
    EXPECT_EQ(lines(text), 10u + 3 + 1);
    EXPECT_THAT(text, testing::EndsWith(R"("what":"left out","token":"watcher","outcome":"sessions","left_out":1990})"
                                        "\n"));
}

TEST_F(OfAudit, CountsWhatWasLeftOutAlsoIfNothingFollows) {
    AuditFile audit{file.name(), {.now = now}};
    for (int i = 0; i < 15; ++i) audit.note({.what = "refused", .address = "192.0.2.1"});
    while (lines(content(file.name())) <= 10) std::this_thread::yield();
    EXPECT_THAT(content(file.name()), testing::EndsWith(R"("what":"left out","outcome":"refusals","left_out":5})"
                                                        "\n"));
}

TEST_F(OfAudit, GoesOnInItsPlaceIfAnotherProgramMovesOrRemovesIt) {
    auto const moved = file.name() + ".moved";
    {
        AuditFile audit{file.name(), {}};
        audit.note({.what = "bound"});
        while (content(file.name()).empty()) std::this_thread::yield();
        std::filesystem::rename(file.name(), moved);
        audit.note({.what = "released"});
        while (content(file.name()).empty()) std::this_thread::yield();
        std::filesystem::remove(file.name());
        audit.note({.what = "took over"});
    }
    EXPECT_THAT(content(moved), testing::HasSubstr("bound"));
    EXPECT_THAT(content(file.name()), testing::HasSubstr("took over"));
    std::filesystem::remove(moved);
}

TEST_F(OfAudit, CountsLinesWhoseFileWasRemovedWithItsFolder) {
    std::filesystem::remove(file.name());
    std::filesystem::create_directory(file.name());
    auto const name = file.name() + "/audit.log";
    AuditFile audit{name, {}};
    audit.note({.what = "bound"});
    while (content(name).empty()) std::this_thread::yield();
    std::filesystem::remove_all(file.name());
    audit.note({.what = "released"});
    while (audit.lost() == 0) std::this_thread::yield();
    std::filesystem::create_directory(file.name());
    audit.note({.what = "took over"});
    while (content(name).empty()) std::this_thread::yield();
    EXPECT_THAT(content(name), testing::HasSubstr("took over"));
    EXPECT_EQ(audit.lost(), 1u);
    std::filesystem::remove_all(file.name());
}

TEST_F(OfAudit, BeginsAnotherFileAndKeepsAFew) {
    {
        AuditFile audit{file.name(), {.bytes = 1'000, .files = 2}};
        for (int i = 0; i < 100; ++i) audit.note({.what = "bound", .component = "navigation"});
    }
    for (auto const* end : {"", ".1", ".2"}) {
        EXPECT_GT(std::filesystem::file_size(file.name() + end), 0u) << end;
        EXPECT_LE(std::filesystem::file_size(file.name() + end), 1'000u) << end;
    }
    EXPECT_FALSE(std::filesystem::exists(file.name() + ".3"));
    for (auto const* end : {".1", ".2"}) std::filesystem::remove(file.name() + end);
}

// If the present file cannot be renamed, a number is free, and the files behind it must not move with each line.
TEST_F(OfAudit, MovesOnlyTheFilesBeforeTheFirstFreeNumber) {
    auto const write = [&](std::string const& end) { std::ofstream{file.name() + end} << end; };
    for (auto const* end : {".1", ".3", ".4"}) write(end);
    {
        AuditFile audit{file.name(), {.bytes = 300, .files = 4}};
        for (int i = 0; i < 4; ++i) audit.note({.what = "bound", .component = "navigation"});
    }
    EXPECT_EQ(content(file.name() + ".2"), ".1");
    EXPECT_EQ(content(file.name() + ".3"), ".3");
    EXPECT_EQ(content(file.name() + ".4"), ".4");
    EXPECT_GT(lines(content(file.name() + ".1")), 0u);
    for (auto const* end : {".1", ".2", ".3", ".4"}) std::filesystem::remove(file.name() + end);
}

TEST_F(OfAudit, HasOtherLimitsFromNowOn) {
    {
        AuditFile audit{file.name(), {}};
        audit.limit(1'000, 1);
        for (int i = 0; i < 100; ++i) audit.note({.what = "bound", .component = "navigation"});
    }
    EXPECT_LE(std::filesystem::file_size(file.name()), 1'000u);
    EXPECT_LE(std::filesystem::file_size(file.name() + ".1"), 1'000u);
    EXPECT_FALSE(std::filesystem::exists(file.name() + ".2"));
    std::filesystem::remove(file.name() + ".1");
}

// A folder in the way of the next file; root may write everywhere.
TEST_F(OfAudit, LosesNothingIfAnotherFileCannotBeBegun) {
    std::filesystem::create_directories(file.name() + ".1/in/the/way");
    {
        AuditFile audit{file.name(), {.bytes = 1'000, .files = 1}};
        for (int i = 0; i < 100; ++i) audit.note({.what = "bound", .component = "navigation"});
    }
    EXPECT_EQ(lines(content(file.name())), 100u);
    std::filesystem::remove_all(file.name() + ".1");
}

TEST_F(OfAudit, CountsLinesThatCannotBeWritten) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    auto small = before;
    small.rlim_cur = 300;  // as on a full disk
    {
        AuditFile audit{file.name(), {}};
        ::setrlimit(RLIMIT_FSIZE, &small);
        for (int i = 0; i < 20; ++i) audit.note({.what = "bound", .component = "navigation"});
        while (audit.lost() == 0) std::this_thread::yield();
        ::setrlimit(RLIMIT_FSIZE, &before);
        audit.note({.what = "released", .component = "navigation"});
    }
    std::istringstream text{content(file.name())};
    std::string last;
    for (std::string line; std::getline(text, line); last = line) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
    EXPECT_THAT(last, testing::HasSubstr("released"));
}

TEST_F(OfAudit, MustBeAFile) {
    auto const link = file.name() + "-link";
    std::filesystem::create_symlink(file.name(), link);
    for (auto const& name : {std::string{"/nowhere/at.all"}, std::string{"/dev/null"}, std::string{"/tmp"}, link})
        EXPECT_THROW((AuditFile{name, {}}), BadSettings) << name;
    std::filesystem::remove(link);
}

}  // namespace rois::test
