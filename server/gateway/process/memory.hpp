// The memory of this process.
#pragma once

#include <cstddef>

#include "engine/memory_budget.hpp"

namespace rois {

// Returns the bytes in physical memory, or 0 if the system does not report them. Thread-safe.
std::size_t resident_bytes();

// The same, for the memory budget: 0 under a sanitizer, whose own memory is many times the program's.
std::size_t memory_in_use();

// Makes malloc return large freed blocks to the system at once. Call it once, at the start.
void release_large_blocks_at_once();

// Returns all free memory to the system now. Takes some milliseconds if there is much.
void release_memory();

// Sets 8 MiB of address space aside for the time when the system gives no more memory; no physical memory is used. The first
// allocation that fails (operator new) frees it and succeeds. The budget is then exhausted: what needs much memory is refused,
// and unfinished documents are cut. One at a time; the budget must outlive it.
class MemoryReserve {
public:
    explicit MemoryReserve(MemoryBudget&);
    ~MemoryReserve();
    MemoryReserve(MemoryReserve const&) = delete;
    MemoryReserve& operator=(MemoryReserve const&) = delete;

    // Fills the reserve again, as far as the system has memory. The budget is exhausted until one second after the last
    // failed allocation. The clock calls this in each tick; does nothing if there is no reserve.
    static void refill();
};

}  // namespace rois
