#include "net/listener.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/post.hpp>
#include <new>
#include <string>

#include "net/http_answer.hpp"
#include "net/loop.hpp"

namespace rois::net {

namespace {

// SO_REUSEPORT, switched on: Asio has no public name for it. A type of Asio's concept SettableSocketOption.
struct ReusePort {
    static int level(asio::ip::tcp const&) { return SOL_SOCKET; }
    static int name(asio::ip::tcp const&) { return SO_REUSEPORT; }
    void const* data(asio::ip::tcp const&) const { return &on; }
    static std::size_t size(asio::ip::tcp const&) { return sizeof on; }

    int on = 1;
};

constexpr auto between_tries = std::chrono::milliseconds{50};
constexpr unsigned most_without_memory = 64;  // connections taken between two pauses, while the system has no memory

// Nothing if the peer has gone already.
std::optional<Address> remote_address(Socket const& socket) {
    boost::system::error_code error;
    auto const endpoint = socket.remote_endpoint(error);
    return error ? std::nullopt : read_address(endpoint.address().to_string());
}

// Says why, as far as the peer takes it at once: a connection that is refused gets no time.
void refuse(Socket& socket, Shared const& shared) {
    shared.telemetry.reached(Telemetry::Limit::connections_per_address);
    shared.telemetry.faulted(FaultCode::too_many);
    std::string text;
    append(text,
           answer_of({FaultCode::too_many,
                      "this address has " + std::to_string(shared.settings.max_connections_per_address) +
                          " connections open already: close one; the key max_connections_per_address sets the limit",
                      {},
                      {}}),
           {.body = true, .close = true});
    ::send(socket.native_handle(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    ::shutdown(socket.native_handle(), SHUT_WR);
    std::array<char, 4096> ignored{};
    ::recv(socket.native_handle(), ignored.data(), ignored.size(), MSG_DONTWAIT);  // what is unread would reset the connection
}

}  // namespace

Listener::Listener(Loop& loop, Admission& admission)
    : loop_{loop}, admission_{admission}, acceptor_{loop.executor()}, pause_{loop.executor()} {}

void Listener::open(Endpoint const& endpoint) {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address{true});
}

void Listener::bind_alone(Endpoint const& endpoint) {
    open(endpoint);
    acceptor_.bind(endpoint);
}

void Listener::share() { acceptor_.set_option(ReusePort{}); }

void Listener::bind_too(Endpoint const& endpoint) {
    open(endpoint);
    share();
    acceptor_.bind(endpoint);
}

void Listener::listen() { acceptor_.listen(); }

// While the system has no memory, the listener pauses often enough that the loop can cut connections that wait.
Task<> Listener::accept() {
    auto const& memory = loop_.shared().gateway.memory();
    for (unsigned taken = 1; acceptor_.is_open(); ++taken) {
        bool accepted = false;
        try {
            accepted = co_await accept_one();
        } catch (std::bad_alloc const&) {
            spdlog::warn("cannot accept a connection: the system gives the gateway no more memory");
        }
        bool const crowded = taken % most_without_memory == 0 && memory.exhausted();
        if (accepted && !crowded) continue;
        boost::system::error_code error;
        pause_.expires_after(between_tries);
        co_await pause_.async_wait(into(error));
    }
}

// False when the system gives no connection.
Task<bool> Listener::accept_one() {
    boost::system::error_code error;
    auto socket = co_await acceptor_.async_accept(into(error));
    if (error == asio::error::operation_aborted) co_return true;
    if (error) {
        spdlog::warn("cannot accept a connection: {}", error.message());
        co_return false;
    }
    auto place = co_await this->place(socket);
    if (place) serve(std::move(socket), std::move(*place));
    co_return true;
}

// A connection that cannot begin, for example because memory is missing, is closed.
void Listener::serve(Socket socket, Admission::Place place) {
    try {
        loop_.serve(std::move(socket), std::move(place));
    } catch (...) {
        loop_.shared().troubles.report(Troubles::Where::connection);
    }
}

// A connection that finds all places taken waits, and those behind it in the kernel. None when the listener is closed meanwhile.
// It is refused at once if its address has as many as it may.
Task<std::optional<Admission::Place>> Listener::place(Socket& socket) {
    auto const address = remote_address(socket);
    if (!address) co_return std::nullopt;
    auto const limits = limits_of(*address, loop_.shared().settings.proxies);
    while (acceptor_.is_open()) {
        auto entered = admission_.enter(*address, limits);
        if (auto* place = std::get_if<Admission::Place>(&entered)) co_return std::move(*place);
        if (std::get<Admission::Refused>(entered) == Admission::Refused::full_of_address) {
            refuse(socket, loop_.shared());
            co_return std::nullopt;
        }
        if (admission_.is_news()) {
            loop_.shared().telemetry.reached(Telemetry::Limit::connections);
            spdlog::warn("{} connections are open; more must wait", loop_.shared().settings.max_connections);
        }
        boost::system::error_code error;
        pause_.expires_after(between_tries);
        co_await pause_.async_wait(into(error));
    }
    co_return std::nullopt;
}

void Listener::close() {
    asio::post(loop_.executor(), [this] {
        acceptor_.close();
        pause_.cancel();
    });
}

}  // namespace rois::net
