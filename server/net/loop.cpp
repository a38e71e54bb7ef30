#include "net/loop.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <vector>

#include "net/connection.hpp"

namespace rois::net {

namespace {

constexpr auto between_sweeps = std::chrono::milliseconds{50};

// In how many sweeps all connections are looked at: in each, while the deadlines are short; in five, when they are as usual. So
// none is missed by more than an eighth of itself, or by 50 ms.
std::size_t sweeps_for_all(Settings const& settings) {
    auto const shortest =
        std::min({settings.request_timeout, settings.idle_timeout, settings.write_timeout, settings.ping_interval});
    return static_cast<std::size_t>(std::clamp<std::int64_t>(shortest / 8 / between_sweeps, 1, 5));
}

}  // namespace

Loop::Loop(Shared& shared)
    : shared_{shared},
      reader_{shared.schemas, shared.settings.document, shared.settings.validation},
      sweeps_for_all_{sweeps_for_all(shared.settings)} {}

Loop::~Loop() = default;

void Loop::run() {
    asio::co_spawn(io_, sweep(), asio::detached);
    io_.run();
}

void Loop::serve(Socket socket, Admission::Place place) {
    auto const connection = std::make_shared<Connection>(*this, std::move(socket), std::move(place));
    asio::co_spawn(io_, connection->run(), [connection](std::exception_ptr const& broken) {
        if (!broken) return;
        try {
            std::rethrow_exception(broken);
        } catch (std::exception const& error) {
            spdlog::error("a connection broke off: {}", error.what());
        }
    });
}

void Loop::shut_down(std::chrono::milliseconds within) {
    asio::post(io_, [this, within] {
        last_moment_ = std::chrono::steady_clock::now() + within;
        for (auto* connection : std::vector(connections_)) connection->shut_down();
    });
}

// Holds every connection to its deadlines: one timer for all of them, and a part of them at a time, so that a request does not
// wait until ten thousand have been looked at.
Task<> Loop::sweep() {
    Timer timer{executor()};
    while (true) {
        timer.expires_after(between_sweeps);
        co_await timer.async_wait(asio::use_awaitable_t<Executor>{});
        auto const now = std::chrono::steady_clock::now();
        if (now >= last_moment_) {
            for (auto* connection : std::vector(connections_)) connection->cut();
        } else {
            sweep_some(now);
        }
        if (draining() && connections_.empty()) io_.stop();
    }
}

void Loop::sweep_some(Steady now) {
    auto const some = (connections_.size() + sweeps_for_all_ - 1) / sweeps_for_all_;
    for (std::size_t i = 0; i < some && !connections_.empty(); ++i) {
        if (swept_ >= connections_.size()) swept_ = 0;
        connections_[swept_++]->sweep(now);
    }
}

void Loop::add(Connection& connection) {
    connection.seat_ = connections_.size();
    connections_.push_back(&connection);
}

// The last takes its place.
void Loop::remove(Connection const& connection) {
    auto* const last = connections_.back();
    connections_[connection.seat_] = last;
    last->seat_ = connection.seat_;
    connections_.pop_back();
}

}  // namespace rois::net
