// The memory of this process.
#pragma once

#include <cstddef>

namespace rois::net {

// What is in physical memory, in bytes; 0 if the system does not say. Any thread.
std::size_t resident_bytes();

// The same, for the memory budget: 0 under a sanitizer, whose own memory is many times the program's.
std::size_t memory_in_use();

// Has memory that was freed given back to the system: from now on at once for what is large. Once, at the start.
void release_large_blocks_at_once();

// The same for all that is free now; takes some milliseconds where much is.
void release_memory();

}  // namespace rois::net
