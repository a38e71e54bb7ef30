// Limits the memory of the process: when little is left, requests are refused (docs/safety.md).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace rois {

// Compares the memory that the process uses with a limit. `Measure` returns the total: single allocations are not counted. Memory
// for the work on a long document is reserved beforehand. Thread-safe.
class MemoryBudget {
public:
    using Measure = std::function<std::size_t()>;  // bytes that the process uses now; called on any thread

    // Without a limit.
    MemoryBudget() = default;
    MemoryBudget(std::size_t total, Measure measure) : total_{total}, measure_{std::move(measure)} { look(); }
    MemoryBudget(MemoryBudget const&) = delete;
    MemoryBudget& operator=(MemoryBudget const&) = delete;
    static MemoryBudget& none();

    std::size_t total() const { return total_.load(std::memory_order_relaxed); }
    void limit(std::size_t total) { total_ = total; }
    std::size_t used() const { return used_.load(std::memory_order_relaxed); }  // at the last measurement

    // From 80 % on: new sessions, new subscriptions and long documents are refused.
    bool tight() const { return used() >= total() / 5 * 4 || exhausted(); }
    // From 100 % on, and while the system has no more memory: only short requests are accepted, and data that is kept for later
    // is dropped.
    bool full() const { return used() >= total() || exhausted(); }

    // Whether an allocation failed a short time ago, even if the budget is not used up. Set by the owner of the budget; any
    // thread.
    bool exhausted() const { return exhausted_.load(std::memory_order_relaxed); }
    void set_exhausted(bool exhausted) noexcept { exhausted_.store(exhausted, std::memory_order_relaxed); }

    // The longest request that is accepted now, in bytes.
    std::size_t longest_document() const {
        if (!tight()) return std::numeric_limits<std::size_t>::max();
        return full() ? longest_when_full : longest_when_tight;
    }
    static constexpr std::size_t longest_when_tight = 64 * 1024;
    static constexpr std::size_t longest_when_full = 4 * 1024;

    // Measures the memory.
    void look();
    // Reports that the gateway stores `bytes` more bytes. After enough reported bytes, measures the memory again.
    void took(std::size_t bytes) {
        constexpr std::size_t enough = 256 * 1024;
        if (taken_.fetch_add(bytes, std::memory_order_relaxed) + bytes >= enough) look();
    }

    // Memory reserved for the work on a document; the destructor returns it. False if the reservation failed.
    class Room {
    public:
        Room() = default;
        Room(Room&& other) noexcept : of_{std::exchange(other.of_, nullptr)}, bytes_{other.bytes_} {}
        Room& operator=(Room&&) = delete;
        ~Room() {
            if (of_ != nullptr) of_->reserved_ -= bytes_;
        }
        explicit operator bool() const { return of_ != nullptr; }

    private:
        friend class MemoryBudget;
        Room(MemoryBudget& of, std::size_t bytes) : of_{&of}, bytes_{bytes} {}

        MemoryBudget* of_ = nullptr;
        std::size_t bytes_ = 0;
    };
    Room reserve(std::size_t bytes);

    // Counts a refusal, and returns its reason: "`what`: the gateway uses 420 of the 512 MiB of its memory_budget; ...", or that
    // the system has no more memory.
    std::string refuse(std::string_view what);
    std::uint64_t refusals() const { return refusals_; }

private:
    std::atomic<std::size_t> total_ = std::numeric_limits<std::size_t>::max();
    Measure measure_;
    std::atomic<std::size_t> used_ = 0;
    std::atomic<std::size_t> reserved_ = 0;
    std::atomic<std::size_t> taken_ = 0;  // bytes reported by `took` since the last measurement
    std::atomic<std::uint64_t> refusals_ = 0;
    std::atomic<bool> exhausted_ = false;
};

}  // namespace rois
