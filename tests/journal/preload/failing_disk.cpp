// A test preloads this library into the gateway to make its disk fail. The text in the file that ROIS_DISK names decides how:
// "full": nothing can be written to files. "slow": fdatasync takes 3 s. "broken": fdatasync fails. "full 3": only the third write
// from then on fails. "broken 3": only the third fdatasync.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<unsigned> calls = 0;  // that could have failed as the text says

bool is(char const* word) {
    auto const* const name = std::getenv("ROIS_DISK");
    if (name == nullptr) return false;
    int const file = ::open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    char text[16] = {}, found[16] = {};
    auto const size = ::read(file, text, sizeof text - 1);
    ::close(file);
    unsigned call = 0;
    auto const parts = size > 0 ? std::sscanf(text, "%15s %u", found, &call) : 0;
    if (parts < 1 || std::strcmp(found, word) != 0) return false;
    return parts == 1 || ++calls == call;
}

template <class Function>
Function real(char const* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_full_for(int file) {
    struct stat found {};
    return ::fstat(file, &found) == 0 && S_ISREG(found.st_mode) && is("full");
}

int synced(int file, char const* name) {
    if (is("slow")) ::sleep(3);
    if (is("broken")) {
        errno = EIO;
        return -1;
    }
    return real<int (*)(int)>(name)(file);
}

}  // namespace

extern "C" ssize_t pwrite64(int file, void const* from, size_t size, off64_t at) {
    if (is_full_for(file)) {
        errno = ENOSPC;
        return -1;
    }
    return real<ssize_t (*)(int, void const*, size_t, off64_t)>("pwrite64")(file, from, size, at);
}

extern "C" int posix_fallocate(int file, off_t at, off_t size) {
    if (is_full_for(file)) return ENOSPC;
    return real<int (*)(int, off_t, off_t)>("posix_fallocate")(file, at, size);
}

extern "C" int fdatasync(int file) { return synced(file, "fdatasync"); }
extern "C" int fsync(int file) { return synced(file, "fsync"); }
