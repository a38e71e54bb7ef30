// Loads memory into the cache ahead of its use.
#pragma once

#include <cstddef>

namespace rois {

// Any address is allowed. Must be inlined: g++ removes calls of functions that only prefetch.
[[gnu::always_inline]] inline void prefetch(void const* from, std::size_t bytes) {
    constexpr std::size_t cache_line = 64;
    for (std::size_t i = 0; i < bytes; i += cache_line) __builtin_prefetch(static_cast<char const*>(from) + i);
}

}  // namespace rois
