#include "journal/journal_file.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <new>
#include <set>
#include <string_view>
#include <utility>

#include "journal/log_check.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"
#include "types/unique_descriptor.hpp"

namespace rois::journal {

namespace {

constexpr std::int64_t application = 0x526f4953;  // "RoIS"
constexpr std::int64_t version = 1;
constexpr std::size_t page = 4'096;
constexpr std::size_t page_in_log = page + 24;  // SQLite's log has a head before each page
constexpr int longest_log = 256;                // pages; no step begins behind more
constexpr std::size_t first_pages = 300;        // of the database and of its log
constexpr auto room = "room";                   // the kind of a record that only takes room, and is not read
constexpr std::size_t reserve_bytes = std::size_t{4} << 20;
constexpr std::int64_t most_deleted = 1'000;  // records of ended sessions in a step: some 5 ms

// Returns the largest number of pages of the database, so that all files together take at most `most_bytes`: the reserve, the
// database and its log. A step writes each page that it changes once into the log. So the log has at most `longest_log` pages,
// and those of one step, which may be all pages of the database. A few more pages are for the head of the log and the last page
// of a step, which SQLite may write twice.
std::int64_t most_pages(std::size_t most_bytes) {
    auto const fixed = reserve_bytes + (longest_log + 16) * page_in_log;
    return static_cast<std::int64_t>((most_bytes - fixed) / (page + page_in_log));
}

constexpr auto settings =
    "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 0;"
    "PRAGMA journal_size_limit = 2097152; PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON";
constexpr auto table =
    "CREATE TABLE record (kind TEXT NOT NULL, session INTEGER NOT NULL, key TEXT NOT NULL, value TEXT NOT NULL,"
    " sum INTEGER NOT NULL, PRIMARY KEY (kind, session, key)) STRICT, WITHOUT ROWID";

void put(sqlite3_stmt* statement, int place, std::string_view text) {
    sqlite3_bind_text64(statement, place, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
}

void put(sqlite3_stmt* statement, int place, std::uint64_t number) {
    sqlite3_bind_int64(statement, place, static_cast<sqlite3_int64>(number));
}

// `first`: the place of the first of the three.
void put(sqlite3_stmt* statement, int first, Key const& key) {
    put(statement, first, key.kind);
    put(statement, first + 1, key.session);
    put(statement, first + 2, key.key);
}

// SQLite checks its pages, but not whether the bytes in them are those that were written.
std::uint64_t sum_of(Record const& record) {
    boost::crc_32_type sum;
    auto const add = [&](std::string_view text) { sum.process_bytes(text.data(), text.size()); };
    add(record.key.kind);
    add(" ");
    add(std::to_string(record.key.session));
    add(" ");
    add(record.key.key);
    add(" ");
    add(record.value);
    return sum.checksum();
}

std::string text_at(sqlite3_stmt* row, int column) {
    auto const* text = reinterpret_cast<char const*>(sqlite3_column_text(row, column));
    return text == nullptr ? std::string{} : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

void make_folder(std::string const& folder) {
    if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST)
        throw BadJournal{"state: cannot make the folder " + rois::quoted(folder) + ": " + std::strerror(errno)};
}

// The file may come from a copy that everyone may read. It is not opened: closing it would end SQLite's lock.
void keep_to_owner(std::string const& name) {
    if (::chmod(name.c_str(), S_IRUSR | S_IWUSR) == 0 || errno == ENOENT) return;
    throw BadJournal{"state: cannot make " + rois::quoted(name) + " readable for its owner only: " + std::strerror(errno)};
}

// Returns whether the file is empty. Makes it if it does not exist: SQLite would let everyone read it.
bool make_file(std::string const& name) {
    UniqueDescriptor const file{::open(name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR)};
    struct stat found {};
    if (file.get() < 0 && errno == ELOOP) throw BadJournal{"state: " + rois::quoted(name) + " is a symbolic link"};
    if (file.get() < 0 || ::fstat(file.get(), &found) != 0)
        throw BadJournal{"state: cannot write " + rois::quoted(name) + ": " + std::strerror(errno)};
    if (!S_ISREG(found.st_mode)) throw BadJournal{"state: " + rois::quoted(name) + " is not a file"};
    return found.st_size == 0;
}

std::unique_ptr<StopFile> opened_stop(std::string const& name) {
    make_file(name);
    keep_to_owner(name);
    return std::make_unique<StopFile>(UniqueDescriptor{::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC)}, name);
}

// SQLite itself does not notice other bytes at the beginning of the file while its log has the first page.
void require_database(std::string const& name) {
    using namespace std::literals;
    constexpr auto begin = "SQLite format 3\0"sv;
    std::array<char, begin.size()> found{};
    UniqueDescriptor const file{::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (::pread(file.get(), found.data(), found.size(), 0) != std::ssize(found) ||
        std::string_view{found.data(), found.size()} != begin)
        throw BadJournal{"state: " + rois::quoted(name) + " is not a journal of rois-gateway, or it is damaged"};
}

}  // namespace

void JournalFile::Close::operator()(sqlite3* database) const { sqlite3_close(database); }
void JournalFile::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

JournalFile::JournalFile(std::string const& folder, std::size_t most_bytes)
    : name_{folder + "/journal.db"},
      log_{name_ + "-wal"},
      reserve_{folder + "/reserve"},
      mark_{folder + "/in_use"},
      log_pages_{longest_log} {  // an earlier process may have left a long log
    make_folder(folder);
    bool const is_new = make_file(name_);
    if (is_new)
        mark_.remove();  // that of an earlier journal
    else
        require_database(name_);
    check_log(is_new);
    open();
    check_header(is_new);
    for (auto const& each : {name_, log_}) keep_to_owner(each);
    struct stat found {};
    if (::lstat(name_.c_str(), &found) != 0) refuse("cannot be read");
    inode_ = found.st_ino;
    device_ = found.st_dev;
    if (!limit(most_bytes)) refuse("cannot be opened: " + said());
    begin_ = prepared("BEGIN IMMEDIATE");
    commit_ = prepared("COMMIT");
    rollback_ = prepared("ROLLBACK");
    set_ = prepared("INSERT OR REPLACE INTO record VALUES (?, ?, ?, ?, ?)");
    erase_ = prepared("DELETE FROM record WHERE kind = ? AND session = ? AND key = ?");
    forget_ = prepared("DELETE FROM record WHERE kind = ? AND session = ? AND key BETWEEN ? AND ?");
    end_ = prepared("DELETE FROM record WHERE kind = 'session' AND session = ?");
    delete_ = prepared(
        "DELETE FROM record WHERE session = ?1 AND (kind, key) IN (SELECT kind, key FROM record"
        " WHERE kind IN ('command', 'notification', 'subscription') AND session = ?1 LIMIT ?2)");
    pages_ = prepared("PRAGMA page_count");
    free_pages_ = prepared("PRAGMA freelist_count");
    check_step(is_new);
    count_pages();
    if (::lstat(reserve_.c_str(), &found) == 0 && !S_ISREG(found.st_mode))
        throw BadJournal{"state: " + rois::quoted(reserve_) + " is not a file"};
    keep_reserve(Steady::clock::now());
    stop_ = opened_stop(folder + "/stop");
    sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
}

// SQLite then moves its log into the database, and removes it.
JournalFile::~JournalFile() { mark_.remove(); }

void JournalFile::refuse(std::string const& why) const { throw BadJournal{"state: " + rois::quoted(name_) + " " + why}; }

// SQLite itself drops all steps behind a damaged place in its log, as after a write that was cut short.
void JournalFile::check_log(bool is_new) const {
    UniqueDescriptor const file{::open(log_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    struct stat found {};
    bool const is_missing = file.get() < 0 ? errno == ENOENT : ::fstat(file.get(), &found) == 0 && found.st_size == 0;
    if (is_missing) return;
    if (file.get() < 0 || ::fstat(file.get(), &found) != 0 || !S_ISREG(found.st_mode))
        throw BadJournal{"state: cannot read " + rois::quoted(log_)};
    if (is_new && found.st_size > 0) refuse("is missing or empty, and its log " + rois::quoted(log_) + " is not");
    if (is_damaged_log(file.get())) throw BadJournal{"state: " + rois::quoted(log_) + " is damaged"};
}

void JournalFile::open() {
    sqlite3* opened = nullptr;
    auto const result = sqlite3_open_v2(name_.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) refuse(std::string{"cannot be opened: "} + sqlite3_errstr(result));
    sqlite3_extended_result_codes(opened, 1);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);  // a refused file is not changed
}

// Looks who made the file before it changes anything.
void JournalFile::check_header(bool is_new) {
    auto const refuse_by = [&](int code) {
        if ((code & 0xff) == SQLITE_BUSY) refuse("is in use by another gateway or program");
        if ((code & 0xff) == SQLITE_READONLY) refuse("or its folder cannot be written: " + said());
        if ((code & 0xff) == SQLITE_FULL || (code & 0xff) == SQLITE_IOERR) refuse("cannot be read or written: " + said());
        if ((code & 0xff) == SQLITE_NOTADB) refuse("is not a journal of rois-gateway, or it is damaged");
        refuse("cannot be read, it may be damaged: " + said());
    };
    if (!run("PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE")) refuse_by(sqlite3_extended_errcode(database_.get()));
    auto const found = number("PRAGMA application_id");
    auto const found_version = number("PRAGMA user_version");
    // SQLite has just undone the work of a process that was killed while it made the database.
    struct stat now {};
    bool const is_empty = is_new || (::stat(name_.c_str(), &now) == 0 && now.st_size == 0);
    if (is_empty) {
        auto const mark = "PRAGMA application_id = " + std::to_string(application) +
                          "; PRAGMA user_version = " + std::to_string(version) + ";" + table;
        if (!run(mark.c_str())) refuse("cannot be written: " + said());
    } else if (found != application) {
        refuse("is not a journal of rois-gateway");
    } else if (found_version != version) {
        refuse("is of version " + std::to_string(found_version) + ": this gateway reads version " + std::to_string(version));
    }
    if (!run("COMMIT") || !run(settings)) refuse_by(sqlite3_extended_errcode(database_.get()));
    auto const note_log = [](void* self, sqlite3*, char const*, int pages) {
        static_cast<JournalFile*>(self)->log_pages_ = pages;
        return SQLITE_OK;
    };
    sqlite3_wal_hook(database_.get(), note_log, this);
    if (!is_empty) check_pages();
}

void JournalFile::check_pages() {
    auto const check = prepared("PRAGMA quick_check(1)");
    auto const result = sqlite3_step(check.get());
    if (result != SQLITE_ROW || text_at(check.get(), 0) != "ok") refuse("is damaged");
    auto const parts = prepared("SELECT sql FROM sqlite_schema");
    bool const is_ours = sqlite3_step(parts.get()) == SQLITE_ROW && text_at(parts.get(), 0) == table;
    if (!is_ours || sqlite3_step(parts.get()) != SQLITE_DONE) refuse("has other tables than a journal of rois-gateway");
}

void JournalFile::check_step(bool is_new) {
    auto const found = prepared("SELECT key, value FROM record WHERE kind = 'engine_step'");
    if (sqlite3_step(found.get()) == SQLITE_ROW) {
        step_ = {.journal = text_at(found.get(), 0), .number = to_number<std::uint64_t>(text_at(found.get(), 1)).value_or(0)};
    } else {
        std::array<unsigned char, 16> random{};
        sqlite3_randomness(random.size(), random.data());
        for (auto const byte : random) step_.journal += {"0123456789abcdef"[byte / 16], "0123456789abcdef"[byte % 16]};
    }
    auto const& left = mark_.left();
    if (left && !is_new && (left->journal != step_.journal || left->number > step_.number))
        refuse("is incomplete: the gateway did not end in order, and its log " + rois::quoted(log_) +
               " was removed, emptied or replaced");
}

// What SQLite says about its last failure. It may repeat bytes of the file, so it is quoted.
std::string JournalFile::said() const { return rois::quoted(sqlite3_errmsg(database_.get())); }

bool JournalFile::run(char const* sql) { return sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK; }

std::int64_t JournalFile::number(char const* pragma) {
    auto const statement = prepared(pragma);
    return sqlite3_step(statement.get()) == SQLITE_ROW ? sqlite3_column_int64(statement.get(), 0) : 0;
}

JournalFile::Statement JournalFile::prepared(char const* sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK)
        refuse("is damaged, or not a journal of rois-gateway: " + said());
    return Statement{statement};
}

std::vector<Record> JournalFile::read() {
    std::vector<Record> records;
    auto const all = prepared(
        "SELECT kind, session, key, value, sum FROM record WHERE kind NOT IN ('engine_step', 'room')"
        " ORDER BY kind, session, key");
    int result = SQLITE_ROW;
    while ((result = sqlite3_step(all.get())) == SQLITE_ROW) {
        auto* const row = all.get();
        auto& record = records.emplace_back();
        record.key = {text_at(row, 0), static_cast<std::uint64_t>(sqlite3_column_int64(row, 1)), text_at(row, 2)};
        record.value = text_at(row, 3);
        if (static_cast<std::uint64_t>(sqlite3_column_int64(row, 4)) != sum_of(record))
            refuse("is damaged: the bytes of the " + rois::quoted(record.key.kind) + " " + rois::quoted(record.key.key) +
                   " of session " + std::to_string(record.key.session) + " have changed");
    }
    if (result != SQLITE_DONE) refuse("is damaged: " + said());
    note_ended(records);
    return records;
}

// Sessions whose record is gone, while others of theirs are left.
void JournalFile::note_ended(std::vector<Record> const& records) {
    std::set<std::uint64_t> present, all;
    for (auto const& [key, value] : records) (key.kind == kind::session ? present : all).insert(key.session);
    present.insert(0);  // the engine's own records
    ended_.clear();
    std::ranges::set_difference(all, present, std::back_inserter(ended_));
}

bool JournalFile::step(Statement& statement) {
    bool const done = sqlite3_step(statement.get()) == SQLITE_DONE || note_failure();
    sqlite3_reset(statement.get());
    return done;
}

// Returns false.
bool JournalFile::note_failure() noexcept {
    failure_ = sqlite3_extended_errcode(database_.get());
    try {
        problem_ = said();
    } catch (std::bad_alloc const&) {
        problem_.clear();
    }
    return false;
}

bool JournalFile::write(RecordChanges const& changes) {
    if (!step(begin_)) return false;
    auto ended = ended_;
    for (auto const session : changes.ended) {
        put(end_.get(), 1, session);
        if (!step(end_)) return false;
        ended.push_back(session);
    }
    if (!delete_records_of(ended)) return false;  // first: that makes room
    for (auto const& key : changes.gone) {
        put(erase_.get(), 1, key);
        if (!step(erase_)) return false;
    }
    for (auto const& [first, last] : changes.forgotten) {
        put(forget_.get(), 1, first);
        put(forget_.get(), 4, last);
        if (!step(forget_)) return false;
    }
    auto const set = [this](Record const& record) {
        put(set_.get(), 1, record.key);
        put(set_.get(), 4, record.value);
        put(set_.get(), 5, sum_of(record));
        return step(set_);
    };
    if (!std::ranges::all_of(changes.set, set)) return false;
    if (!set({{"engine_step", 0, step_.journal}, std::to_string(step_.number + 1)}) || !step(commit_)) return false;
    ++step_.number;
    ended_ = std::move(ended);
    return true;
}

// Many are left for the next steps: commands would have to wait for them.
bool JournalFile::delete_records_of(std::vector<std::uint64_t>& ended) {
    for (auto left = most_deleted; !ended.empty(); ended.pop_back()) {
        put(delete_.get(), 1, ended.back());
        put(delete_.get(), 2, static_cast<std::uint64_t>(left));
        if (!step(delete_)) return false;
        left -= sqlite3_changes64(database_.get());
        if (left <= 0) break;
    }
    return true;
}

void JournalFile::roll_back() {
    if (sqlite3_get_autocommit(database_.get()) != 0) return;
    sqlite3_step(rollback_.get());
    sqlite3_reset(rollback_.get());
}

JournalFile::Result JournalFile::judged() {
    roll_back();
    switch (failure_) {
        case SQLITE_FULL:
        case SQLITE_NOMEM:
        case SQLITE_IOERR_NOMEM:
        case SQLITE_IOERR_WRITE:
            return Result::no_room;
        default:
            return Result::broken;
    }
}

JournalFile::Result JournalFile::store(RecordChanges const& changes) {
    auto result = attempt(changes);
    if (result == Result::no_room && has_reserve_) {
        give_up_reserve();
        result = attempt(changes);
    }
    if (result != Result::stored) return result;
    count_pages();
    mark_.set(step_);
    return result;
}

void JournalFile::grow() {
    Record const filling{{room, 0, {}}, std::string(first_pages * page, ' ')};
    for (auto const& changes : {RecordChanges{.set = {filling}}, RecordChanges{.gone = {filling.key}}})
        if (attempt(changes) == Result::broken) refuse("cannot be written: " + problem_);
    count_pages();
}

// Begins no step behind a long log, so that the log stays short. The step before may have ended for lack of memory.
JournalFile::Result JournalFile::attempt(RecordChanges const& changes) {
    roll_back();
    if (auto const tidied = tidy(); tidied != Result::stored) return tidied;
    return write(changes) ? Result::stored : judged();
}

bool JournalFile::limit(std::size_t most_bytes) {
    auto const most = most_pages(most_bytes);
    if (!run(("PRAGMA max_page_count = " + std::to_string(most)).c_str())) return false;
    most_pages_ = most;
    spare_pages_ = std::min<std::int64_t>(reserve_bytes / page, most / 4);
    return true;
}

// Keeps the last number if SQLite has no memory to count.
void JournalFile::count_pages() {
    auto const count = [](Statement& statement) -> std::optional<std::int64_t> {
        std::optional<std::int64_t> found;
        if (sqlite3_step(statement.get()) == SQLITE_ROW) found = sqlite3_column_int64(statement.get(), 0);
        sqlite3_reset(statement.get());
        return found;
    };
    auto const all = count(pages_), free = count(free_pages_);
    if (all && free) used_pages_ = *all - *free;
}

JournalFile::Result JournalFile::tidy() {
    if (log_pages_ < longest_log) return Result::stored;
    if (sqlite3_wal_checkpoint_v2(database_.get(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr) == SQLITE_OK) {
        log_pages_ = 0;
        return Result::stored;
    }
    note_failure();
    return judged();
}

// SQLite makes its log with the first step, and keeps it until the end.
bool JournalFile::is_in_place() {
    struct stat named {};
    if (::lstat(name_.c_str(), &named) != 0 || named.st_ino != inode_ || named.st_dev != device_) return false;
    bool const has_log = ::lstat(log_.c_str(), &named) == 0;
    if (log_inode_ == 0 && has_log) log_inode_ = named.st_ino;
    return log_inode_ == 0 || (has_log && named.st_ino == log_inode_);
}

void JournalFile::give_up_reserve() {
    ::unlink(reserve_.c_str());
    has_reserve_ = false;
    tried_ = Steady::clock::now();
}

void JournalFile::keep_reserve(Steady now) {
    if (has_reserve_ || (tried_ && now - *tried_ < std::chrono::seconds{1})) return;
    tried_ = now;
    UniqueDescriptor const file{::open(reserve_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR)};
    has_reserve_ =
        file.get() >= 0 && ::fchmod(file.get(), S_IRUSR | S_IWUSR) == 0 && ::posix_fallocate(file.get(), 0, reserve_bytes) == 0;
    if (!has_reserve_) ::unlink(reserve_.c_str());
}

}  // namespace rois::journal
