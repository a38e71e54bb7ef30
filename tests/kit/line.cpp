#include "kit/line.hpp"

#include <netdb.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>

namespace rois::kit {

namespace {

std::string in_seconds(std::chrono::milliseconds time) {
    auto text = std::to_string(static_cast<double>(time.count()) / 1'000);
    text.resize(text.find('.') + 2);
    return text + " s";
}

// A connected socket, or -1.
int connect_to(addrinfo const& peer, std::chrono::milliseconds patience) {
    auto const socket = ::socket(peer.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return -1;
    timeval const longest{patience.count() / 1'000, patience.count() % 1'000 * 1'000};
    setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);  // limits connect, too
    int const on = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (connect(socket, peer.ai_addr, peer.ai_addrlen) == 0) return socket;
    close(socket);
    return -1;
}

}  // namespace

Line::Line(Address const& address) : patience_{address.patience} {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICSERV;
    addrinfo* list = nullptr;
    if (getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &list) != 0)
        throw LineEnded{"unknown host " + address.host};
    std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> const found{list, freeaddrinfo};
    for (auto const* peer = list; peer && socket_ < 0; peer = peer->ai_next) socket_ = connect_to(*peer, patience_);
    if (socket_ < 0) throw LineEnded{"no server accepts connections at " + address.host + ":" + std::to_string(address.port)};
    if (address.tls) secure(address);
}

Line::~Line() {
    tls_.reset();
    close(socket_);
}

void Line::Free::operator()(SSL* tls) const { SSL_free(tls); }

void Line::secure(Address const& address) {
    std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> const context{SSL_CTX_new(TLS_client_method()), SSL_CTX_free};
    SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
    SSL_CTX_set_mode(context.get(), SSL_MODE_AUTO_RETRY);
    bool ready = address.ca_file.empty() ? SSL_CTX_set_default_verify_paths(context.get()) == 1
                                         : SSL_CTX_load_verify_file(context.get(), address.ca_file.c_str()) == 1;
    if (!address.certificate.empty())
        ready = ready && SSL_CTX_use_certificate_chain_file(context.get(), address.certificate.c_str()) == 1 &&
                SSL_CTX_use_PrivateKey_file(context.get(), address.key.c_str(), SSL_FILETYPE_PEM) == 1;
    tls_.reset(SSL_new(context.get()));
    SSL_set1_host(tls_.get(), address.host.c_str());
    SSL_set_fd(tls_.get(), socket_);
    if (!ready || SSL_connect(tls_.get()) != 1)
        throw LineEnded{std::string{"no TLS: "} + ERR_error_string(ERR_get_error(), nullptr)};
}

void Line::send(std::string_view bytes) {
    while (!bytes.empty()) {
        auto const sent = tls_ ? SSL_write(tls_.get(), bytes.data(), static_cast<int>(bytes.size()))
                               : ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

std::size_t Line::send_now(std::string_view bytes) {
    auto const sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

void Line::finish() {
    if (tls_) SSL_shutdown(tls_.get());
    shutdown(socket_, SHUT_WR);
}

bool Line::receive(Clock::time_point deadline) {
    auto const left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd waiting{socket_, POLLIN, 0};
    bool const is_here = tls_ && SSL_has_pending(tls_.get()) == 1;
    if (!is_here && poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0))) == 0)
        throw LineEnded{"received no bytes for " + in_seconds(patience_) + "; received before: " + received_};
    std::array<char, 65'536> buffer;
    auto const size = tls_ ? SSL_read(tls_.get(), buffer.data(), static_cast<int>(buffer.size()))
                           : recv(socket_, buffer.data(), buffer.size(), 0);
    if (size <= 0) return false;
    received_.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

std::string Line::take(std::size_t size) {
    for (auto const until = deadline(); received_.size() < size;) {
        if (!receive(until)) throw LineEnded{"the peer closed the connection; received before: " + received_};
    }
    auto taken = received_.substr(0, size);
    received_.erase(0, size);
    return taken;
}

std::string Line::take_until(std::string_view mark) {
    for (auto const until = deadline(); received_.find(mark) == std::string::npos;) {
        if (!receive(until)) throw LineEnded{"the peer closed the connection; received before: " + received_};
    }
    return take(received_.find(mark) + mark.size());
}

bool Line::ends() { return received_.empty() && !receive(deadline()); }

std::string Line::rest() {
    for (auto const until = deadline(); receive(until);) {
    }
    return take(received_.size());
}

}  // namespace rois::kit
