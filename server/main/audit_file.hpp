// The audit log (key `audit_log`; docs/trust.md): a file of JSON lines.
#pragma once

#include <spdlog/sinks/rotating_file_sink.h>
#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "gateway/process/audit.hpp"
#include "types/instant.hpp"

namespace rois {

// Thread-safe.
class AuditFile {
public:
    struct Limits {
        std::size_t bytes = std::size_t{10} << 20;  // of a file; then audit.log becomes audit.1.log, and that audit.2.log
        std::size_t files = 10;                     // that are kept besides the present one
        std::size_t waiting = 10'000;               // lines
        // Refusals of one token, or of all clients without one, in a second. Others are counted in the next line about them, so
        // that refusals do not drive out the other lines.
        std::size_t refusals_a_second = 10;
        Steady (*now)() = std::chrono::steady_clock::now;
    };

    // Throws BadSettings if the file cannot be written. The destructor writes the waiting lines.
    AuditFile(std::string const& file, Limits const&);
    ~AuditFile();
    AuditFile(AuditFile const&) = delete;
    AuditFile& operator=(AuditFile const&) = delete;

    // Returns at once: a thread of its own writes the line.
    void note(AuditEntry const&) noexcept;
    // Lines that could not be written, or for which there was no room.
    std::uint64_t lost() const { return lost_; }

private:
    struct Second {
        Steady since;
        std::size_t refusals = 0;
        std::uint64_t left_out = 0;  // since the last line
    };

    bool may_say(AuditEntry const&, std::uint64_t& left_out);
    void run(std::stop_token const&);
    void write(std::string const& line);

    void opened(std::FILE*);
    void cut_off();

    Limits const limits_;
    std::FILE* present_ = nullptr;               // the sink's file; the constructor and the thread use it, and the next one
    ::off_t whole_ = 0;                          // its size without a line that was written in part
    spdlog::sinks::rotating_file_sink_st sink_;  // only the thread uses it
    std::atomic<std::uint64_t> lost_ = 0;
    std::mutex mutex_;  // guards the next three
    std::condition_variable_any news_;
    std::deque<std::string> lines_;
    std::map<std::string, Second> refused_;  // by the name of the token
    std::jthread thread_;
};

}  // namespace rois
