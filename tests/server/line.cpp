#include "server/line.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace rois::test {

Line::Line(std::uint16_t port, std::string const& address) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0)
        throw LineEnded{"no address " + address};
    socket_ = socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    auto const connected = connect(socket_, found->ai_addr, found->ai_addrlen);
    freeaddrinfo(found);
    if (connected != 0) throw LineEnded{"cannot connect"};
    timeval const longest{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    int const on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

Line::~Line() { close(socket_); }

void Line::send(std::string_view bytes) {
    while (!bytes.empty()) {
        auto const sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

std::size_t Line::send_now(std::string_view bytes) {
    auto const sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

void Line::finish() { shutdown(socket_, SHUT_WR); }

bool Line::receive() {
    std::array<char, 65'536> buffer;
    auto const size = recv(socket_, buffer.data(), buffer.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) throw LineEnded{"nothing came for 20 s; before: " + received_};
    if (size <= 0) return false;
    received_.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

std::string Line::take(std::size_t size) {
    while (received_.size() < size) {
        if (!receive()) throw LineEnded{"closed after: " + received_};
    }
    auto taken = received_.substr(0, size);
    received_.erase(0, size);
    return taken;
}

std::string Line::take_until(std::string_view mark) {
    while (received_.find(mark) == std::string::npos) {
        if (!receive()) throw LineEnded{"closed after: " + received_};
    }
    return take(received_.find(mark) + mark.size());
}

bool Line::ends() { return received_.empty() && !receive(); }

std::string Line::rest() {
    while (receive()) {
    }
    return take(received_.size());
}

}  // namespace rois::test
