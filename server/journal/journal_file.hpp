// The journal's file: a database of SQLite with one table of records.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "journal/records.hpp"
#include "journal/step_mark.hpp"
#include "journal/stop_file.hpp"
#include "types/instant.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace rois::journal {

// The journal cannot be used. The message is one line that names the file.
class BadJournal : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Belongs to this process alone while it is open. Not thread-safe.
class JournalFile {
public:
    // Makes the folder and the file if they do not exist. All files in the folder together take at most `most_bytes`, unless the
    // database is larger already; then it does not grow. Throws BadJournal: the file is in use, damaged, of another program, or
    // of a later version.
    JournalFile(std::string const& folder, std::size_t most_bytes);
    ~JournalFile();
    JournalFile(JournalFile const&) = delete;
    JournalFile& operator=(JournalFile const&) = delete;

    std::string const& name() const { return name_; }

    // Returns all records, ordered by their keys. Throws BadJournal if one is damaged.
    std::vector<Record> read();

    enum class Result : std::uint8_t {
        stored,
        no_room,  // the disk or the file is full: nothing was changed, and a later attempt may succeed
        broken    // the system did not write what it was given: nothing may be acknowledged any more
    };
    // From now on, all files together take at most `most_bytes`, as in the constructor. False: there is no memory; call it again.
    bool limit(std::size_t most_bytes);

    // Makes all changes, or none of them. When it returns, they are on the disk.
    Result store(RecordChanges const&);
    // Whether the next steps delete records of sessions that have ended. `read` may return them.
    bool has_to_delete() const { return !ended_.empty(); }
    // Gives the database and SQLite's log their first megabyte, if there is room. To grow later would keep commands waiting:
    // the disk takes much longer to store a file that has grown, above all while other programs write.
    // Throws BadJournal if the disk does not write.
    void grow();
    // Moves what was stored from SQLite's log into the database, if the log has grown long.
    Result tidy();
    // Why the last `store` or `tidy` did not succeed.
    std::string const& problem() const { return problem_; }

    // The file beside it that keeps a stop. The writer takes it: it is not written by the same thread.
    StopFile& stop() { return *stop_; }
    std::unique_ptr<StopFile> take_stop() { return std::move(stop_); }

    // Whether the file and SQLite's log still have their names: otherwise the next start would not find them.
    bool is_in_place();

    // A part of the disk and a part of the database are kept for the ends of commands. Without both, no command should begin.
    // `keep_reserve` makes the part of the disk again, if it can, at most once a second.
    bool has_reserve() const { return has_reserve_ && used_pages_ + spare_pages_ <= most_pages_; }
    void keep_reserve(Steady now);

private:
    struct Close {
        void operator()(sqlite3*) const;
        void operator()(sqlite3_stmt*) const;
    };
    using Statement = std::unique_ptr<sqlite3_stmt, Close>;

    void check_log(bool is_new) const;
    void open();
    void check_header(bool is_new);
    void check_pages();
    void check_step(bool is_new);
    std::string said() const;
    bool run(char const* sql);
    std::int64_t number(char const* pragma);
    Statement prepared(char const* sql);
    Result attempt(RecordChanges const&);
    bool write(RecordChanges const&);
    bool delete_records_of(std::vector<std::uint64_t>& ended);
    void note_ended(std::vector<Record> const&);
    bool step(Statement&);
    void count_pages();
    Result judged();
    bool note_failure() noexcept;
    void roll_back();
    void give_up_reserve();
    [[noreturn]] void refuse(std::string const& why) const;

    std::string const name_;
    std::string const log_;  // of SQLite
    std::string const reserve_;
    StepMark mark_;
    Step step_;  // the last one that was stored
    std::unique_ptr<StopFile> stop_;
    ::ino_t inode_ = 0;      // of the database
    ::ino_t log_inode_ = 0;  // of SQLite's log; 0: not seen yet
    ::dev_t device_ = 0;
    std::unique_ptr<sqlite3, Close> database_;
    int log_pages_ = 0;
    std::int64_t most_pages_ = 0;   // of the database
    std::int64_t spare_pages_ = 0;  // of them: kept for the ends of commands
    std::int64_t used_pages_ = 0;   // of them: with records
    Statement begin_, commit_, rollback_, set_, erase_, forget_, end_, delete_, pages_, free_pages_;
    std::vector<std::uint64_t> ended_;  // sessions with records that are not deleted yet
    std::string problem_;
    int failure_ = 0;  // SQLite's code for it
    bool has_reserve_ = false;
    std::optional<Steady> tried_;  // to make the reserve
};

}  // namespace rois::journal
