#include "net/memory.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <string_view>

namespace rois::net {

std::size_t resident_bytes() {
    static int const statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    static auto const page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    std::array<char, 128> text{};
    auto const size = ::pread(statm, text.data(), text.size(), 0);
    if (size <= 0) return 0;
    std::string_view rest{text.data(), static_cast<std::size_t>(size)};
    rest.remove_prefix(rest.find(' ') + 1);  // the first number is the size of the address space
    std::size_t pages = 0;
    std::from_chars(rest.data(), rest.data() + rest.size(), pages);
    return pages * page;
}

std::size_t memory_in_use() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 0;
#else
    return resident_bytes();
#endif
}

void release_large_blocks_at_once() {
    constexpr int large = 256 * 1024;
    mallopt(M_MMAP_THRESHOLD, large);  // also keeps it from growing by itself
    mallopt(M_TRIM_THRESHOLD, 4 * large);
}

void release_memory() { malloc_trim(0); }

}  // namespace rois::net
