// A test preloads this library into the gateway to make a thread fail. SIGUSR1: each malloc of the thread that receives the
// signal fails. SIGUSR2: each pread of it throws an exception, which no function that the gateway calls should do.
#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <stdexcept>

namespace {

// A signal handler uses these variables, so they must not be allocated on first use.
[[gnu::tls_model("initial-exec")]] thread_local volatile sig_atomic_t without_memory = 0;
[[gnu::tls_model("initial-exec")]] thread_local volatile sig_atomic_t throws = 0;

[[gnu::constructor]] void prepare() {
    struct sigaction action {};
    action.sa_handler = [](int number) { (number == SIGUSR1 ? without_memory : throws) = 1; };
    action.sa_flags = SA_RESTART;
    sigaction(SIGUSR1, &action, nullptr);
    sigaction(SIGUSR2, &action, nullptr);
}

}  // namespace

extern "C" void* __libc_malloc(size_t size);

extern "C" void* malloc(size_t size) {
    if (without_memory == 0) return __libc_malloc(size);
    errno = ENOMEM;
    return nullptr;
}

extern "C" ssize_t pread(int file, void* into, size_t size, off_t at) {
    if (throws != 0) throw std::runtime_error{"a fault that a test has made"};
    using Pread = ssize_t (*)(int, void*, size_t, off_t);
    static auto const real = reinterpret_cast<Pread>(dlsym(RTLD_NEXT, "pread"));
    return real(file, into, size, at);
}
