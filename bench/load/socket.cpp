#include "load/socket.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "kit/websocket_frames.hpp"

namespace rois::bench {

namespace {

constexpr int longest_wait = 20'000;  // milliseconds
constexpr std::size_t smallest_input = 4 * 1024;

[[noreturn]] void fail(std::string const& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

void wait_for(int descriptor, short what) {
    pollfd poll_of{descriptor, what, 0};
    if (::poll(&poll_of, 1, longest_wait) != 1) throw std::runtime_error("the server did not answer within 20 s");
}

// The numeric value of a field of an HTTP head; 0 if the field is missing.
std::size_t content_length(std::string_view head) {
    constexpr std::string_view name = "content-length:";
    for (auto line = head.find('\n'); line != head.npos; line = head.find('\n', line + 1)) {
        auto const field = head.substr(line + 1);
        if (field.size() < name.size() || strncasecmp(field.data(), name.data(), name.size()) != 0) continue;
        auto value = field.substr(name.size());
        value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
        std::size_t length = 0;
        std::from_chars(value.data(), value.data() + value.size(), length);
        return length;
    }
    return 0;
}

std::string head_of(std::string_view method, std::string_view path, std::string_view session) {
    std::string head;
    head.append(method).append(" ").append(path).append(" HTTP/1.1\r\nHost: 127.0.0.1\r\n");
    if (!session.empty()) head.append("RoIS-Session: ").append(session).append("\r\n");
    return head;
}

}  // namespace

std::string http_post(std::string_view path, std::string_view session, std::string_view body) {
    auto bytes = head_of("POST", path, session);
    bytes.append("Content-Type: text/xml\r\nContent-Length: ")
        .append(std::to_string(body.size()))
        .append("\r\n\r\n")
        .append(body);
    return bytes;
}

std::string http_get(std::string_view path, std::string_view session, std::string_view accept) {
    auto bytes = head_of("GET", path, session);
    bytes.append("Accept: ").append(accept).append("\r\n\r\n");
    return bytes;
}

std::string text_frame(std::string_view payload) { return kit::whole_frame(kit::Kind::text, payload, kit::Masked::yes); }

Socket::Socket(std::uint16_t port, Via via, std::string_view path) : via_{via} {
    descriptor_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor_ < 0) fail("socket failed");
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(descriptor_, reinterpret_cast<sockaddr const*>(&address), sizeof address) != 0) fail("connect failed");
    int const on = 1;
    ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (via == Via::http) return;
    auto hello = head_of("GET", path, {});
    hello.append(
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n");
    via_ = Via::http;
    send(hello);
    auto const answer = wait();
    if (answer.head.find(" 101 ") == answer.head.npos)
        throw std::runtime_error("the WebSocket was refused: " + std::string{answer.head});
    via_ = Via::websocket;
}

Socket::~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Socket::Socket(Socket&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)},
      via_{other.via_},
      input_{std::move(other.input_)},
      used_{other.used_},
      filled_{other.filled_} {}

void Socket::send(std::string_view bytes) {
    while (!bytes.empty()) {
        auto const sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        } else if (errno == EAGAIN) {
            wait_for(descriptor_, POLLOUT);
        } else {
            fail("send failed");
        }
    }
}

Socket::Received Socket::receive() {
    if (used_ == filled_) used_ = filled_ = 0;
    if (used_ > 0 && filled_ == input_.size()) {
        input_.erase(0, used_);
        filled_ -= std::exchange(used_, 0);
    }
    if (filled_ + smallest_input / 2 > input_.size()) input_.resize(std::max(smallest_input, 2 * input_.size()));
    auto const got = ::recv(descriptor_, input_.data() + filled_, input_.size() - filled_, MSG_DONTWAIT);
    if (got == 0) throw std::runtime_error("the server closed a connection");
    if (got < 0 && errno == EAGAIN) return Received::none;
    if (got < 0) fail("recv failed");
    filled_ += static_cast<std::size_t>(got);
    return Received::some;
}

std::optional<Socket::Message> Socket::next() {
    if (auto message = next_received()) return message;
    if (receive() == Received::none) return {};
    return next_received();
}

Socket::Message Socket::wait() {
    while (true) {
        if (auto const message = next()) return *message;
        wait_for(descriptor_, POLLIN);
    }
}

void Socket::drain() {
    while (receive() == Received::some) {
        if (via_ == Via::http) {
            used_ = filled_;
        } else {
            while (next_frame()) {
            }
        }
    }
}

std::optional<Socket::Message> Socket::next_received() { return via_ == Via::http ? next_http() : next_frame(); }

std::optional<Socket::Message> Socket::next_http() {
    auto const text = rest();
    auto const end = text.find("\r\n\r\n");
    if (end == text.npos) return {};
    auto const head = text.substr(0, end + 2);
    auto const size = content_length(head);
    if (text.size() < end + 4 + size) return {};
    used_ += end + 4 + size;
    return Message{head, text.substr(end + 4, size)};
}

std::optional<Socket::Message> Socket::next_frame() {
    while (true) {
        auto const text = rest();
        auto const head = kit::frame_head(text);
        if (!head || text.size() < head->size + head->payload_size) return {};
        auto const payload = text.substr(head->size, head->payload_size);
        used_ += head->size + payload.size();
        if (head->kind() == kit::Kind::text) return Message{{}, payload};
        if (head->kind() == kit::Kind::close) throw std::runtime_error("the server closed a WebSocket");
        if (head->kind() == kit::Kind::ping) send(kit::whole_frame(kit::Kind::pong, payload, kit::Masked::yes));
    }
}

}  // namespace rois::bench
