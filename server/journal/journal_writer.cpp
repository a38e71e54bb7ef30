#include "journal/journal_writer.hpp"

#include <chrono>
#include <new>
#include <utility>

#include "types/instant.hpp"

namespace rois::journal {

namespace {

constexpr std::chrono::milliseconds slow{500};  // a step takes some milliseconds; after a second, commands are refused
constexpr auto no_room =
    "the journal has no room, because the disk is full or state_bytes is reached: no command or subscription begins until it has";

}  // namespace

JournalWriter::JournalWriter(std::unique_ptr<JournalFile> file, Calls calls)
    : stop_{file->take_stop()}, file_{std::move(file)}, calls_{std::move(calls)}, has_room_{file_->has_reserve()} {
    if (!has_room_) calls_.say(no_room);
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
    stops_thread_ = std::jthread{[this](std::stop_token const& stop) { run_stops(stop); }};
}

JournalWriter::~JournalWriter() = default;

void JournalWriter::store(std::shared_ptr<Changes const> changes) noexcept {
    {
        std::lock_guard const lock{mutex_};
        next_ = std::move(changes);
    }
    news_.notify_all();
}

void JournalWriter::keep_stop(bool is_stopped) noexcept {
    {
        std::lock_guard const lock{mutex_};
        next_stop_ = is_stopped;
    }
    news_.notify_all();
}

void JournalWriter::limit(std::size_t bytes) {
    {
        std::lock_guard const lock{mutex_};
        next_limit_ = bytes;
    }
    news_.notify_all();
}

bool JournalWriter::finish(std::chrono::milliseconds longest) {
    thread_.request_stop();
    stops_thread_.request_stop();
    std::unique_lock lock{mutex_};
    return news_.wait_for(lock, longest, [this] { return is_closed_ && !next_stop_; });
}

std::string JournalWriter::why_no_commands() const {
    if (has_room_) return {};
    return no_room;
}

// Looks now and then whether a full disk has room again, also without changes.
void JournalWriter::run(std::stop_token const& stop) {
    std::optional<std::size_t> limit;
    bool can_delete = true;
    std::unique_lock lock{mutex_};
    while (true) {
        auto const longest = std::chrono::seconds{can_delete && file_->has_to_delete() ? 0 : 1};
        news_.wait_for(lock, stop, longest, [this] { return next_ != nullptr || next_limit_; });
        auto const changes = std::exchange(next_, nullptr);
        if (next_limit_) limit = std::exchange(next_limit_, std::nullopt);
        if (changes == nullptr && stop.stop_requested()) break;
        lock.unlock();
        if (!file_->is_in_place()) note_broken("it was moved or removed");
        if (limit && uses(*limit)) limit.reset();
        if (changes != nullptr) write(*changes);
        can_delete = changes != nullptr || !file_->has_to_delete() || delete_more();
        note_room();
        lock.lock();
    }
    lock.unlock();
    file_.reset();  // SQLite moves its log into the database, and waits for the disk
    lock.lock();
    is_closed_ = true;
    news_.notify_all();
}

void JournalWriter::run_stops(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    while (news_.wait(lock, stop, [this] { return next_stop_.has_value(); })) {
        auto const is_stopped = *next_stop_;
        lock.unlock();
        if (!stop_->keep(is_stopped)) calls_.broken("the file that keeps a stop could not be written");
        lock.lock();
        if (next_stop_ == is_stopped) next_stop_.reset();
        news_.notify_all();
    }
}

// False: there is no memory.
bool JournalWriter::uses(std::size_t limit) {
    try {
        return file_->limit(limit);
    } catch (std::bad_alloc const&) {
        return false;
    }
}

void JournalWriter::write(Changes const& changes) {
    auto const begin = std::chrono::steady_clock::now();
    auto result = JournalFile::Result::no_room;
    try {
        result = file_->store(records_of(changes));
        if (result == JournalFile::Result::no_room && !std::exchange(is_failing_, true))
            calls_.say("not stored, and tried again: " + file_->problem());
        auto const time = std::chrono::steady_clock::now() - begin;
        if (time >= slow) calls_.say("storing took " + in_seconds(time) + ": the disk is slow");
    } catch (std::bad_alloc const&) {  // `done` says whether they are stored
        is_failing_ = false;           // the log gets the reason the next time
    }
    if (result == JournalFile::Result::broken) return note_broken(file_->problem());
    bool const stored = result == JournalFile::Result::stored;
    if (stored) is_failing_ = false;
    ++(stored ? stored_ : not_stored_);
    calls_.done(stored);
    if (file_->tidy() == JournalFile::Result::broken) note_broken(file_->problem());
}

// Returns false if the disk has no room now.
bool JournalWriter::delete_more() {
    auto result = JournalFile::Result::no_room;
    try {
        result = file_->store({});
    } catch (std::bad_alloc const&) {
        return false;
    }
    if (result == JournalFile::Result::broken) note_broken(file_->problem());
    return result == JournalFile::Result::stored;
}

void JournalWriter::note_broken(std::string_view problem) {
    std::string why;
    try {
        why = file_->name() + ": " + std::string{problem};
    } catch (std::bad_alloc const&) {
        why = "the journal";  // fits without memory
    }
    calls_.broken(why);
}

void JournalWriter::note_room() {
    file_->keep_reserve(std::chrono::steady_clock::now());
    if (has_room_.exchange(file_->has_reserve()) == file_->has_reserve()) return;
    try {
        calls_.say(file_->has_reserve() ? "the journal has room again" : no_room);
    } catch (std::bad_alloc const&) {
        return;  // a line less in the log
    }
}

}  // namespace rois::journal
