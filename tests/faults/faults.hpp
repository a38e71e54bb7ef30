// Faults for this test program alone: memory that runs out, and calls of the system that fail. They hit every thread that is not
// exempt.
#pragma once

#include <chrono>
#include <cstdint>

namespace rois::faults {

// What can fail.
enum class Of : std::uint8_t {
    memory,  // operator new throws std::bad_alloc; not for a destructor while an exception unwinds (MemoryReserve)
    send,    // send and write: EPIPE
    accept,  // EMFILE
    epoll    // epoll_wait and epoll_ctl: ENOMEM
};

// The n-th call from now fails (1: the next), and those behind it, so many in all.
void fail_at(Of, std::uint64_t n, std::uint64_t how_many = 1);
// Each call fails until `stop`.
void fail(Of);
// Nothing fails from now on. Returns whether something failed since the last `fail` or `fail_at`.
bool stop();

// How often it was called since the last `fail_at`, by threads that are not exempt.
std::uint64_t calls(Of);

// While it lives, nothing fails for its thread.
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
