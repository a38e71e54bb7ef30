// A test preloads this library into the gateway to let one call of the system fail. ROIS_FAILING_CALL is the name of the call,
// which of its calls fails, and with which errno: "accept 3 24".
#include <dlfcn.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Failure {
    char name[16] = {};
    unsigned call = 0;
    int error = 0;
};

Failure read_failure() {
    Failure failure;
    auto const* const text = std::getenv("ROIS_FAILING_CALL");
    if (text == nullptr || std::sscanf(text, "%15s %u %d", failure.name, &failure.call, &failure.error) != 3) return {};
    return failure;
}

std::atomic<unsigned> calls = 0;
std::atomic<bool> accepts = false;  // before that, Asio itself calls epoll_ctl, and does not expect that it fails

bool fails(char const* name) {
    static Failure const failure = read_failure();
    if (std::strcmp(name, failure.name) != 0 || ++calls != failure.call) return false;
    errno = failure.error;
    return true;
}

template <class Function>
Function* real(char const* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int accept(int socket, sockaddr* address, socklen_t* size) {
    static auto* const call = real<int(int, sockaddr*, socklen_t*)>("accept");
    accepts = true;
    return fails("accept") ? -1 : call(socket, address, size);
}

extern "C" int epoll_ctl(int poll, int operation, int descriptor, epoll_event* event) {
    static auto* const call = real<int(int, int, int, epoll_event*)>("epoll_ctl");
    return accepts && fails("epoll_ctl") ? -1 : call(poll, operation, descriptor, event);
}

extern "C" int epoll_wait(int poll, epoll_event* events, int most, int timeout) {
    static auto* const call = real<int(int, epoll_event*, int, int)>("epoll_wait");
    return fails("epoll_wait") ? -1 : call(poll, events, most, timeout);
}

extern "C" ssize_t recv(int socket, void* into, size_t size, int flags) {
    static auto* const call = real<ssize_t(int, void*, size_t, int)>("recv");
    return fails("recv") ? -1 : call(socket, into, size, flags);
}

extern "C" ssize_t send(int socket, void const* from, size_t size, int flags) {
    static auto* const call = real<ssize_t(int, void const*, size_t, int)>("send");
    return fails("send") ? -1 : call(socket, from, size, flags);
}

extern "C" ssize_t sendmsg(int socket, msghdr const* message, int flags) {
    static auto* const call = real<ssize_t(int, msghdr const*, int)>("sendmsg");
    return fails("sendmsg") ? -1 : call(socket, message, flags);
}
