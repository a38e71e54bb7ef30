#include "kit/socket.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace rois::kit {

namespace {

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

int new_socket() {
    auto const descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) throw std::runtime_error{"cannot open a socket"};
    return descriptor;
}

void send_at_once(int descriptor) {
    int const on = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

}  // namespace

Socket::~Socket() { close(descriptor_); }

void Socket::send(std::string_view bytes) {
    std::lock_guard const lock{sending_};
    while (!bytes.empty()) {
        auto const sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

void Socket::end() { shutdown(descriptor_, SHUT_RDWR); }

bool Socket::receive() {
    std::array<char, 65'536> buffer;
    auto const size = recv(descriptor_, buffer.data(), buffer.size(), 0);
    if (size <= 0) return false;
    received_.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

std::optional<std::string> Socket::take(std::size_t size) {
    while (received_.size() < size)
        if (!receive()) return {};
    auto taken = received_.substr(0, size);
    received_.erase(0, size);
    return taken;
}

std::optional<std::string> Socket::take_until(std::string_view mark) {
    while (received_.find(mark) == std::string::npos)
        if (!receive()) return {};
    return take(received_.find(mark) + mark.size());
}

std::optional<std::string> Socket::take_some() {
    if (received_.empty() && !receive()) return {};
    return take(received_.size());
}

int try_connect_to(std::uint16_t port) {
    auto const descriptor = new_socket();
    auto const address = loopback(port);
    if (connect(descriptor, reinterpret_cast<sockaddr const*>(&address), sizeof address) != 0) {
        close(descriptor);
        return -1;
    }
    send_at_once(descriptor);
    return descriptor;
}

int connect_to(std::uint16_t port) {
    auto const descriptor = try_connect_to(port);
    if (descriptor < 0) throw std::runtime_error{"no server listens at port " + std::to_string(port)};
    return descriptor;
}

Listener::Listener() : descriptor_{new_socket()} {
    auto address = loopback(0);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(descriptor_, generic, size) != 0 || listen(descriptor_, 64) != 0 || getsockname(descriptor_, generic, &size) != 0)
        throw std::runtime_error{"cannot listen on a port of the loopback"};
    port_ = ntohs(address.sin_port);
}

Listener::~Listener() { close(descriptor_); }

std::optional<int> Listener::accept() {
    auto const descriptor = accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor < 0) return {};
    send_at_once(descriptor);
    return descriptor;
}

void Listener::end() { shutdown(descriptor_, SHUT_RDWR); }

}  // namespace rois::kit
