#include "net/server.hpp"

#include "net/asio.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

#include "gateway/clock.hpp"
#include "net/listener.hpp"
#include "net/loop.hpp"

namespace rois::net {

namespace {

using Signals = asio::basic_signal_set<Executor>;

std::string text_of(std::string const& host, std::uint16_t port) {
    bool const ipv6 = host.find(':') != std::string::npos;
    return (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace

class Server::Running {
public:
    Running(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
            std::shared_ptr<xml::Schemas const> schemas)
        : troubles_{telemetry, [this] { give_up_(); }},
          shared_{std::move(settings), gateway, telemetry, documents, std::move(schemas), troubles_},
          admission_{shared_.settings.max_connections, shared_.settings.max_connections_per_address},
          loops_{make_loops()},
          listeners_{make_listeners()},
          signals_{loops_.front()->executor()},
          hang_ups_{loops_.front()->executor()} {
        telemetry.set(Telemetry::Limit::connections, shared_.settings.max_connections);
        telemetry.set(Telemetry::Limit::connections_per_address, shared_.settings.max_connections_per_address);
        gateway.begin();  // before anybody can ask
        listen();
        signals_.add(SIGTERM);
        signals_.add(SIGINT);
    }

    std::string url() const { return "http://" + text_of(shared_.settings.host, port_); }

    void on_hang_up(std::function<void()> what) {
        on_hang_up_ = std::move(what);
        hang_ups_.add(SIGHUP);
    }

    void on_too_many_troubles(std::function<void()> what) { give_up_ = std::move(what); }

    bool run() {
        auto& first = *loops_.front();
        for (auto const& listener : listeners_)
            listener->loop().always(Troubles::Where::accept, [one = listener.get()] { return one->accept(); });
        first.always(Troubles::Where::loop, [this] { return wait_for_signal(); });
        if (on_hang_up_) first.always(Troubles::Where::loop, [this] { return wait_for_hang_ups(); });
        Clock const clock{shared_.settings.tick, [this] { shared_.gateway.tick(); }, troubles_};
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < loops_.size(); ++i) threads.emplace_back([loop = loops_[i].get()] { loop->run(); });
        loops_.front()->run();
        threads.clear();
        return await_halts();
    }

private:
    std::vector<std::unique_ptr<Loop>> make_loops() {
        std::vector<std::unique_ptr<Loop>> loops;
        loops.reserve(shared_.settings.threads);
        for (std::size_t i = 0; i < shared_.settings.threads; ++i) loops.push_back(std::make_unique<Loop>(shared_));
        return loops;
    }

    std::vector<std::unique_ptr<Listener>> make_listeners() {
        std::vector<std::unique_ptr<Listener>> listeners;
        listeners.reserve(loops_.size());
        for (auto const& loop : loops_) listeners.push_back(std::make_unique<Listener>(*loop, admission_));
        return listeners;
    }

    void listen() {
        auto const& settings = shared_.settings;
        auto& first = *listeners_.front();
        try {
            asio::ip::basic_resolver<asio::ip::tcp, Executor> resolver{first.executor()};
            auto const found = resolver.resolve(settings.host, std::to_string(settings.port), asio::ip::resolver_base::passive);
            first.bind_alone(found.begin()->endpoint());
            if (listeners_.size() > 1) first.share();
            for (std::size_t i = 1; i < listeners_.size(); ++i) listeners_[i]->bind_too(first.endpoint());
            for (auto const& listener : listeners_) listener->listen();
            port_ = first.endpoint().port();
        } catch (boost::system::system_error const& error) {
            throw std::runtime_error{"cannot listen on " + text_of(settings.host, settings.port) + ": " + error.code().message()};
        }
    }

    // When nobody is connected any more: the engine goes on with telling components to halt until they confirm it. Returns
    // whether all have confirmed in time.
    bool await_halts() {
        while (!shared_.gateway.not_halted().empty() && std::chrono::steady_clock::now() < last_moment_)
            std::this_thread::sleep_for(shared_.settings.tick);
        auto const not_halted = shared_.gateway.not_halted();
        for (auto const& ref : not_halted)
            spdlog::critical("{} did not confirm that it stands still: make sure that the robot does", ref);
        return not_halted.empty();
    }

    Task<> wait_for_hang_ups() {
        while (true) {
            co_await hang_ups_.async_wait(asio::use_awaitable_t<Executor>{});
            on_hang_up_();
        }
    }

    // Begun again after an exception, it goes on with what the first signal asks for.
    Task<> wait_for_signal() {
        if (!signalled_) {
            auto const signal = co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
            signalled_ = true;
            spdlog::info("shutting down after {}", signal == SIGTERM ? "SIGTERM" : "SIGINT");
        }
        for (auto const& listener : listeners_) listener->close();
        last_moment_ = std::chrono::steady_clock::now() + shared_.settings.shutdown_timeout;
        shared_.gateway.shut_down();
        for (auto const& loop : loops_) loop->shut_down(shared_.settings.shutdown_timeout);
        co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
        for (auto const& loop : loops_) loop->shut_down({});
    }

    // The system may know better what to do than a program that does not work: what supervises it starts it again.
    void halt_and_exit() {
        constexpr int internal_software_error = 70;  // EX_SOFTWARE
        constexpr std::string_view why = "too many exceptions in a second: all components were halted, and the gateway ends";
        shared_.gateway.halt_at_last();
        auto const dropped = shared_.telemetry.dropped_log_lines();
        spdlog::critical(why);
        spdlog::default_logger_raw()->flush();
        bool const no_memory = shared_.telemetry.dropped_log_lines() != dropped;  // for a line of the log
        if (no_memory) std::ignore = ::write(STDERR_FILENO, why.data(), why.size());
        std::_Exit(internal_software_error);
    }

    std::function<void()> give_up_ = [this] { halt_and_exit(); };
    Troubles troubles_;
    Shared shared_;
    Admission admission_;
    std::vector<std::unique_ptr<Loop>> loops_;
    std::vector<std::unique_ptr<Listener>> listeners_;
    Signals signals_;
    Signals hang_ups_;
    std::function<void()> on_hang_up_;
    bool signalled_ = false;
    std::uint16_t port_ = 0;
    Steady last_moment_;  // once it shuts down
};

Server::Server(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
               std::shared_ptr<xml::Schemas const> schemas)
    : running_{std::make_unique<Running>(std::move(settings), gateway, telemetry, documents, std::move(schemas))} {}

Server::~Server() = default;

std::string Server::url() const { return running_->url(); }

void Server::on_hang_up(std::function<void()> what) { running_->on_hang_up(std::move(what)); }

void Server::on_too_many_troubles(std::function<void()> what) { running_->on_too_many_troubles(std::move(what)); }

bool Server::run() { return running_->run(); }

}  // namespace rois::net
