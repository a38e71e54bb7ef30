#include "net/wire.hpp"

#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

namespace rois::net {

namespace {

constexpr std::size_t smallest_read = 1024;
constexpr std::size_t largest_kept = 4 * 1024;  // while nothing is there
constexpr std::size_t largest_read = 64 * 1024;
constexpr std::size_t most_promised = 16 * 1024;  // memory for what a peer says it will send

bool is_on_this_machine(Socket const& socket) {
    boost::system::error_code error;
    auto const peer = socket.remote_endpoint(error).address();
    if (peer.is_v6() && peer.to_v6().is_v4_mapped()) {
        return asio::ip::make_address_v4(asio::ip::v4_mapped, peer.to_v6()).is_loopback();
    }
    return peer.is_loopback();
}

// No path to share with others: whatever the system does against congestion (with BBR, a clock for each send) is for nothing.
void send_without_pacing(Socket& socket) {
    constexpr std::string_view simplest = "reno";  // every Linux has it, and lets everybody take it
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_CONGESTION, simplest.data(), simplest.size());
}

}  // namespace

Wire::Wire(Socket socket, Poller& poller, Resumptions& resumptions, std::chrono::milliseconds write_timeout, Telemetry& telemetry)
    : poller_{poller}, resumptions_{resumptions}, write_timeout_{write_timeout}, telemetry_{telemetry} {
    resumptions_.enter();
    boost::system::error_code ignored;
    socket.non_blocking(true, ignored);
    socket.set_option(asio::ip::tcp::no_delay{true}, ignored);
    if (is_on_this_machine(socket)) send_without_pacing(socket);
    socket_ = socket.release(ignored);
    if (socket_ >= 0 && !poller_.add(socket_, *this)) cut();
}

Wire::~Wire() {
    cut();
    resumptions_.leave();
}

std::string Wire::peer() const {
    asio::ip::tcp::endpoint endpoint;
    auto size = static_cast<socklen_t>(endpoint.capacity());
    if (::getpeername(socket_, endpoint.data(), &size) != 0) return "a client that has gone";
    endpoint.resize(size);
    auto const address = endpoint.address().to_string();
    return (endpoint.address().is_v6() ? "[" + address + "]" : address) + ":" + std::to_string(endpoint.port());
}

Task<> Wire::until_resumed(Waiter& waiter) {
    Token token;
    return asio::async_initiate<Token, void()>([&waiter]<class H>(H&& handler) { waiter.emplace(std::forward<H>(handler)); },
                                               token);
}

void Wire::resume(Waiter& waiter) {
    if (!waiter) return;
    auto handler = std::move(*waiter);
    waiter.reset();
    std::move(handler)();
}

// From the loop, not inline: the caller may still use state that the waiter would change.
void Wire::resume_later(Waiter& waiter) noexcept {
    if (!waiter) return;
    resumptions_.add(std::move(*waiter));
    waiter.reset();
}

