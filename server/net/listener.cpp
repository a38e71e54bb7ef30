#include "net/listener.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <boost/asio/post.hpp>

#include "net/loop.hpp"

namespace rois::net {

namespace {

using ReusePort = asio::detail::socket_option::boolean<SOL_SOCKET, SO_REUSEPORT>;

constexpr auto between_tries = std::chrono::milliseconds{50};

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

void Listener::share() { acceptor_.set_option(ReusePort{true}); }

void Listener::bind_too(Endpoint const& endpoint) {
    open(endpoint);
    share();
    acceptor_.bind(endpoint);
}

void Listener::listen() { acceptor_.listen(); }

Task<> Listener::accept() {
    while (acceptor_.is_open()) {
        boost::system::error_code error;
        auto socket = co_await acceptor_.async_accept(into(error));
        if (!error) {
            auto place = co_await this->place();
            if (place) loop_.serve(std::move(socket), std::move(*place));
        } else if (error != asio::error::operation_aborted) {
            spdlog::warn("cannot accept a connection: {}", error.message());
            pause_.expires_after(between_tries);
            co_await pause_.async_wait(into(error));
        }
    }
}

// A connection that finds all places taken waits, and those behind it in the kernel. None when the listener is closed meanwhile.
Task<std::optional<Admission::Place>> Listener::place() {
    while (acceptor_.is_open()) {
        if (auto place = admission_.enter()) co_return place;
        if (admission_.is_news()) {
            loop_.shared().telemetry.full();
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
