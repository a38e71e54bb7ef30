#include "net/wire.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <boost/asio/write.hpp>
#include <utility>

namespace rois::net {

namespace {

constexpr std::size_t smallest_read = 1024;
constexpr std::size_t largest_kept = 4 * 1024;  // while nothing is there
constexpr std::size_t largest_read = 64 * 1024;
constexpr std::size_t most_promised = 16 * 1024;  // memory for what a peer says it will send

}  // namespace

Wire::Wire(Socket socket, std::chrono::milliseconds write_timeout, Telemetry& telemetry)
    : socket_{std::move(socket)}, write_timeout_{write_timeout}, telemetry_{telemetry} {
    boost::system::error_code ignored;
    socket_.non_blocking(true, ignored);
    socket_.set_option(asio::ip::tcp::no_delay{true}, ignored);
}

void Wire::use(std::size_t bytes) {
    used_ += bytes;
    if (used_ < input_.size()) return;
    input_.clear();
    used_ = 0;
}

// Asio 1.26 tries to read before it waits, in vain nearly always: a request costs two reads. Its other ways to wait cost as much.
// The buffer of a connection that waits for its next request is small, since there may be many of them.
Task<Wire::Outcome> Wire::receive(Steady until, std::size_t expected) {
    input_.erase(0, std::exchange(used_, 0));
    auto const before = input_.size();
    if (before == 0 && input_.capacity() > largest_kept) std::string{}.swap(input_);
    input_.resize(before + std::clamp(std::max(before, std::min(expected, most_promised)), smallest_read, largest_read));
    input_due_ = until;
    boost::system::error_code error;
    auto const size = co_await socket_.async_read_some(asio::buffer(input_.data() + before, input_.size() - before), into(error));
    input_due_ = Steady::max();
    input_.resize(before + size);
    if (!error) co_return Outcome::done;
    co_return std::exchange(input_late_, false) ? Outcome::late : Outcome::closed;
}

void Wire::stop_waiting() { input_due_ = Steady::min(); }

std::size_t Wire::send_now(std::string_view text) {
    boost::system::error_code error;
    std::size_t sent = 0;
    while (sent < text.size() && !error) sent += socket_.write_some(asio::buffer(text.data() + sent, text.size() - sent), error);
    return sent;
}

Task<Wire::Outcome> Wire::send(std::string_view text) {
    auto const sent = send_now(text);
    if (sent == text.size()) co_return Outcome::done;
    output_due_ = std::chrono::steady_clock::now() + write_timeout_;
    boost::system::error_code error;
    co_await asio::async_write(socket_, asio::buffer(text.data() + sent, text.size() - sent), into(error));
    output_due_ = Steady::max();
    co_return error ? Outcome::closed : Outcome::done;
}

Wire::Watch Wire::watch(std::function<void()> gone) {
    auto watching = std::make_shared<bool>(true);
    socket_.async_wait(Socket::wait_read, [this, watching, gone = std::move(gone)](boost::system::error_code error) {
        if (error || !*watching) return;
        char byte = 0;
        auto const size = socket_.receive(asio::buffer(&byte, 1), Socket::message_peek, error);
        if (error || size == 0) gone();
    });
    return {*this, std::move(watching)};
}

Wire::Watch::~Watch() {
    boost::system::error_code ignored;
    *watching_ = false;
    wire_.socket_.cancel(ignored);
}

void Wire::finish() {
    boost::system::error_code ignored;
    socket_.shutdown(Socket::shutdown_send, ignored);
}

Task<> Wire::linger(Steady until) {
    finish();
    while (true) {
        use(input_.size() - used_);
        auto const outcome = co_await receive(until);
        if (outcome != Outcome::done) co_return;
    }
}

void Wire::sweep(Steady now) {
    if (now >= output_due_) {
        spdlog::warn("a connection was cut: its reader took nothing for {} s",
                     std::chrono::duration<double>(write_timeout_).count());
        telemetry_.cut();
        cut();
    } else if (now >= input_due_) {
        boost::system::error_code ignored;
        input_due_ = Steady::max();
        input_late_ = true;
        socket_.cancel(ignored);
    }
}

void Wire::cut() {
    boost::system::error_code ignored;
    socket_.close(ignored);
}

}  // namespace rois::net
