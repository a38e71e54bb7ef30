// The journal's file: what it keeps, and which files it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "journal/journal_file.hpp"
#include "journal/state_folder.hpp"
#include "kit/cpu_time.hpp"

namespace rois::journal {

namespace {

using test::StateFolder;
using testing::HasSubstr;

constexpr std::size_t plenty = std::size_t{512} << 20;

Record record(std::uint64_t session, std::string key, std::string value) {
    return {{kind::command, session, std::move(key)}, std::move(value)};
}

std::vector<std::string> keys_in(std::string const& folder) {
    std::vector<std::string> keys;
    for (auto const& each : JournalFile{folder, plenty}.read())
        keys.push_back(std::to_string(each.key.session) + " " + each.key.key + "=" + each.value);
    return keys;
}

// Why the folder is refused; empty: it is not.
std::string why_refused(std::string const& folder) {
    try {
        JournalFile{folder, plenty}.read();
        return {};
    } catch (BadJournal const& problem) {
        EXPECT_EQ(std::ranges::count(std::string{problem.what()}, '\n'), 0);
        EXPECT_THAT(problem.what(), HasSubstr(folder));
        return problem.what();
    }
}

void run_sql(std::string const& file, std::string const& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
}

void write(std::string const& file, std::string const& text) { std::ofstream{file} << text; }

struct JournalsFile : testing::Test {
    void store(RecordChanges const& changes) {
        JournalFile file{folder.name(), plenty};
        ASSERT_EQ(file.store(changes), JournalFile::Result::stored);
    }
    StateFolder const folder;
};

}  // namespace

TEST_F(JournalsFile, KeepsWhatWasStored) {
    store({.set = {record(1, "a", "x"), record(2, "b", "y")}});
    store({.set = {record(1, "a", "z"), record(1, "c", "with \"'<&> and \n")}});
    EXPECT_THAT(keys_in(folder.name()), testing::ElementsAre("1 a=z", "1 c=with \"'<&> and \n", "2 b=y"));
}

TEST_F(JournalsFile, ForgetsWhatIsGone) {
    store({.set = {record(1, "a", "1"), record(1, "b", "2"), record(1, "c", "3"), record(1, "d", "4"), record(2, "a", "5")}});
    store({.gone = {{kind::command, 1, "d"}}, .forgotten = {{{kind::command, 1, "b"}, "c"}}});
    EXPECT_THAT(keys_in(folder.name()), testing::ElementsAre("1 a=1", "2 a=5"));
    store({.ended = {2}});
    EXPECT_THAT(keys_in(folder.name()), testing::ElementsAre("1 a=1"));
}

TEST_F(JournalsFile, DeletesManyRecordsOfASessionInSeveralSteps) {
    StateFolder const crashed;
    auto const steps_to_delete = [](JournalFile& file) {
        int steps = 0;
        for (; file.has_to_delete() && steps < 10; ++steps) EXPECT_EQ(file.store({}), JournalFile::Result::stored);
        return steps;
    };
    {
        JournalFile file{folder.name(), plenty};
        RecordChanges all{.set = {{{kind::session, 1, {}}, "{}"}, {{kind::session, 2, {}}, "{}"}, record(2, "a", "1")}};
        for (int i = 0; i < 2'500; ++i) all.set.push_back(record(1, std::to_string(i), "x"));
        file.store(all);
        EXPECT_EQ(file.store({.ended = {1}}), JournalFile::Result::stored);
        std::filesystem::copy(folder.name(), crashed.name(), std::filesystem::copy_options::recursive);
        EXPECT_EQ(steps_to_delete(file), 2);
        EXPECT_EQ(file.read().size(), 2U);
    }
    JournalFile next{crashed.name(), plenty};
    EXPECT_EQ(next.read().size(), 1'502U) << "the record of the session itself is gone";
    EXPECT_EQ(steps_to_delete(next), 2) << "also after a crash";
    EXPECT_EQ(next.read().size(), 2U);
}

TEST_F(JournalsFile, CanOnlyBeReadByItsOwner) {
    store({.set = {record(1, "a", "x")}});
    struct stat found {};
    ASSERT_EQ(::stat(folder.file().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0600);
    ASSERT_EQ(::chmod(folder.file().c_str(), 0666), 0);
    store({.set = {record(1, "b", "x")}});
    ASSERT_EQ(::stat(folder.file().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0600) << "also if it comes from elsewhere";
}

TEST_F(JournalsFile, HasItsRoomBeforeItIsNeeded) {
    JournalFile file{folder.name(), plenty};
    file.grow();
    EXPECT_THAT(file.read(), testing::IsEmpty());
    auto const size_of = [&](std::string const& end) { return std::filesystem::file_size(file.name() + end); };
    EXPECT_EQ(file.store({.set = {record(1, "first", "x")}}), JournalFile::Result::stored);
    auto const database = size_of(""), log = size_of("-wal");
    for (int i = 0; i < 1'000; ++i) {
        ASSERT_EQ(file.store({.set = {record(1, std::to_string(i), std::string(400, 'x'))}}), JournalFile::Result::stored);
        ASSERT_EQ(file.tidy(), JournalFile::Result::stored);
    }
    EXPECT_EQ(size_of(""), database);
    EXPECT_EQ(size_of("-wal"), log);
    EXPECT_EQ(file.read().size(), 1'001U);
}

TEST_F(JournalsFile, IsReadWithoutTheRoomThatACrashHasLeft) {
    store({.set = {record(1, "a", "x")}});
    auto const left = "INSERT INTO record VALUES ('room', 0, '', '   ', 0)";
    run_sql(folder.name() + "/journal.db", left);
    EXPECT_THAT(keys_in(folder.name()), testing::ElementsAre("1 a=x"));
    JournalFile{folder.name(), plenty}.grow();
    run_sql(folder.name() + "/journal.db", left);  // fails if it is still there
}

TEST_F(JournalsFile, KnowsWhetherItWasMovedOrReplaced) {
    JournalFile file{folder.name(), plenty};
    EXPECT_TRUE(file.is_in_place());
    std::filesystem::rename(folder.file(), folder.file() + ".moved");
    EXPECT_FALSE(file.is_in_place());
    std::ofstream{folder.file()} << "another one";
    EXPECT_FALSE(file.is_in_place());
}

TEST_F(JournalsFile, KnowsWhetherItsLogWasRemoved) {
    JournalFile file{folder.name(), plenty};
    EXPECT_EQ(file.store({.set = {record(1, "a", "x")}}), JournalFile::Result::stored);
    EXPECT_TRUE(file.is_in_place());
    std::filesystem::remove(folder.file() + "-wal");
    EXPECT_FALSE(file.is_in_place());
}

TEST_F(JournalsFile, KeepsAStopWithoutNeedingRoom) {
    for (bool const stopped : {true, false}) {
        {
            JournalFile file{folder.name(), plenty};
            EXPECT_NE(file.stop().is_stopped(), stopped);
            EXPECT_TRUE(file.stop().keep(stopped));
        }
        EXPECT_EQ((JournalFile{folder.name(), plenty}.stop().is_stopped()), stopped);
        EXPECT_EQ(std::filesystem::file_size(folder.name() + "/stop"), 1U);
    }
}

TEST_F(JournalsFile, IsMadeWithItsFolder) {
    auto const below = folder.name() + "/below";
    EXPECT_EQ(why_refused(below), "");
    EXPECT_THAT(why_refused(below + "/missing/folder"), HasSubstr("cannot make the folder"));
}

// The first start was killed while it made the database.
TEST_F(JournalsFile, IsMadeAgainIfItWasOnlyBegun) {
    StateFolder const begun;
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(begun.file().c_str(), &database), SQLITE_OK);
    auto const sql =
        "PRAGMA cache_size = 1; BEGIN EXCLUSIVE; CREATE TABLE t (x); INSERT INTO t"
        " WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 10000) SELECT randomblob(100) FROM n";
    ASSERT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    std::filesystem::copy(begun.name(), folder.name(), std::filesystem::copy_options::recursive);
    sqlite3_close(database);
    std::fstream{folder.file(), std::ios::in | std::ios::out} << "SQLite format 3";
    ASSERT_GT(std::filesystem::file_size(folder.file()), 0U);
    EXPECT_EQ(why_refused(folder.name()), "");
    store({.set = {record(1, "a", "x")}});
    EXPECT_THAT(keys_in(folder.name()), testing::ElementsAre("1 a=x"));
}

TEST_F(JournalsFile, BelongsToOneGatewayAtATime) {
    JournalFile const file{folder.name(), plenty};
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("is in use by another gateway"));
}

TEST_F(JournalsFile, NeedsAFileForItsReserve) {
    std::filesystem::create_directory(folder.name() + "/reserve");
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("/reserve' is not a file"));
}

TEST_F(JournalsFile, WithATriggerIsRefused) {
    store({.set = {record(1, "a", "x")}});
    run_sql(folder.file(), "CREATE TRIGGER t AFTER INSERT ON record BEGIN DELETE FROM record; END");
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("has other tables"));
}

TEST_F(JournalsFile, ThatIsASymbolicLinkIsRefused) {
    ASSERT_EQ(::symlink("elsewhere", folder.file().c_str()), 0);
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("is a symbolic link"));
}

// As after a crash: the log has not been moved into the database.
struct JournalsLog : JournalsFile {
    JournalsLog() {
        JournalFile file{folder.name(), plenty};
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(file.store({.set = {record(1, std::to_string(i), std::string(3'000, 'x'))}}), JournalFile::Result::stored);
        std::filesystem::copy(folder.name(), crashed.name(), std::filesystem::copy_options::recursive);
    }
    std::string log() const { return crashed.file() + "-wal"; }
    void change(std::uintmax_t place) {
        std::fstream file{log(), std::ios::in | std::ios::out | std::ios::binary};
        file.seekg(static_cast<std::streamoff>(place));
        auto const byte = static_cast<char>(file.get() ^ 1);
        file.seekp(static_cast<std::streamoff>(place));
        file.put(byte);
    }
    StateFolder const crashed;
};

TEST_F(JournalsLog, IsRead) { EXPECT_EQ(keys_in(crashed.name()).size(), 20U); }

TEST_F(JournalsLog, ThatWasRemovedOrEmptiedIsMissed) {
    std::filesystem::resize_file(log(), 0);
    EXPECT_THAT(why_refused(crashed.name()), HasSubstr("is incomplete"));
    std::filesystem::remove(log());
    EXPECT_THAT(why_refused(crashed.name()), HasSubstr("is incomplete"));
    std::filesystem::remove(crashed.file());
    EXPECT_EQ(why_refused(crashed.name()), "") << "without the database, a new journal begins";
}

TEST_F(JournalsLog, IsNotMissedAfterAnOrderlyEnd) {
    static_cast<void>(keys_in(crashed.name()));
    EXPECT_FALSE(std::filesystem::exists(log()));
    EXPECT_EQ(keys_in(crashed.name()).size(), 20U);
}

TEST_F(JournalsLog, IsLeftAloneIfTheJournalIsRefused) {
    std::filesystem::remove(crashed.name() + "/stop");
    std::filesystem::create_directory(crashed.name() + "/stop");
    EXPECT_THAT(why_refused(crashed.name()), HasSubstr("/stop'"));
    EXPECT_GT(std::filesystem::file_size(log()), 0U);
    std::filesystem::remove(crashed.name() + "/stop");
    EXPECT_EQ(keys_in(crashed.name()).size(), 20U);
}

TEST_F(JournalsLog, ThatWasCutShortIsMissed) {
    std::filesystem::resize_file(log(), std::filesystem::file_size(log()) - 100);
    EXPECT_THAT(why_refused(crashed.name()), HasSubstr("is incomplete"));
}

TEST_F(JournalsLog, MayEndInTheMiddleOfAStepThatWasNotStored) {
    std::filesystem::resize_file(log(), std::filesystem::file_size(log()) - 100);
    std::fstream{crashed.name() + "/in_use"}.seekp(33) << "19";
    EXPECT_EQ(keys_in(crashed.name()).size(), 19U);
}

TEST_F(JournalsLog, ThatWasReplacedIsMissed) {
    StateFolder const another;
    JournalFile file{another.name(), plenty};
    for (int i = 0; i < 50; ++i) file.store({.set = {record(1, "another", "x")}});
    std::filesystem::copy_file(another.file() + "-wal", log(), std::filesystem::copy_options::overwrite_existing);
    EXPECT_NE(why_refused(crashed.name()), "");
    for (auto const& text : {std::string(50'000, '\0'), std::string(50'000, 'x'), std::string{"text"}}) {
        write(log(), text);
        EXPECT_NE(why_refused(crashed.name()), "") << text.substr(0, 4);
    }
}

TEST_F(JournalsLog, HasNoStepOfAnEarlierJournal) {
    std::filesystem::remove(crashed.file());
    std::filesystem::remove(log());
    write(crashed.name() + "/in_use", std::string(32, '0') + " 1000");
    StateFolder const before_its_first_step, again;
    {
        JournalFile file{crashed.name(), plenty};
        std::filesystem::copy(crashed.name(), before_its_first_step.name(), std::filesystem::copy_options::recursive);
        file.store({.set = {record(1, "a", "x")}});
        std::filesystem::copy(crashed.name(), again.name(), std::filesystem::copy_options::recursive);
    }
    EXPECT_THAT(keys_in(before_its_first_step.name()), testing::IsEmpty());
    EXPECT_THAT(keys_in(again.name()), testing::ElementsAre("1 a=x"));
}

TEST_F(JournalsLog, MayBeMovedIntoTheDatabaseByAnotherProgram) {
    run_sql(crashed.file(), "SELECT kind FROM record");
    EXPECT_FALSE(std::filesystem::exists(log()));
    EXPECT_EQ(keys_in(crashed.name()).size(), 20U);
}

TEST_F(JournalsLog, ThatIsDamagedIsRefused) {
    for (std::uintmax_t const place : {8U, 20U, 40U, 60U, 5'000U, 40'000U}) {
        change(place);
        EXPECT_THAT(why_refused(crashed.name()), HasSubstr("-wal' is damaged")) << place;
        change(place);
    }
    EXPECT_EQ(keys_in(crashed.name()).size(), 20U);
}

TEST_F(JournalsLog, WithoutItsBeginningIsRefused) {
    for (std::size_t const length : {512U, 8'192U}) {  // its head and parts of its frames
        std::fstream{log(), std::ios::in | std::ios::out | std::ios::binary} << std::string(length, '\0');
        EXPECT_THAT(why_refused(crashed.name()), HasSubstr("-wal' is damaged")) << length;
    }
}

TEST_F(JournalsLog, WithoutItsDatabaseIsRefused) {
    std::filesystem::resize_file(crashed.file(), 0);
    EXPECT_THAT(why_refused(crashed.name()), HasSubstr("is missing or empty"));
}

TEST_F(JournalsFile, OfAnotherProgramIsRefused) {
    write(folder.file(), "This is not a database, but a text that someone has put here.\n");
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("is not a journal of rois-gateway"));
}

TEST_F(JournalsFile, OfAnotherDatabaseIsRefusedAndNotChanged) {
    run_sql(folder.file(), "CREATE TABLE record (kind TEXT); INSERT INTO record VALUES ('x')");
    ASSERT_EQ(::chmod(folder.file().c_str(), 0644), 0);
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("is not a journal of rois-gateway"));
    run_sql(folder.file(), "SELECT kind FROM record");
    struct stat found {};
    ASSERT_EQ(::stat(folder.file().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0644);
}

TEST_F(JournalsFile, OfALaterVersionIsRefused) {
    store({.set = {record(1, "a", "x")}});
    run_sql(folder.file(), "PRAGMA user_version = 2");
    EXPECT_THAT(why_refused(folder.name()), HasSubstr("is of version 2"));
}

TEST_F(JournalsFile, ThatIsNoFileIsRefused) {
    ASSERT_EQ(::mkdir(folder.file().c_str(), 0700), 0);
    EXPECT_NE(why_refused(folder.name()), "");
}

// Each changed byte is noticed, or changes nothing that is read.
TEST_F(JournalsFile, WithChangedBytesIsNeverReadWrongly) {
    std::vector<Record> records;
    for (int i = 0; i < 200; ++i) records.push_back(record(1, "command-" + std::to_string(i), std::string(100, 'x')));
    store({.set = records});
    auto const right = keys_in(folder.name());
    std::string bytes;
    {
        std::ifstream in{folder.file(), std::ios::binary};
        bytes.assign(std::istreambuf_iterator<char>{in}, {});
    }
    int refused = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 97) {
        auto changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 0x24);
        write(folder.file(), changed);
        if (why_refused(folder.name()).empty())
            EXPECT_EQ(keys_in(folder.name()), right) << "byte " << at;
        else
            ++refused;
    }
    EXPECT_GT(refused, 10);
}

TEST_F(JournalsFile, CutShortIsRefused) {
    std::vector<Record> records;
    for (int i = 0; i < 200; ++i) records.push_back(record(1, "command-" + std::to_string(i), std::string(100, 'x')));
    store({.set = records});
    std::string bytes;
    {
        std::ifstream in{folder.file(), std::ios::binary};
        bytes.assign(std::istreambuf_iterator<char>{in}, {});
    }
    for (auto const part : {0.9, 0.5, 0.1}) {
        write(folder.file(), bytes.substr(0, static_cast<std::size_t>(static_cast<double>(bytes.size()) * part)));
        EXPECT_NE(why_refused(folder.name()), "") << part;
    }
}

TEST_F(JournalsFile, ThatIsFullChangesNothingAndTakesMoreWhenThereIsRoom) {
    JournalFile file{folder.name(), std::size_t{10} << 20};
    auto const large = [](std::uint64_t session) { return record(session, "large", std::string(1 << 20, 'x')); };
    auto result = JournalFile::Result::stored;
    std::uint64_t session = 0;
    while (result == JournalFile::Result::stored && session < 20) {
        result = file.store({.set = {large(++session)}});
        file.tidy();
    }
    EXPECT_EQ(result, JournalFile::Result::no_room);
    EXPECT_EQ(file.read().size(), session - 1);
    EXPECT_EQ(file.store({.ended = {1, 2}}), JournalFile::Result::stored);
    EXPECT_EQ(file.store({.set = {large(session)}}), JournalFile::Result::stored);
}

// A step that changes all records writes as many pages into SQLite's log as the database has.
TEST_F(JournalsFile, TakesNoMoreThanItsLimitWithItsLogAndTheReserve) {
    constexpr std::size_t most = 10'000'000;
    auto const at = Steady::clock::now();
    std::uintmax_t largest = 0;
    std::uint64_t sessions = 0;
    int refused = 0;
    for (int start = 0; start < 4; ++start) {
        JournalFile file{folder.name(), most};
        for (int step = 1; step <= 20; ++step) {
            auto const text = std::string(200'000, static_cast<char>('a' + step));
            RecordChanges changes{.set = {record(sessions + 1, "large", text)}};
            for (std::uint64_t session = 1; step % 3 == 0 && session <= sessions; ++session)
                changes.set.push_back(record(session, "large", text));
            auto const result = file.store(changes);
            ASSERT_NE(result, JournalFile::Result::broken) << file.problem();
            if (result == JournalFile::Result::stored) ++sessions;
            if (result == JournalFile::Result::no_room) ++refused;
            file.keep_reserve(at + std::chrono::hours{20 * start + step});
            largest = std::max(largest, folder.bytes());
            if (start % 2 == 1) file.tidy();
        }
        EXPECT_FALSE(file.has_reserve()) << "no command may begin";
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(sessions, 5U);
    EXPECT_LE(largest, most);
    JournalFile file{folder.name(), most};
    EXPECT_EQ(file.read().size(), sessions);
    EXPECT_EQ(file.store({.ended = {1, 2, 3, 4, 5}}), JournalFile::Result::stored);
    file.keep_reserve(at + std::chrono::hours{1'000});
    EXPECT_TRUE(file.has_reserve()) << "commands may begin again";
}

TEST_F(JournalsFile, HasAnotherLimitFromNowOn) {
    JournalFile file{folder.name(), 10'000'000};
    auto const large = [&](std::uint64_t session) {
        return file.store({.set = {record(session, "large", std::string(1'500'000, 'x'))}});
    };
    EXPECT_EQ(large(1), JournalFile::Result::stored);
    EXPECT_EQ(large(2), JournalFile::Result::no_room);
    EXPECT_TRUE(file.limit(plenty));
    EXPECT_EQ(large(2), JournalFile::Result::stored);
    file.keep_reserve(Steady::clock::now() + std::chrono::hours{1});
    EXPECT_TRUE(file.has_reserve());
    EXPECT_TRUE(file.limit(10'000'000));
    EXPECT_FALSE(file.has_reserve()) << "the database is larger: no command may begin";
    EXPECT_EQ(file.store({.ended = {1}}), JournalFile::Result::stored);
    EXPECT_EQ(large(1), JournalFile::Result::stored) << "it does not grow";
}

TEST_F(JournalsFile, IsReadQuickly) {
    if (kit::has_sanitizer) GTEST_SKIP() << "sanitizers are slow";
    constexpr int many = 100'000;
    RecordChanges changes;
    for (int i = 0; i < many; ++i)
        changes.set.push_back(record(static_cast<std::uint64_t>(i % 100), "command-" + std::to_string(i), std::string(200, 'x')));
    store(changes);
    JournalFile file{folder.name(), plenty};
    std::vector<Record> records;
    EXPECT_LT(kit::cpu_time_of([&] { records = file.read(); }), std::chrono::seconds{2});
    EXPECT_EQ(records.size(), static_cast<std::size_t>(many));
}

}  // namespace rois::journal
