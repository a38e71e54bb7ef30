// Preloaded into the real gateway by a test: makes one of its threads fail. SIGUSR1: each operator new of the thread that gets
// the signal fails. SIGUSR2: each pread of it throws, as nothing that the gateway calls should.
#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <stdexcept>

namespace {

// Without the dynamic allocation that a library's thread-local variables usually need: a signal handler uses them.
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

void* operator new(std::size_t size) {
    auto* const memory = without_memory != 0 ? nullptr : std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc{};
    return memory;
}
void* operator new(std::size_t size, std::nothrow_t const&) noexcept {
    return without_memory != 0 ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

extern "C" ssize_t pread(int file, void* into, size_t size, off_t at) {
    if (throws != 0) throw std::runtime_error{"a fault that a test has made"};
    using Pread = ssize_t (*)(int, void*, size_t, off_t);
    static auto const real = reinterpret_cast<Pread>(dlsym(RTLD_NEXT, "pread"));
    return real(file, into, size, at);
}
