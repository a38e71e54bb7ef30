// The audit log (key `audit_log`; docs/trust.md): a file of JSON lines.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "gateway/process/audit.hpp"
#include "types/instant.hpp"
#include "types/unique_descriptor.hpp"

namespace rois {

// Thread-safe.
class AuditFile {
public:
    struct Limits {
        std::size_t bytes = std::size_t{10} << 20;  // of a file; then audit.log becomes audit.1.log, and that audit.2.log
        std::size_t files = 10;                     // that are kept besides the present one
        std::size_t waiting = 10'000;               // lines
        // Lines about refusals of one token, or of all clients without one, in a second, and as many about the beginning and end
        // of its sessions. Further ones are only counted, so that they do not drive out bindings and commands.
        std::size_t most_a_second = 10;
        Steady (*now)() = std::chrono::steady_clock::now;
    };

    // Throws BadSettings if the file cannot be written. The destructor writes the waiting lines.
    AuditFile(std::string file, Limits const&);
    ~AuditFile();
    AuditFile(AuditFile const&) = delete;
    AuditFile& operator=(AuditFile const&) = delete;

    // Returns at once: a thread of its own writes the line.
    void note(AuditEntry const&) noexcept;
    // Other limits for the files from now on. Thread-safe.
    void limit(std::size_t bytes, std::size_t files) {
        bytes_ = bytes;
        files_ = files;
    }
    // Lines that could not be written, or for which there was no room.
    std::uint64_t lost() const { return lost_; }

private:
    struct Second {
        Steady since;
        std::size_t lines = 0;
        std::uint64_t left_out = 0;  // since the last line
    };

    bool may_say(AuditEntry const&, std::uint64_t& left_out);
    void sum_up();
    void run(std::stop_token const&);
    void write(std::string const& line);
    void open();
    bool is_in_place() const;
    bool is_removed() const;
    void begin_again();
    void begin_another();

    Limits const limits_;  // its bytes and files: the next two, which may change
    std::atomic<std::size_t> bytes_;
    std::atomic<std::size_t> files_;
    std::string const name_;
    UniqueDescriptor file_;      // the constructor and the thread use it, and the next one
    bool cannot_begin_ = false;  // another file; it is reported once
    std::atomic<std::uint64_t> lost_ = 0;
    std::mutex mutex_;  // guards the next three
    std::condition_variable_any news_;
    std::deque<std::string> lines_;
    std::map<std::pair<std::string, bool>, Second> seconds_;  // by the name of the token, and whether it is about refusals
    std::jthread thread_;
};

}  // namespace rois
