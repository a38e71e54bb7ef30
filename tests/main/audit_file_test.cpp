// The file of the audit log.
#include "main/audit_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

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
