#include "net/listener.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/post.hpp>
#include <new>
#include <string>

#include "net/http/http_answer.hpp"
#include "net/loop.hpp"

namespace rois::net {

namespace {

// A peer that gave up before it was accepted. Asio would report nothing, and wait for a sign of another one.
bool has_gone(boost::system::error_code const& error) {
    return error == asio::error::connection_aborted || error == boost::system::errc::protocol_error;
}

constexpr auto between_tries = std::chrono::milliseconds{50};
constexpr auto between_looks = std::chrono::milliseconds{10};  // for a stranger
constexpr unsigned most_at_once = 64;                          // connections, before the open ones have a turn
constexpr unsigned most_without_memory = 64;                   // connections between two pauses while the system has no memory

// Returns nothing if the peer has already closed the connection.
std::optional<Address> remote_address(Socket const& socket) {
    boost::system::error_code error;
    auto const endpoint = socket.remote_endpoint(error);
    return error ? std::nullopt : read_address(endpoint.address().to_string());
}

// Sends the reason, without waiting for the peer.
std::nullopt_t refuse(Socket& socket, Shared const& shared, Fault const& fault) {
    shared.telemetry.reached(Telemetry::Limit::connections_per_address);
    shared.telemetry.faulted(FaultCode::too_many);
    std::string text;
    append(text, answer_of(fault), {Framing::Body::sent, true});
    boost::system::error_code ignored;
    socket.non_blocking(true, ignored);
    socket.write_some(asio::buffer(text), ignored);
    socket.shutdown(Socket::shutdown_send, ignored);
    std::array<char, 4096> request{};  // unread bytes would reset the connection before the peer reads the answer
    socket.read_some(asio::buffer(request), ignored);
    return std::nullopt;
}

}  // namespace

Listener::Listener(Loop& loop, Admission& admission, Loop::From from)
    : loop_{loop}, admission_{admission}, from_{from}, acceptor_{loop.executor()}, timer_{loop.executor()} {}

void Listener::bind(Endpoint const& endpoint, Port port) {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address{true});
    acceptor_.set_option(asio::socket_base::enable_connection_aborted{true});
    if (port == Port::shared) share_port();
    acceptor_.bind(endpoint);
}

void Listener::share_port() {
    int const on = 1;
    if (::setsockopt(acceptor_.native_handle(), SOL_SOCKET, SO_REUSEPORT, &on, sizeof on) != 0)
        throw boost::system::system_error{errno, boost::system::system_category()};
}

void Listener::listen() {
    acceptor_.listen();
    acceptor_.non_blocking(true);
}

// Pauses often while the system has no memory, so that the loop can cut waiting connections.
Task<> Listener::accept() {
    auto const& memory = loop_.shared().gateway.memory();
    for (unsigned taken = 1; acceptor_.is_open(); ++taken) {
        bool accepted = false;
        try {
            accepted = co_await accept_waiting();
        } catch (std::bad_alloc const&) {
            spdlog::warn("cannot accept a connection: the system gives the gateway no more memory");
        }
        if (!accepted || (taken % most_without_memory == 0 && memory.exhausted())) co_await pause(between_tries);
    }
}

// Waits for a connection, and accepts all that wait behind it at once. So under a flood, a client that wants to stop the robot
// is accepted before the others are served. Returns false if the system cannot accept a connection now.
Task<bool> Listener::accept_waiting() {
    boost::system::error_code error;
    auto socket = co_await acceptor_.async_accept(into(error));
    for (unsigned accepted = 1; !error; ++accepted) {
        auto place = co_await this->place(socket);
        if (place) serve(std::move(socket), std::move(*place));
        if (accepted == most_at_once || !acceptor_.is_open() || loop_.shared().gateway.memory().exhausted()) co_return true;
        socket = acceptor_.accept(error);
    }
    if (error == asio::error::operation_aborted || error == asio::error::would_block || has_gone(error)) co_return true;
    spdlog::warn("cannot accept a connection: {}", error.message());
    co_return false;
}

// Closes a connection that cannot be started, for example because there is no memory.
void Listener::serve(Socket socket, Admission::Place place) {
    try {
        loop_.serve(std::move(socket), std::move(place), from_);
    } catch (...) {
        loop_.shared().troubles.report(Troubles::Where::connection);
    }
}

// Without a free place, takes that of a stranger or, if there is none, of the connection that has been idle for longest; or
// waits: then the kernel keeps further connections waiting. Never waits because of the limit of an address: others may be behind.
// Returns nothing if that limit stays, or if the listener is closed.
Task<std::optional<Admission::Place>> Listener::place(Socket& socket) {
    auto& shared = loop_.shared();
    auto const address = remote_address(socket);
    if (!address) co_return std::nullopt;
    auto const limits = limits_of(*address, shared.settings().proxies);
    bool const has_tokens = shared.gateway.tokens() != nullptr;
    auto number = Admission::OfAddress::limited;
    for (bool all_known = !has_tokens; acceptor_.is_open();) {
        auto entered = admission_.enter(*address, limits, number);
        if (auto* place = std::get_if<Admission::Place>(&entered)) co_return std::move(*place);
        if (std::get<Admission::Refused>(entered) == Admission::Refused::full_of_address) {
            if (!has_tokens) co_return refuse(socket, shared, admission_.too_many_of("this address"));
            number = Admission::OfAddress::any_number;  // at most one stranger more on each thread
            loop_.cut_stranger(&*address);
            continue;
        }
        if (admission_.is_news()) {
            shared.telemetry.reached(Telemetry::Limit::connections);
            spdlog::warn("{} connections are open: each new one waits, or replaces one that is idle",
                         shared.settings().max_connections);
        }
        if (all_known ? loop_.cut_longest_idle() : loop_.cut_stranger(nullptr) == Loop::Stranger::cut) continue;
        auto const found = shared.make_room(!all_known);
        co_await pause(all_known ? between_tries : between_looks);
        all_known = !has_tokens || (!all_known && found.use_count() == 1 && !*found);
    }
    co_return std::nullopt;
}

Task<> Listener::pause(std::chrono::milliseconds time) {
    boost::system::error_code error;
    timer_.expires_after(time);
    co_await timer_.async_wait(into(error));
}

void Listener::close() {
    asio::post(loop_.executor(), [this] {
        acceptor_.close();
        timer_.cancel();
    });
}

}  // namespace rois::net
