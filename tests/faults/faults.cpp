#include "faults/faults.hpp"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <new>

namespace rois::faults {

namespace {

struct Fault {
    std::atomic<bool> armed = false;
    std::atomic<bool> happened = false;
    std::atomic<std::uint64_t> at = 0;  // the first call that fails, and the first after it that does not
    std::atomic<std::uint64_t> until = 0;
    std::atomic<std::uint64_t> calls = 0;
};

constinit std::array<Fault, 4> all{};
thread_local constinit bool exempt = false;

Fault& fault(Of of) { return all[static_cast<std::size_t>(of)]; }

// Counts a call, and returns whether it must fail.
bool fails(Of of) {
    auto& one = fault(of);
    if (!one.armed.load(std::memory_order_relaxed) || exempt) return false;
    if (of == Of::memory && std::uncaught_exceptions() > 0) return false;
    auto const call = one.calls.fetch_add(1) + 1;
    if (call < one.at || call >= one.until) return false;
    one.happened = true;
    return true;
}

}  // namespace

void fail_at(Of of, std::uint64_t n, std::uint64_t how_many) {
    auto& one = fault(of);
    one.calls = 0;
    one.at = n;
    one.until = n + how_many;
    one.happened = false;
    one.armed = true;
}

void fail(Of of) { fail_at(of, 0, UINT64_MAX); }

bool stop() {
    bool happened = false;
    for (auto& one : all) {
        one.armed = false;
        happened = one.happened.exchange(false) || happened;
    }
    return happened;
}

std::uint64_t calls(Of of) { return fault(of).calls; }

Exempt::Exempt() : before_{exempt} { exempt = true; }
Exempt::~Exempt() { exempt = before_; }

}  // namespace rois::faults

using rois::faults::fails;
using rois::faults::Of;

void* operator new(std::size_t size) {
    if (fails(Of::memory)) throw std::bad_alloc{};
    auto* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc{};
    return memory;
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, std::nothrow_t const&) noexcept { return fails(Of::memory) ? nullptr : std::malloc(size); }
void* operator new[](std::size_t size, std::nothrow_t const& no) noexcept { return operator new(size, no); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    auto const align = static_cast<std::size_t>(alignment);
    auto* const memory = fails(Of::memory) ? nullptr : std::aligned_alloc(align, (size + align - 1) / align * align);
    if (memory == nullptr) throw std::bad_alloc{};
    return memory;
}
void* operator new[](std::size_t size, std::align_val_t alignment) { return operator new(size, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

// These replace the functions of the C library.
extern "C" {

ssize_t send(int socket, void const* data, size_t size, int flags) {
    if (fails(Of::send)) return errno = EPIPE, -1;
    return syscall(SYS_sendto, socket, data, size, flags, nullptr, 0);
}

ssize_t write(int file, void const* data, size_t size) {
    if (fails(Of::send)) return errno = EPIPE, -1;
    return syscall(SYS_write, file, data, size);
}

int accept(int socket, sockaddr* address, socklen_t* size) {
    if (fails(Of::accept)) return errno = EMFILE, -1;
    return static_cast<int>(syscall(SYS_accept, socket, address, size));
}

int epoll_wait(int epoll, epoll_event* events, int most, int timeout) {
    if (fails(Of::epoll)) return errno = ENOMEM, -1;
    return static_cast<int>(syscall(SYS_epoll_wait, epoll, events, most, timeout));
}

int epoll_ctl(int epoll, int what, int file, epoll_event* event) noexcept {
    if (fails(Of::epoll)) return errno = ENOMEM, -1;
    return static_cast<int>(syscall(SYS_epoll_ctl, epoll, what, file, event));
}
}

#if defined(__SANITIZE_ADDRESS__)
// xerces-c loses memory of its own when its allocations fail.
extern "C" char const* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): the sanitizer's own name
extern "C" char const* __lsan_default_suppressions() { return "leak:xercesc_3_2::MemoryManagerImpl::allocate\n"; }
#endif
