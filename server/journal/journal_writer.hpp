// Writes the engine's changes to the journal's file, on a thread of its own (docs/journal.md).
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "engine/journal/journal.hpp"
#include "journal/journal_file.hpp"

namespace rois::journal {

class JournalWriter final : public Journal {
public:
    struct Calls {
        // The changes were stored, or not. On the writer's thread. It must lock the engine and call it.
        std::function<void(bool stored)> done;
        // The file cannot be trusted any more: everything must be halted, and the process must end. On the writer's thread.
        std::function<void(std::string const& why)> broken;
        // For people: the disk is full, or not any more.
        std::function<void(std::string const& line)> say;
    };

    // The destructor waits until the last changes are written.
    JournalWriter(std::unique_ptr<JournalFile> file, Calls calls);
    ~JournalWriter() override;
    JournalWriter(JournalWriter const&) = delete;
    JournalWriter& operator=(JournalWriter const&) = delete;

    void store(std::shared_ptr<Changes const>) noexcept override;
    void keep_stop(bool is_stopped) noexcept override;
    std::string why_no_commands() const override;

    // From now on, all files together take at most `bytes`. Thread-safe.
    void limit(std::size_t bytes);

    // Waits until everything that was given is written and the files are closed. Changes that are given later are ignored.
    // Returns false if the disk needs longer than this.
    bool finish(std::chrono::milliseconds longest);

    // For /metrics. Thread-safe.
    struct Numbers {
        std::uint64_t stored = 0;      // how often changes were stored
        std::uint64_t not_stored = 0;  // how often they could not be
        bool has_room = true;
    };
    Numbers numbers() const { return {stored_, not_stored_, has_room_}; }

private:
    void run(std::stop_token const& stop);
    void run_stops(std::stop_token const& stop);
    bool uses(std::size_t limit);
    void write(Changes const&);
    bool delete_more();
    void note_broken(std::string_view problem);
    void note_room();

    std::unique_ptr<StopFile> const stop_;  // used only by its thread
    std::unique_ptr<JournalFile> file_;     // used only by the other thread, which closes it at its end
    Calls const calls_;
    std::atomic<bool> has_room_ = true;
    bool is_failing_ = false;  // the last step was not stored
    std::atomic<std::uint64_t> stored_ = 0;
    std::atomic<std::uint64_t> not_stored_ = 0;
    std::mutex mutex_;  // guards the members below
    std::condition_variable_any news_;
    std::shared_ptr<Changes const> next_;
    std::optional<std::size_t> next_limit_;
    std::optional<bool> next_stop_;  // until it is kept
    bool is_closed_ = false;
    std::jthread thread_;
    std::jthread stops_thread_;  // a stop does not wait for a step that the disk is storing
};

}  // namespace rois::journal
