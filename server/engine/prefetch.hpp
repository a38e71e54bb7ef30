// Memory that will be needed soon and is far away: asked for in time, it comes while something else is done.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rois {

inline constexpr std::size_t cache_line = 64;

// `bytes` from there on; a pointer that leads nowhere does no harm.
inline void prefetch(void const* from, std::size_t bytes = cache_line) {
    auto const* const begin = static_cast<char const*>(from);
    auto const into_line = reinterpret_cast<std::uintptr_t>(from) % cache_line;
    for (std::size_t at = 0; at < into_line + bytes; at += cache_line) __builtin_prefetch(begin - into_line + at);
}

}  // namespace rois
