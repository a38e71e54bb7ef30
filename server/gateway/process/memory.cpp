#include "gateway/process/memory.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <new>
#include <string_view>
#include <utility>

#include "types/instant.hpp"

namespace rois {

namespace {

constexpr std::size_t mib = std::size_t{1} << 20U;

// The memory of the reserve. It is large enough to be mapped, so any thread can use its address space once it is freed.
class Block {
public:
    explicit Block(std::size_t wanted) : wanted_{wanted} {}

    // Takes as much as the system has, at most the wanted size. Returns false if it has nothing.
    bool fill() {
        for (auto size = wanted_; size >= mib && size > size_; size /= 2) {
            auto* const larger = std::malloc(size);
            if (larger == nullptr) continue;
            std::free(std::exchange(memory_, larger));
            size_ = size;
        }
        return memory_ != nullptr;
    }

    // Returns whether there was something to free.
    bool release() {
        size_ = 0;
        auto* const memory = std::exchange(memory_, nullptr);
        std::free(memory);
        return memory != nullptr;
    }

private:
    std::size_t wanted_;
    std::size_t size_ = 0;
    void* memory_ = nullptr;
};

class Reserve {
public:
    static Reserve& instance() {
        static Reserve reserve;
        return reserve;
    }

    void hold(MemoryBudget& budget) {
        {
            std::lock_guard const lock{mutex_};
            budget_ = &budget;
        }
        refill();
    }

    void forget() {
        std::lock_guard const lock{mutex_};
        budget_ = nullptr;
        block_.release();
    }

    void refill() {
        std::lock_guard const lock{mutex_};
        if (budget_ == nullptr) return;
        bool const filled = block_.fill();
        bool const calm = std::chrono::steady_clock::now() - released_ > std::chrono::seconds{1};
        if (filled && calm) budget_->set_exhausted(false);
    }

    // The allocation is repeated if this returns.
    void release() {
        std::lock_guard const lock{mutex_};
        if (budget_ == nullptr) throw std::bad_alloc{};
        budget_->set_exhausted(true);
        released_ = std::chrono::steady_clock::now();
        if (block_.release()) ++releases_;
        thread_local unsigned tried = 0;  // with how many releases this thread has repeated an allocation
        if (std::exchange(tried, releases_) == releases_) throw std::bad_alloc{};
    }

private:
    std::mutex mutex_;                // guards the members below
    MemoryBudget* budget_ = nullptr;  // null: there is no reserve
    Block block_{8 * mib};
    unsigned releases_ = 0;
    Steady released_;  // when an allocation failed last
};

}  // namespace

std::size_t resident_bytes() {
    static int const statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    static auto const page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    std::array<char, 128> text{};
    auto const size = ::pread(statm, text.data(), text.size(), 0);
    if (size <= 0) return 0;
    std::string_view rest{text.data(), static_cast<std::size_t>(size)};
    rest.remove_prefix(rest.find(' ') + 1);  // the first number is the size of the address space
    std::size_t pages = 0;
    std::from_chars(rest.data(), rest.data() + rest.size(), pages);
    return pages * page;
}

std::size_t memory_in_use() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 0;
#else
    return resident_bytes();
#endif
}

void release_large_blocks_at_once() {
    constexpr int large = 256 * 1024;
    mallopt(M_MMAP_THRESHOLD, large);  // also keeps it from growing by itself
    mallopt(M_TRIM_THRESHOLD, 4 * large);
}

void release_memory() { malloc_trim(0); }

MemoryReserve::MemoryReserve(MemoryBudget& budget) {
    Reserve::instance().hold(budget);
    std::set_new_handler([] { Reserve::instance().release(); });
}

MemoryReserve::~MemoryReserve() {
    std::set_new_handler(nullptr);
    Reserve::instance().forget();
}

void MemoryReserve::refill() { Reserve::instance().refill(); }

}  // namespace rois