void Wire::changed(std::uint32_t events) {
    ended_ = ended_ || (events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0;
    readable_ = readable_ || ended_ || (events & EPOLLIN) != 0;
    if (readable_ && !reader_) look_whether_gone();
    // Whoever is resumed may end the connection, and this with it: only one is.
    if (readable_ && reader_) {
        resume_later(writer_);
        resume(reader_);
    } else {
        resume(writer_);
    }
}

void Wire::use(std::size_t bytes) {
    used_ += bytes;
    if (used_ < input_.size()) return;
    input_.clear();
    used_ = 0;
}

// The buffer of a connection that waits for its next request is small, since there may be many of them.
std::optional<Wire::Outcome> Wire::receive_now(Steady until, std::size_t expected) {
    input_due_ = until;
    if (readable_ && !received_ && socket_ >= 0 && !input_late_) {
        input_.erase(0, std::exchange(used_, 0));
        auto const before = input_.size();
        input_.resize(before + std::clamp(std::max(before, std::min(expected, most_promised)), smallest_read, largest_read));
        auto const size = read_some(std::span{input_}.subspan(before));
        input_.resize(before + size.value_or(0));
        received_ = size.has_value();
        if (size) input_due_ = Steady::max();
        if (size) return *size > 0 ? Outcome::done : Outcome::closed;
    }
    if (input_late_ || socket_ < 0) {
        input_due_ = Steady::max();
        return std::exchange(input_late_, false) ? Outcome::late : Outcome::closed;
    }
    if (input_.empty() && input_.capacity() > largest_kept) std::string{}.swap(input_);
    return std::nullopt;
}

Task<> Wire::readable() {
    received_ = false;
    if (!readable_) return until_resumed(reader_);
    return next_turn();
}

Task<> Wire::next_turn() {
    Token token;
    return asio::async_initiate<Token, void()>([this]<class H>(H&& handler) { resumptions_.add(std::forward<H>(handler)); },
                                               token);
}

// Nothing when there is nothing to read yet; 0 at the end. Less than there is room for is all that there was.
std::optional<std::size_t> Wire::read_some(std::span<char> room) {
    auto size = ::recv(socket_, room.data(), room.size(), 0);
    while (size < 0 && errno == EINTR) size = ::recv(socket_, room.data(), room.size(), 0);
    bool const nothing = size < 0 && errno == EAGAIN;
    readable_ = ended_ || size == static_cast<ssize_t>(room.size());
    if (nothing) return std::nullopt;
    return static_cast<std::size_t>(std::max<ssize_t>(size, 0));
}

void Wire::stop_waiting() { input_due_ = Steady::min(); }

std::size_t Wire::send_now(std::string_view text) {
    std::size_t sent = 0;
    while (sent < text.size() && socket_ >= 0) {
        auto const size = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) {
            failed_ = errno != EAGAIN;
            break;
        }
        sent += static_cast<std::size_t>(size);
    }
    return sent;
}

Task<Wire::Outcome> Wire::send(std::string_view text) {
    text.remove_prefix(send_now(text));
    if (text.empty()) co_return Outcome::done;
    output_due_ = std::chrono::steady_clock::now() + write_timeout_;
    while (!text.empty() && !failed_ && socket_ >= 0) {
        co_await until_resumed(writer_);
        text.remove_prefix(send_now(text));
    }
    output_due_ = Steady::max();
    co_return text.empty() ? Outcome::done : Outcome::closed;
}

Wire::Watch Wire::watch(std::function<void()> gone, std::function<bool(Steady now)> is_proof) {
    watching_ = std::move(gone);
    is_proof_ = std::move(is_proof);
    if (readable_) look_whether_gone();
    return Watch{*this};
}

void Wire::look_whether_gone() {
    if (!watching_ || socket_ < 0) return;
    char byte = 0;
    auto const size = ::recv(socket_, &byte, 1, MSG_PEEK);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
        readable_ = ended_;
        return;
    }
    auto const gone = std::exchange(watching_, nullptr);
    if (size <= 0) gone();
}

// The system does it: the first probe after a second of silence, then one every second; it gives up at the second one that is due
// without an answer, and what was sent must be confirmed in that time, too.
void Wire::probe(bool on) {
    if (socket_ < 0 || on == probed_) return;
    probed_ = on;
    auto const set = [this](int level, int option, int value) { ::setsockopt(socket_, level, option, &value, sizeof value); };
    set(IPPROTO_TCP, TCP_KEEPIDLE, 1);
    set(IPPROTO_TCP, TCP_KEEPINTVL, 1);
    set(IPPROTO_TCP, TCP_USER_TIMEOUT, on ? 1'500 : 0);
    set(SOL_SOCKET, SO_KEEPALIVE, on ? 1 : 0);
}

void Wire::finish() {
    if (socket_ >= 0) ::shutdown(socket_, SHUT_WR);
}

Task<> Wire::linger(Steady until) {
    finish();
    while (true) {
        use(input_.size() - used_);
        auto const outcome = receive_now(until);
        if (!outcome) co_await readable();
        if (outcome && outcome != Outcome::done) co_return;
    }
}

void Wire::sweep(Steady now) {
    probe(is_proof_ && is_proof_(now));
    if (now >= output_due_) {
        spdlog::warn("a connection was cut: its reader took nothing for {} s",
                     std::chrono::duration<double>(write_timeout_).count());
        telemetry_.cut();
        cut();
    } else if (now >= input_due_) {
        input_due_ = Steady::max();
        input_late_ = true;
        resume_later(reader_);
    }
}

void Wire::cut() noexcept {
    if (socket_ < 0) return;
    poller_.remove(socket_, *this);
    ::close(std::exchange(socket_, -1));
    resume_later(reader_);
    resume_later(writer_);
}

}  // namespace rois::net
