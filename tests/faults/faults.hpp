// Faults in this test program: memory that runs out, and system calls that fail. They affect every thread that is not
// exempt.
#pragma once

#include <cstdint>

namespace rois::faults {

// The calls that can fail.
enum class Of : std::uint8_t {
    memory,  // operator new throws std::bad_alloc; not for a destructor while an exception unwinds (MemoryReserve)
    send,    // send and write: EPIPE
    accept,  // EMFILE
    epoll    // epoll_wait and epoll_ctl: ENOMEM
};

// Lets the n-th call from now fail (1: the next), and the following ones, `count` in total.
void fail_at(Of, std::uint64_t n, std::uint64_t how_many = 1);
// Lets each call fail until `stop`.
void fail(Of);
// Ends all faults. Returns whether a call failed since the last `fail` or `fail_at`.
bool stop();

// Returns the number of calls since the last `fail_at`, by threads that are not exempt.
std::uint64_t calls(Of);

// A history with one thread is played again and again, with the fault this many calls later each time. The thread sanitizer,
// which is slow and looks for races between threads, plays few of them.
#if defined(__SANITIZE_THREAD__)
constexpr std::uint64_t step = 29;
#else
constexpr std::uint64_t step = 1;
#endif

// Exempts its thread as long as it exists.
class Exempt {
public:
    Exempt();
    ~Exempt();
    Exempt(Exempt const&) = delete;
    Exempt& operator=(Exempt const&) = delete;

private:
    bool before_;
};

}  // namespace rois::faults
