#include "main/audit_file.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "main/settings.hpp"
#include "types/instant.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

std::string line_of(AuditEntry const& entry, std::uint64_t left_out) {
    nlohmann::ordered_json line{{"time", to_text(std::chrono::system_clock::now())}, {"what", entry.what}};
    auto const add = [&](char const* key, std::string const& value) {
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

// Only its owner may read a file that says who did what.
spdlog::file_event_handlers for_owner_only() {
    spdlog::file_event_handlers handlers;
    handlers.after_open = [](spdlog::filename_t const&, std::FILE* file) { ::fchmod(::fileno(file), S_IRUSR | S_IWUSR); };
    return handlers;
}

// spdlog would make a missing folder, also for a name with a mistake.
spdlog::sinks::rotating_file_sink_st opened(std::string const& file, AuditFile::Limits const& limits) try {
    auto const folder = std::filesystem::absolute(file).parent_path();
    if (!std::filesystem::is_directory(folder))
        throw BadSettings{"audit_log: the folder " + rois::quoted(folder.string()) + " does not exist"};
    return {file, limits.bytes, limits.files, false, for_owner_only()};
} catch (spdlog::spdlog_ex const& problem) {
    throw BadSettings{std::string{"audit_log: "} + problem.what()};
}

}  // namespace

AuditFile::AuditFile(std::string const& file, Limits const& limits) : limits_{limits}, sink_{opened(file, limits)} {
    sink_.set_formatter(std::make_unique<spdlog::pattern_formatter>("%v"));
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
}

AuditFile::~AuditFile() = default;

void AuditFile::note(AuditEntry const& entry) noexcept {
    try {
        std::lock_guard const lock{mutex_};
        std::uint64_t left_out = 0;
        if (!may_say(entry, left_out)) return;
        if (lines_.size() < limits_.waiting) {
            lines_.push_back(line_of(entry, left_out));
            news_.notify_one();
            return;
        }
    } catch (...) {
        // There is no memory.
    }
    ++lost_;
}

bool AuditFile::may_say(AuditEntry const& entry, std::uint64_t& left_out) {
    if (entry.what != "refused") return true;
    auto const now = limits_.now();
    auto& second = refused_[entry.token];
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
    while (news_.wait(lock, stop, [this] { return !lines_.empty(); }) || !lines_.empty()) {
        auto const line = std::move(lines_.front());
        lines_.pop_front();
        lock.unlock();
        write(line);
        lock.lock();
    }
}

void AuditFile::write(std::string const& line) {
    try {
        sink_.log({{}, "audit", spdlog::level::info, line});
        sink_.flush();
    } catch (std::exception const& problem) {
        ++lost_;
        spdlog::error("audit_log: a line was lost: {}", problem.what());
    }
}

}  // namespace rois
