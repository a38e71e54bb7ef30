// Queue between the log and standard error, which may block: only the queue's own thread waits for it.
#pragma once

#include <spdlog/sinks/sink.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "types/instant.hpp"

namespace rois {

// A sink of spdlog. Thread-safe.
class LogQueue : public spdlog::sinks::sink {
public:
    struct Limits {
        std::size_t lines = 4'096;         // that wait; then the oldest one is dropped
        std::size_t bytes = 1'024 * 1024;  // of their texts
        unsigned a_second = 10;            // of one cause: lines that differ in numbers and quoted texts alone
        std::chrono::milliseconds flush{500};
        Steady (*now)() = std::chrono::steady_clock::now;
    };

    // Writes to this open file, and does not close it. The destructor writes the waiting lines, for at most `flush`.
    explicit LogQueue(int file) : LogQueue{file, Limits{}} {}
    LogQueue(int file, Limits const&);
    ~LogQueue() override;

    void log(spdlog::details::log_msg const&) override;
    // Waits until all lines are written, at most `limits.flush`.
    void flush() override;
    void set_pattern(std::string const&) override;
    void set_formatter(std::unique_ptr<spdlog::formatter>) override;

    // Lines that were lost because the queue was full or the file failed; and lines above the limit of their cause.
    std::uint64_t dropped() const { return dropped_; }
    std::uint64_t left_out() const { return left_out_; }

private:
    struct Line {
        spdlog::log_clock::time_point time;
        spdlog::level::level_enum level = spdlog::level::info;
        std::string text;
    };
    // The lines of one cause in the second that began at `since`.
    struct Cause {
        std::uint64_t hash = 0;
        Steady since;
        unsigned said = 0;
        std::uint64_t left_out = 0;
        spdlog::level::level_enum level = spdlog::level::info;
        std::string example;
    };

    bool may_say(spdlog::details::log_msg const&);
    Cause& place_of(std::uint64_t hash, Steady now);
    void sum_up(Cause&);
    void put(Line);
    void report_suppressed_lines(Steady now);
    void run(std::stop_token const&);
    bool take(std::unique_lock<std::mutex>&, std::stop_token const&, Line&);
    void write(Line const&);
    bool write(std::string_view);

    int file_;
    bool is_terminal_;
    Limits limits_;
    std::unique_ptr<spdlog::formatter> formatter_;  // the thread's own, once that has begun
    std::atomic<std::uint64_t> dropped_ = 0;
    std::atomic<std::uint64_t> left_out_ = 0;
    std::atomic<Steady> give_up_{Steady::max()};  // writing, from then on
    std::uint64_t reported_dropped_ = 0;          // dropped lines that the log has reported; only for the thread

    std::mutex mutex_;  // guards the members below
    std::condition_variable news_;
    std::condition_variable written_;
    std::deque<Line> lines_;
    std::size_t bytes_ = 0;
    bool writing_ = false;
    std::array<Cause, 256> causes_{};  // by their hash
    std::jthread thread_;
};

}  // namespace rois
