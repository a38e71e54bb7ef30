#include "main/audit_file.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "main/settings.hpp"
#include "types/instant.hpp"
#include "types/text/texts.hpp"
#include "types/unique_descriptor.hpp"

namespace rois {

namespace {

std::string line_of(AuditEntry const& entry, std::uint64_t left_out) {
    nlohmann::ordered_json line{{"time", to_text(std::chrono::system_clock::now())}, {"what", entry.what}};
    auto const add = [&](char const* key, std::string_view value) {
        if (!value.empty()) line[key] = value;
    };
    add("token", entry.token);
    if (entry.session != 0) line["session"] = entry.session;
    add("address", entry.address);
    add("component", entry.component);
    add("operation", entry.operation);
    add("outcome", entry.outcome);
    if (left_out != 0) line["left_out"] = left_out;
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

// Whether the file is empty, or begins with a line of line_of(), which may have been cut short.
bool is_audit_log(UniqueDescriptor const& file) {
    constexpr std::string_view begin = R"({"time":"0000-00-00T00:00:00.000Z","what":")";
    std::array<char, begin.size()> found{};
    auto const size = ::pread(file.get(), found.data(), found.size(), 0);
    for (::ssize_t i = 0; i < size; ++i) {
        auto const at = static_cast<std::size_t>(i);
        bool const is_digit = found.at(at) >= '0' && found.at(at) <= '9';
        if (begin[at] == '0' ? !is_digit : found.at(at) != begin[at]) return false;
    }
    return size >= 0;
}

// A process that was killed may have written a part of it.
void end_last_line(UniqueDescriptor const& file) {
    struct stat found {};
    char last = '\n';
    if (::fstat(file.get(), &found) == 0 && found.st_size > 0 && ::pread(file.get(), &last, 1, found.st_size - 1) == 1 &&
        last != '\n')
        write_all(file, "\n");
}

std::size_t size_of(UniqueDescriptor const& file) {
    struct stat found {};
    return ::fstat(file.get(), &found) == 0 ? static_cast<std::size_t>(found.st_size) : 0;
}

}  // namespace

AuditFile::AuditFile(std::string file, Limits const& limits) try
    : limits_{limits}, bytes_{limits.bytes}, files_{limits.files}, name_{std::move(file)} {
    open();
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
} catch (BadSettings const& problem) {
    throw BadSettings{std::string{"audit_log: "} + problem.what()};
}

AuditFile::~AuditFile() = default;

void AuditFile::note(AuditEntry const& entry) noexcept {
    try {
        std::lock_guard const lock{mutex_};
        std::uint64_t left_out = 0;
        if (!may_say(entry, left_out)) return;
        if (lines_.size() >= limits_.waiting) {
            ++lost_;
            return;
        }
        lines_.push_back(line_of(entry, left_out));
        news_.notify_one();
    } catch (...) {
        ++lost_;  // there is no memory
    }
}

bool AuditFile::may_say(AuditEntry const& entry, std::uint64_t& left_out) {
    bool const is_refusal = entry.what == "refused";
    if (!is_refusal && entry.what != "connected" && entry.what != "resumed" && entry.what != "disconnected") return true;
    auto const now = limits_.now();
    auto& second = seconds_[{std::string{entry.token}, is_refusal}];
    if (now - second.since >= std::chrono::seconds{1}) second = {now, 0, second.left_out};
    if (++second.lines <= limits_.most_a_second) {
        left_out = std::exchange(second.left_out, 0);
        return true;
    }
    ++second.left_out;
    return false;
}

// Lines that were left out are counted after a quiet second, and at the end, if no later line has done so.
void AuditFile::run(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    while (true) {
        news_.wait_for(lock, stop, std::chrono::seconds{1}, [this] { return !lines_.empty(); });
        if (lines_.empty()) sum_up();
        if (lines_.empty()) {
            if (stop.stop_requested()) return;
            continue;
        }
        auto const line = std::move(lines_.front());
        lines_.pop_front();
        lock.unlock();
        write(line);
        lock.lock();
    }
}

void AuditFile::sum_up() {
    try {
        for (auto& [of, second] : seconds_) {
            auto const& [token, is_refusal] = of;
            if (second.left_out == 0) continue;
            lines_.push_back(
                line_of({.what = "left out", .token = token, .outcome = is_refusal ? "refusals" : "sessions"}, second.left_out));
            second.left_out = 0;
        }
    } catch (std::bad_alloc const&) {
        return;  // the next line counts them
    }
}

// Only its owner may read a file that says who did what.
void AuditFile::open() {
    UniqueDescriptor file{
        ::open(name_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR)};
    struct stat found {};
    if (file.get() < 0 || ::fstat(file.get(), &found) != 0)
        throw BadSettings{"cannot write " + rois::quoted(name_) + ": " + std::strerror(errno)};
    if (!S_ISREG(found.st_mode)) throw BadSettings{rois::quoted(name_) + " is not a file"};
    if (!is_audit_log(file)) throw BadSettings{rois::quoted(name_) + " is another file: expected an audit log, or no file"};
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
        throw BadSettings{rois::quoted(name_) + (errno == EWOULDBLOCK
                                                     ? " is in use by another gateway: each needs its own"
                                                     : std::string{" cannot be locked: "} + std::strerror(errno))};
    ::fchmod(file.get(), S_IRUSR | S_IWUSR);
    try {
        end_last_line(file);
    } catch (std::system_error const& problem) {  // the disk is full: later lines may be lost, too
        spdlog::error("audit_log: its last line is incomplete: {}", problem.what());
    }
    file_ = std::move(file);
}

// If that is not possible, the present file grows: no line is lost.
void AuditFile::begin_another() {
    try {
        auto const path = std::filesystem::path{name_};
        auto const earlier = [&](std::size_t number) {
            auto const name = path.stem().string() + (number == 0 ? "" : "." + std::to_string(number));
            return path.parent_path() / (name + path.extension().string());
        };
        // Moves only the files before the first free number: after a failure, the others must stay.
        std::size_t free = 1;
        while (free < files_ && std::filesystem::exists(earlier(free))) ++free;
        // A file of another program that has taken its place is not touched.
        for (auto number = is_in_place() ? free : 0; number > 0; --number)
            std::filesystem::rename(earlier(number - 1), earlier(number));
        open();
        cannot_begin_ = false;
    } catch (std::exception const& problem) {
        if (!std::exchange(cannot_begin_, true)) spdlog::error("audit_log: {}; the present file grows", problem.what());
    }
}

// Another program may have moved or removed the file.
bool AuditFile::is_in_place() const {
    struct stat ours {};
    struct stat named {};
    return ::fstat(file_.get(), &ours) == 0 && ::stat(name_.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
           ours.st_dev == named.st_dev;
}

void AuditFile::begin_again() {
    try {
        open();
        cannot_begin_ = false;
    } catch (std::exception const& problem) {
        if (!std::exchange(cannot_begin_, true))
            spdlog::error("audit_log: {}; {}", problem.what(),
                          is_removed() ? "lines are lost until it can be written" : "lines go into the earlier file");
    }
}

bool AuditFile::is_removed() const {
    struct stat ours {};
    return ::fstat(file_.get(), &ours) == 0 && ours.st_nlink == 0;
}

// A line that was written in part is removed.
void AuditFile::write(std::string const& line) {
    if (!is_in_place()) {
        begin_again();
        if (is_removed()) {
            ++lost_;
            return;
        }
    }
    if (auto const size = size_of(file_); size > 0 && size + line.size() > bytes_) begin_another();
    auto const whole = size_of(file_);
    try {
        write_all(file_, line);
    } catch (std::exception const& problem) {
        ++lost_;
        spdlog::error("audit_log: a line was lost: {}", problem.what());
        if (::ftruncate(file_.get(), static_cast<::off_t>(whole)) != 0) spdlog::error("audit_log: its last line is incomplete");
    }
}

}  // namespace rois
