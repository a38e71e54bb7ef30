#include "net/server.hpp"

#include "wire/asio.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <deque>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "gateway/clock.hpp"
#include "gateway/shutdown.hpp"
#include "net/listener.hpp"
#include "net/loop.hpp"
#include "types/text/address.hpp"
#include "wire/relay.hpp"

namespace rois::net {

class Server::Running {
public:
    Running(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
            std::shared_ptr<xml::Schemas const> schemas)
        : troubles_{telemetry, [this] { give_up_(); }},
          shared_{std::move(settings), gateway, telemetry, documents, std::move(schemas), troubles_},
          admission_{shared_.settings().max_connections, shared_.settings().max_connections_per_address},
          first_{add_loop()},
          signals_{first_.executor(), SIGTERM, SIGINT},
          hang_ups_{first_.executor()} {
        while (loops_.size() < shared_.settings().threads) add_loop();
        shared_.make_room = [this](bool among_strangers) {
            auto const found = std::make_shared<std::atomic<bool>>(false);
            for (auto& loop : loops_)
                asio::post(loop.executor(), [&loop, among_strangers, found] {
                    if (!among_strangers) loop.cut_longest_idle();
                    if (among_strangers && loop.cut_stranger(nullptr) != Loop::Stranger::none) *found = true;
                });
            return found;
        };
        show_limits(shared_.settings());
        gateway.begin();  // before the first request
        listen();
    }

    std::string url() const {
        return (shared_.settings().credentials ? "https://" : "http://") + host_and_port(shared_.settings().host, port_);
    }

    std::string url_for_programs() const { return "http://" + host_and_port("127.0.0.1", port_for_programs_); }

    UniqueDescriptor connect() {
        LocalSocket inside{first_.executor()}, outside{first_.executor()};
        asio::local::connect_pair(inside, outside);
        asio::post(first_.executor(),
                   [this, place = admission_.enter_from_inside(), socket = UniqueDescriptor{inside.release()}]() mutable {
                       Socket inner{first_.executor(), asio::ip::tcp::v4(), socket.release()};
                       first_.serve(std::move(inner), std::move(place), Loop::From::this_process);
                   });
        return UniqueDescriptor{outside.release()};
    }

    void on_hang_up(std::function<void()> what) {
        on_hang_up_ = std::move(what);
        hang_ups_.add(SIGHUP);
    }

    void use(Settings const& wanted) {
        auto next = with_changes(shared_.settings(), wanted);
        admission_.limit(next.max_connections, next.max_connections_per_address);
        show_limits(next);
        shared_.use(std::move(next));
    }

    void on_too_many_troubles(std::function<void()> what) { give_up_ = std::move(what); }

    bool run() {
        for (auto& listener : listeners_)
            listener.loop().run_forever(Troubles::Where::accept, [&listener] { return listener.accept(); });
        if (for_programs_) first_.run_forever(Troubles::Where::accept, [this] { return for_programs_->accept(); });
        first_.run_forever(Troubles::Where::loop, [this] { return wait_for_signal(); });
        if (on_hang_up_) first_.run_forever(Troubles::Where::loop, [this] { return wait_for_hang_ups(); });
        Clock const clock{shared_.settings().tick, shared_.gateway, troubles_};
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < loops_.size(); ++i) threads.emplace_back([this, i] { loops_[i].run(); });
        first_.run();
        threads.clear();
        return await_halts(shared_.gateway, last_moment_, shared_.settings().tick);
    }

private:
    using Signals = asio::basic_signal_set<Executor>;

    void show_limits(Settings const& settings) {
        shared_.telemetry.set(Telemetry::Limit::connections, settings.max_connections);
        shared_.telemetry.set(Telemetry::Limit::connections_per_address, settings.max_connections_per_address);
    }

    Loop& add_loop() {
        auto& loop = loops_.emplace_back(shared_);
        listeners_.emplace_back(loop, admission_, Loop::From::network);
        return loop;
    }

    void listen() {
        auto const& settings = shared_.settings();
        if (settings.host.empty()) return;
        auto& first = listeners_.front();
        try {
            asio::ip::basic_resolver<asio::ip::tcp, Executor> resolver{first.executor()};
            auto const found = resolver.resolve(settings.host, std::to_string(settings.port), asio::ip::resolver_base::passive);
            first.bind(found.begin()->endpoint(), Listener::Port::alone);
            if (listeners_.size() > 1) first.share_port();
            for (std::size_t i = 1; i < listeners_.size(); ++i) listeners_[i].bind(first.endpoint(), Listener::Port::shared);
            for (auto& listener : listeners_) listener.listen();
            port_ = first.endpoint().port();
            if (settings.program_tokens == nullptr) return;
            for_programs_.emplace(first_, admission_, Loop::From::programs);
            for_programs_->bind({asio::ip::address_v4::loopback(), 0}, Listener::Port::alone);
            for_programs_->listen();
            port_for_programs_ = for_programs_->endpoint().port();
        } catch (boost::system::system_error const& error) {
            throw std::runtime_error{"cannot listen on " + host_and_port(settings.host, settings.port) + ": " +
                                     error.code().message()};
        }
    }

    Task<> wait_for_hang_ups() {
        for (;; on_hang_up_()) co_await hang_ups_.async_wait(asio::use_awaitable_t<Executor>{});
    }

    // When it is started again after an exception, it continues to handle the first signal.
    Task<> wait_for_signal() {
        if (!signalled_) {
            auto const signal = co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
            signalled_ = true;
            spdlog::info("shutting down after {}", signal == SIGTERM ? "SIGTERM" : "SIGINT");
        }
        for (auto& listener : listeners_) listener.close();
        if (for_programs_) for_programs_->close();
        last_moment_ = std::chrono::steady_clock::now() + shared_.settings().shutdown_timeout;
        shared_.gateway.shut_down();
        for (auto& loop : loops_) loop.shut_down(shared_.settings().shutdown_timeout);
        co_await signals_.async_wait(asio::use_awaitable_t<Executor>{});
        for (auto& loop : loops_) loop.shut_down({});
    }

    std::function<void()> give_up_ = [this] {
        halt_and_exit(shared_.gateway, shared_.telemetry, "too many exceptions in a second");
    };
    Troubles troubles_;
    Shared shared_;
    Admission admission_;
    std::deque<Loop> loops_;
    std::deque<Listener> listeners_;  // one for each loop
    Loop& first_;
    std::optional<Listener> for_programs_;
    Signals signals_;
    Signals hang_ups_;
    std::function<void()> on_hang_up_;
    bool signalled_ = false;
    std::uint16_t port_ = 0, port_for_programs_ = 0;
    Steady last_moment_;  // for clients and components, once it shuts down
};

Server::Server(Settings settings, Gateway& gateway, Telemetry& telemetry, Documents const& documents,
               std::shared_ptr<xml::Schemas const> schemas)
    : running_{std::make_unique<Running>(std::move(settings), gateway, telemetry, documents, std::move(schemas))} {}

Server::~Server() = default;

std::string Server::url() const { return running_->url(); }
std::string Server::url_for_programs() const { return running_->url_for_programs(); }
UniqueDescriptor Server::connect() { return running_->connect(); }
void Server::on_hang_up(std::function<void()> what) { running_->on_hang_up(std::move(what)); }
void Server::use(Settings const& settings) { running_->use(settings); }
void Server::on_too_many_troubles(std::function<void()> what) { running_->on_too_many_troubles(std::move(what)); }
bool Server::run() { return running_->run(); }

}  // namespace rois::net
