#include "wire/wire.hpp"

#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/write.hpp>
#include <utility>

#include "types/text/address.hpp"
#include "wire/credentials.hpp"

namespace rois::net {

namespace {

constexpr std::size_t smallest_read = 1024;
constexpr std::size_t largest_kept = 4 * 1024;    // bytes of memory of an empty input buffer
constexpr std::size_t largest_read = 16 * 1024;   // a turn: with larger ones, a thousand long bodies keep `stop` waiting
constexpr std::size_t most_promised = 16 * 1024;  // bytes of memory for announced input
constexpr char first_byte_of_tls = 0x16;          // the type of the record of a handshake (RFC 8446, 5.1)

}  // namespace

Wire::Wire(Socket socket, std::chrono::milliseconds write_timeout, Telemetry& telemetry)
    : socket_{std::move(socket)}, write_timeout_{write_timeout}, telemetry_{telemetry} {
    boost::system::error_code ignored;
    socket_.non_blocking(true, ignored);
    socket_.set_option(asio::ip::tcp::no_delay{true}, ignored);
}

std::string Wire::peer() const {
    boost::system::error_code error;
    auto const endpoint = socket_.remote_endpoint(error);
    if (error) return "a closed connection";
    if (endpoint.data()->sa_family == AF_UNIX) return "this gateway";
    return host_and_port(endpoint.address().to_string(), endpoint.port());
}

void Wire::use(std::size_t bytes) {
    used_ += bytes;
    if (used_ < input_.size()) return;
    input_.clear();
    used_ = 0;
}

Task<bool> Wire::take_turn(Turns& turns) {
    Timer timer{executor()};
    struct Waiting {
        Timer*& turn;
        ~Waiting() { turn = nullptr; }
    } const waiting{turn_ = &timer};
    boost::system::error_code error;
    auto const endpoint = socket_.remote_endpoint(error);
    co_await turns.take(error ? asio::ip::address{} : endpoint.address(), timer);
    co_return socket_.is_open();
}

Task<Wire::Outcome> Wire::secure(std::shared_ptr<asio::ssl::context> context, Steady until, Turns& turns) {
    auto const received = co_await receive(until);
    if (received != Outcome::done || input_.front() != first_byte_of_tls) co_return received;
    tls_ = std::make_unique<Tls>(std::move(context), socket_);
    tls::PausedHandshake handshake{tls_->stream.native_handle()};
    boost::system::error_code error;
    while (true) {
        input_due_ = until;
        auto const read = co_await tls_->stream.async_handshake(
            asio::ssl::stream_base::server, asio::buffer(input_.data() + used_, input_.size() - used_), into(error));
        bool const pauses = handshake.pauses();
        use(pauses ? input_.size() - used_ : read);  // with an error, Asio has kept all input
        if (!pauses) break;
        auto const is_open = co_await take_turn(turns);
        input_late_ = input_late_ || std::chrono::steady_clock::now() >= until;
        if (!is_open || input_late_) co_return input_ended(asio::error::operation_aborted);
    }
    // Otherwise a client whose system waits for this acknowledgement (Nagle's algorithm) sends its request 40 ms later.
    int const on = 1;
    ::setsockopt(socket_.native_handle(), IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
    co_return input_ended(error);
}

Wire::Outcome Wire::input_ended(boost::system::error_code error) {
    input_due_ = Steady::max();
    bool const interrupted = std::exchange(interrupted_, false), late = std::exchange(input_late_, false);
    if (!error || interrupted) return Outcome::done;
    return late ? Outcome::late : Outcome::closed;
}

// Uses a small buffer while no input waits: there may be many idle connections.
Task<Wire::Outcome> Wire::receive(Steady until, std::size_t expected) {
    input_.erase(0, std::exchange(used_, 0));
    auto const before = input_.size();
    if (before == 0 && input_.capacity() > largest_kept) std::string{}.swap(input_);
    input_.resize(before + std::clamp(std::max(before, std::min(expected, most_promised)), smallest_read, largest_read));
    input_due_ = until;
    boost::system::error_code error;
    auto const room = asio::buffer(input_.data() + before, input_.size() - before);
    std::size_t size = 0;
    if (tls_)
        size = co_await tls_->stream.async_read_some(room, into(error));
    else
        size = co_await socket_.async_read_some(room, into(error));
    input_.resize(before + size);
    co_return input_ended(error);
}

void Wire::interrupt() {
    if (input_due_ == Steady::max()) return;
    interrupted_ = true;
    boost::system::error_code ignored;
    socket_.cancel(ignored);
}

std::size_t Wire::send_now(std::string_view text) {
    std::size_t sent = 0;
    boost::system::error_code error;
    while (!tls_ && sent < text.size() && !error) sent += socket_.write_some(asio::buffer(text.substr(sent)), error);
    return sent;
}

Task<Wire::Outcome> Wire::send(std::string_view text) {
    text.remove_prefix(send_now(text));
    if (text.empty()) co_return Outcome::done;
    output_due_ = std::chrono::steady_clock::now() + write_timeout_;
    boost::system::error_code error;
    if (tls_)
        co_await asio::async_write(tls_->stream, asio::buffer(text), into(error));
    else
        co_await asio::async_write(socket_, asio::buffer(text), into(error));
    output_due_ = Steady::max();
    co_return error ? Outcome::closed : Outcome::done;
}

Wire::Watch Wire::watch(std::function<void()> closed, std::function<bool(Steady now)> is_proof) {
    watching_.emplace(Watching{std::move(closed), std::move(is_proof)});
    return Watch{*this};
}

// Not by reading: input may be a part of the next request, or a record of TLS.
void Wire::check_for_close() {
    if (watching_->gone || !socket_.is_open()) return;
    pollfd state{.fd = socket_.native_handle(), .events = POLLRDHUP, .revents = 0};
    watching_->gone = ::poll(&state, 1, 0) > 0;
    if (watching_->gone) watching_->closed();
}

// The system sends a probe after each second of silence. The connection breaks when the second probe is due and the first one has
// no answer, or if sent data is not acknowledged in that time.
void Wire::probe(bool on) {
    if (!socket_.is_open() || on == probed_) return;
    probed_ = on;
    auto const set = [this](int level, int option, int value) {
        ::setsockopt(socket_.native_handle(), level, option, &value, sizeof value);
    };
    set(IPPROTO_TCP, TCP_KEEPIDLE, 1);
    set(IPPROTO_TCP, TCP_KEEPINTVL, 1);
    set(IPPROTO_TCP, TCP_USER_TIMEOUT, on ? 1'500 : 0);
    set(SOL_SOCKET, SO_KEEPALIVE, on ? 1 : 0);
}

void Wire::finish() {
    boost::system::error_code ignored;
    socket_.shutdown(Socket::shutdown_send, ignored);
}

// With TLS, announces the end first. Bytes that arrive later are discarded without being decrypted.
Task<> Wire::linger(Steady until) {
    if (tls_) {
        input_due_ = until;
        boost::system::error_code error;
        co_await tls_->stream.async_shutdown(into(error));
        input_ended(error);
        tls_.reset();
    }
    finish();
    auto outcome = Outcome::done;
    while (outcome == Outcome::done) {
        use(input_.size() - used_);
        outcome = co_await receive(until);
    }
}

void Wire::sweep(Steady now) {
    probe(watching_ && watching_->is_proof(now));
    if (watching_) check_for_close();
    if (now >= output_due_) {
        spdlog::warn("the connection of {} was cut: the client has not read for {} s (write_timeout)", peer(),
                     std::chrono::duration<double>(write_timeout_).count());
        telemetry_.cut();
        cut();
    } else if (now >= input_due_) {
        input_late_ = true;
        boost::system::error_code ignored;
        socket_.cancel(ignored);
    }
}

UniqueDescriptor Wire::release() {
    boost::system::error_code ignored;
    return UniqueDescriptor{socket_.release(ignored)};
}

void Wire::cut() {
    if (turn_ != nullptr) turn_->cancel();
    boost::system::error_code ignored;
    socket_.close(ignored);
}

}  // namespace rois::net
