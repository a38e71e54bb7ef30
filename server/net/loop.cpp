#include "net/loop.hpp"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <thread>
#include <utility>

#include "net/http/connection.hpp"

namespace rois::net {

namespace {

constexpr auto between_sweeps = std::chrono::milliseconds{50};
constexpr auto shortest_idle = std::chrono::milliseconds{100};  // a connection that waits for less is not cut: a request may come
constexpr std::int64_t sweeps_of_grace = 3;                     // for a client to show its token: 0.1 s
constexpr auto between_tries = std::chrono::milliseconds{10};

// Returns the number of sweeps that check all connections: 1 if a deadline is short, 5 by default. So a deadline is missed by at
// most an eighth of its length, or by 50 ms.
std::size_t sweeps_for_all(Settings const& settings) {
    auto const shortest =
        std::min({settings.request_timeout, settings.idle_timeout, settings.write_timeout, settings.ping_interval});
    return static_cast<std::size_t>(std::clamp<std::int64_t>(shortest / 8 / between_sweeps, 1, 5));
}

}  // namespace

Loop::Loop(Shared& shared)
    : shared_{shared}, reader_{shared.schemas}, wakes_{[this] { asio::post(io_, [this] { wakes_.serve(); }); }, shared.troubles} {
    run_forever(Troubles::Where::sweep, [this] { return sweep(); });
}

void Loop::run_forever(Troubles::Where where, std::function<Task<>()> make) { background_.push_back({where, std::move(make)}); }

// Runs the task. When it ends or fails, stops the loop: `run()` then starts a failed task again.
Task<> Loop::run(Background& task) {
    struct End {
        Loop& loop;
        Background& task;
        bool returned = false;
        ~End() {
            task.is_started = returned;
            loop.io_.stop();
        }
    } end{*this, task};
    try {
        co_await task.make();
        end.returned = true;
    } catch (...) {
        shared_.troubles.report(task.where);
    }
}

void Loop::start_background() {
    for (auto& task : background_) {
        if (task.is_started) continue;
        asio::co_spawn(io_, run(task), asio::detached);
        task.is_started = true;
    }
    wakes_.retry_turn();
    turns_.go_on();
}

void Loop::run() {
    while (!over_) {
        try {
            start_background();
        } catch (...) {
            shared_.troubles.report(Troubles::Where::loop);
            std::this_thread::sleep_for(between_tries);
            continue;
        }
        try {
            io_.run();
        } catch (...) {
            shared_.troubles.report(Troubles::Where::loop);
        }
        if (io_.stopped()) io_.restart();
    }
}

void Loop::serve(Socket socket, Admission::Place place, From from) {
    auto const connection = std::make_shared<Connection>(*this, std::move(socket), std::move(place), from);
    asio::co_spawn(io_, connection->run(), [this, connection](std::exception_ptr const& broken) {
        if (broken) shared_.troubles.report(Troubles::Where::connection, broken, std::chrono::steady_clock::now());
    });
}

void Loop::shut_down(std::chrono::milliseconds within) {
    asio::post(io_, [this, within] {
        last_moment_ = std::chrono::steady_clock::now() + within;
        for (auto* connection : connections_) connection->shut_down();
    });
}

// Checks the deadlines of the connections, with one timer for all. Each sweep checks a part of them, so that a request does not
// wait for ten thousand checks.
Task<> Loop::sweep() {
    Timer timer{executor()};
    while (!over_) {
        timer.expires_after(between_sweeps);
        co_await timer.async_wait(asio::use_awaitable_t<Executor>{});
        ++sweeps_;
        wakes_.retry_turn();
        sweep_some(std::chrono::steady_clock::now());
        over_ =
            draining() && connections_.empty() && shared_.telemetry.connections() == 0;  // of all loops: one waits for signals
    }
}

void Loop::sweep_some(Steady now) {
    bool const cuts = now >= last_moment_;
    bool const all = cuts || shared_.gateway.memory().exhausted();
    auto const sweeps = sweeps_for_all(shared_.settings());
    auto const some = all ? connections_.size() : (connections_.size() + sweeps - 1) / sweeps;
    for (std::size_t i = 0; i < some && !connections_.empty(); ++i) {
        if (swept_ >= connections_.size()) swept_ = 0;
        auto& connection = *connections_[swept_++];
        try {
            cuts ? connection.cut() : connection.sweep(now);
        } catch (...) {
            shared_.troubles.report(Troubles::Where::sweep);
        }
    }
}

bool Loop::cut_longest_idle() {
    auto const latest = std::chrono::steady_clock::now() - shortest_idle + shared_.settings().idle_timeout;
    auto* const idlest = idlest_(connections_, [](Connection const& each) { return each.idle_due().time_since_epoch().count(); });
    if (idlest == nullptr || idlest->idle_due() > latest) return false;
    idlest->give_way();
    return true;
}

Loop::Stranger Loop::cut_stranger(Address const* from) {
    auto const rank = [from](auto const& each) { return each.is_stranger(from) ? each.accepted() : FirstOf<Connection>::none; };
    FirstOf<Connection> of_address;
    auto* const oldest = (from != nullptr ? of_address : oldest_stranger_)(connections_, rank);
    if (oldest == nullptr) return Stranger::none;
    if (oldest->accepted() + (from != nullptr ? 0 : sweeps_of_grace) > sweeps_) return Stranger::stays;
    oldest->give_way();
    return Stranger::cut;
}

void Loop::add(Connection& connection) {
    connection.index_ = connections_.size();
    connections_.push_back(&connection);
}

// Moves the last connection to the free index.
void Loop::remove(Connection const& connection) {
    idlest_.forget(connection);
    oldest_stranger_.forget(connection);
    auto* const last = connections_.back();
    connections_[connection.index_] = last;
    last->index_ = connection.index_;
    connections_.pop_back();
}

}  // namespace rois::net
