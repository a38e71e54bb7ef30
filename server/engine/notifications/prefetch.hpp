// Loads memory into the cache ahead of its use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rois {

inline constexpr std::size_t cache_line = 64;

// Prefetches `bytes` from this address on. An invalid pointer is harmless.
template <std::size_t bytes = cache_line>
void prefetch(void const* from) {
    auto const* const line = static_cast<char const*>(from) - reinterpret_cast<std::uintptr_t>(from) % cache_line;
    auto const ask_for = [line]<std::size_t... number>(std::index_sequence<number...>) {
        (__builtin_prefetch(line + number * cache_line), ...);
        asm volatile("");  // g++ removes calls of functions that only prefetch
    };
    ask_for(std::make_index_sequence<1 + (bytes + cache_line - 1) / cache_line>{});
}

}  // namespace rois
