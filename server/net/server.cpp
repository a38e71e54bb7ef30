#include "net/server.hpp"

#include "net/asio.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <vector>

#include "net/loop.hpp"

namespace rois::net {

namespace {

using Acceptor = asio::basic_socket_acceptor<asio::ip::tcp, Executor>;
using Signals = asio::basic_signal_set<Executor>;

constexpr auto pause_when_full = std::chrono::milliseconds{50};

std::string text_of(std::string const& host, std::uint16_t port) {
    bool const ipv6 = host.find(':') != std::string::npos;
    return (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace

class Server::Running {
public:
    Running(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
            std::shared_ptr<xml::Schemas const> schemas)
        : shared_{std::move(settings), gateway, telemetry, documents, std::move(schemas)},
          loops_{make_loops()},
          acceptor_{loops_.front()->executor()},
          signals_{loops_.front()->executor()},
          hang_ups_{loops_.front()->executor()} {
        telemetry.may_open(shared_.settings.max_connections);
        gateway.tick();  // time begins before anybody can ask
        listen();
        signals_.add(SIGTERM);
        signals_.add(SIGINT);
    }

    std::string url() const { return "http://" + text_of(shared_.settings.host, port_); }

    void on_hang_up(std::function<void()> what) {
        on_hang_up_ = std::move(what);
        hang_ups_.add(SIGHUP);
    }

    void run() {
        auto const first = loops_.front()->executor();
        asio::co_spawn(first, accept(), asio::detached);
        asio::co_spawn(first, tick(), asio::detached);
        asio::co_spawn(first, wait_for_signal(), asio::detached);
        if (on_hang_up_) asio::co_spawn(first, wait_for_hang_ups(), asio::detached);
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < loops_.size(); ++i) threads.emplace_back([loop = loops_[i].get()] { loop->run(); });
        loops_.front()->run();
    }

private:
    std::vector<std::unique_ptr<Loop>> make_loops() const {
        std::vector<std::unique_ptr<Loop>> loops;
        loops.reserve(shared_.settings.threads);
        for (std::size_t i = 0; i < shared_.settings.threads; ++i) loops.push_back(std::make_unique<Loop>(shared_));
        return loops;
    }

    void listen() {
        auto const& settings = shared_.settings;
        try {
            asio::ip::basic_resolver<asio::ip::tcp, Executor> resolver{acceptor_.get_executor()};
            auto const found = resolver.resolve(settings.host, std::to_string(settings.port), asio::ip::resolver_base::passive);
            auto const endpoint = found.begin()->endpoint();
            acceptor_.open(endpoint.protocol());
            acceptor_.set_option(asio::socket_base::reuse_address{true});
            acceptor_.bind(endpoint);
            acceptor_.listen();
            port_ = acceptor_.local_endpoint().port();
        } catch (boost::system::system_error const& error) {
            throw std::runtime_error{"cannot listen on " + text_of(settings.host, settings.port) + ": " + error.code().message()};
        }
    }

    // Hands the connections out to the loops in turn. Stops at the limit, and for a moment when the system has nothing to give.
    Task<> accept() {
        Timer pause{acceptor_.get_executor()};
        bool full = false;
        for (std::size_t next = 0; acceptor_.is_open();) {
            boost::system::error_code error;
            if (shared_.telemetry.open_connections() >= shared_.settings.max_connections) {
                if (!std::exchange(full, true)) {
                    shared_.telemetry.full();
                    spdlog::warn("{} connections are open; more must wait", shared_.settings.max_connections);
                }
                pause.expires_after(pause_when_full);
                co_await pause.async_wait(into(error));
                continue;
            }
            full = false;
            auto& loop = *loops_[next];
            auto socket = co_await acceptor_.async_accept(loop.executor(), into(error));
            if (!error) {
                loop.serve(std::move(socket));
                next = (next + 1) % loops_.size();
            } else if (error != asio::error::operation_aborted) {
                spdlog::warn("cannot accept a connection: {}", error.message());
                pause.expires_after(pause_when_full);
                co_await pause.async_wait(into(error));
            }
        }
    }

    Task<> tick() {
        Timer timer{acceptor_.get_executor()};
        while (true) {
            timer.expires_after(shared_.settings.tick);
            co_await timer.async_wait(asio::use_awaitable_t<Executor>{});
            shared_.gateway.tick();
        }
    }

    Task<> wait_for_hang_ups() {
        while (true) {
            co_await hang_ups_.async_wait(asio::use_awaitable_t<Executor>{});
            on_hang_up_();
        }
    }

    Task<> wait_for_signal() {
        auto const signal = co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
        spdlog::info("shutting down after {}", signal == SIGTERM ? "SIGTERM" : "SIGINT");
        acceptor_.close();
        shared_.gateway.shut_down();
        for (auto const& loop : loops_) loop->shut_down(shared_.settings.shutdown_timeout);
        co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
        for (auto const& loop : loops_) loop->shut_down({});
    }

    Shared shared_;
    std::vector<std::unique_ptr<Loop>> loops_;
    Acceptor acceptor_;
    Signals signals_;
    Signals hang_ups_;
    std::function<void()> on_hang_up_;
    std::uint16_t port_ = 0;
};

Server::Server(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
               std::shared_ptr<xml::Schemas const> schemas)
    : running_{std::make_unique<Running>(std::move(settings), gateway, telemetry, documents, std::move(schemas))} {}

Server::~Server() = default;

std::string Server::url() const { return running_->url(); }

void Server::on_hang_up(std::function<void()> what) { running_->on_hang_up(std::move(what)); }

void Server::run() { running_->run(); }

}  // namespace rois::net
