// The memory of this process.
#pragma once

#include <cstddef>

#include "engine/memory_budget.hpp"

namespace rois {

// What is in physical memory, in bytes; 0 if the system does not say. Any thread.
std::size_t resident_bytes();

// The same, for the memory budget: 0 under a sanitizer, whose own memory is many times the program's.
std::size_t memory_in_use();

// Has memory that was freed given back to the system: from now on at once for what is large. Once, at the start.
void release_large_blocks_at_once();

// The same for all that is free now; takes some milliseconds where much is.
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

    // Sets aside again what was freed, as far as the system has it. The budget is exhausted until one second after the last
    // failed allocation. The clock calls this in each tick; does nothing if there is no reserve.
    static void refill();
};

}  // namespace rois
