#include "main/audit_file.hpp"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
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
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Makes the file if it does not exist. spdlog would open whatever has this name, and make a missing folder.
std::string usable(std::string const& file) {
    UniqueDescriptor const made{
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR)};
    struct stat found {};
    if (made.get() < 0 || ::fstat(made.get(), &found) != 0)
        throw BadSettings{"audit_log: cannot write " + rois::quoted(file) + ": " + std::strerror(errno)};
    if (!S_ISREG(found.st_mode)) throw BadSettings{"audit_log: " + rois::quoted(file) + " is not a file"};
    return file;
}

spdlog::file_event_handlers calling(std::function<void(std::FILE*)> opened) {
    spdlog::file_event_handlers handlers;
    handlers.after_open = [opened = std::move(opened)](spdlog::filename_t const&, std::FILE* file) { opened(file); };
    return handlers;
}

::off_t size_of(std::FILE* file) {
    struct stat found {};
    return ::fstat(::fileno(file), &found) == 0 ? found.st_size : 0;
}

}  // namespace

AuditFile::AuditFile(std::string const& file, Limits const& limits)
    : limits_{limits}, sink_{usable(file), limits.bytes, limits.files, false, calling([this](std::FILE* present) {
                                 opened(present);
                             })} {
    sink_.set_formatter(std::make_unique<spdlog::pattern_formatter>("%v"));
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
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
    if (entry.what != "refused") return true;
    auto const now = limits_.now();
    auto& second = refused_[std::string{entry.token}];
    if (now - second.since >= std::chrono::seconds{1}) second = {now, 0, second.left_out};
    if (++second.refusals <= limits_.refusals_a_second) {
        left_out = std::exchange(second.left_out, 0);
        return true;
    }
    ++second.left_out;
    return false;
}

void AuditFile::run(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    while (news_.wait(lock, stop, [this] { return !lines_.empty(); })) {
        auto const line = std::move(lines_.front());
        lines_.pop_front();
        lock.unlock();
        write(line);
        lock.lock();
    }
}

// Only its owner may read a file that says who did what.
void AuditFile::opened(std::FILE* file) {
    ::fchmod(::fileno(file), S_IRUSR | S_IWUSR);
    present_ = file;
    whole_ = size_of(file);
}

// Removes the part of a line that was written before the disk was full.
void AuditFile::cut_off() {
    std::clearerr(present_);
    if (::ftruncate(::fileno(present_), whole_) != 0) spdlog::error("audit_log: its last line is incomplete");
}

void AuditFile::write(std::string const& line) {
    try {
        sink_.log({{}, "audit", spdlog::level::info, line});
        sink_.flush();
        whole_ = size_of(present_);
    } catch (std::exception const& problem) {
        ++lost_;
        spdlog::error("audit_log: a line was lost: {}", problem.what());
        cut_off();
    }
}

}  // namespace rois
