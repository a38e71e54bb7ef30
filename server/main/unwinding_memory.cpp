// Memory for destructors that run while an exception unwinds the stack. An allocation that fails there ends the process;
// Boost.Asio, for example, posts the end of a coroutine in a destructor. Therefore `operator new` falls back to a pool that is
// used only there. The pool takes no physical memory before its first use. Not with a sanitizer, which has an `operator new` of
// its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <utility>

namespace {

// Thread-safe.
class Pool {
public:
    // Returns null if the size is too large or no block is left.
    void* take(std::size_t size) {
        std::lock_guard const lock{mutex_};
        if (size > sizeof(Block)) return nullptr;
        if (free_ != nullptr) return std::exchange(free_, free_->next);
        return used_ < blocks_.size() ? &blocks_[used_++] : nullptr;
    }

    bool owns(void const* memory) const {
        std::less_equal<> const ordered;
        return ordered(blocks_.data(), memory) && !ordered(blocks_.data() + blocks_.size(), memory);
    }

    void give_back(void* memory) {
        std::lock_guard const lock{mutex_};
        free_ = new (memory) Block{.next = free_};
    }

private:
    union Block {
        Block* next = nullptr;
        alignas(std::max_align_t) std::array<std::byte, 512> bytes;
    };

    std::mutex mutex_;
    Block* free_ = nullptr;
    std::size_t used_ = 0;  // blocks that were ever taken
    std::array<Block, 4'096> blocks_{};
};

constinit Pool pool{};

}  // namespace

void* operator new(std::size_t size) {
    while (true) {
        if (auto* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
        if (std::uncaught_exceptions() > 0)
            if (auto* const memory = pool.take(size)) return memory;
        auto* const handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc{};
        handler();
    }
}

void operator delete(void* memory) noexcept {
    if (pool.owns(memory))
        pool.give_back(memory);
    else
        std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

#endif
