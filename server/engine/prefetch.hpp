// Memory that will be needed soon and is far away: asked for in time, it comes while something else is done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rois {

inline constexpr std::size_t cache_line = 64;

// All lines of `bytes` from there on; a pointer that leads nowhere does no harm.
template <std::size_t bytes = cache_line>
void prefetch(void const* from) {
    auto const* const line = static_cast<char const*>(from) - reinterpret_cast<std::uintptr_t>(from) % cache_line;
    auto const ask_for = [line]<std::size_t... number>(std::index_sequence<number...>) {
        (__builtin_prefetch(line + number * cache_line), ...);
        asm volatile("");  // g++ leaves out calls of functions that do nothing but prefetch
    };
    ask_for(std::make_index_sequence<1 + (bytes + cache_line - 1) / cache_line>{});
}

}  // namespace rois
