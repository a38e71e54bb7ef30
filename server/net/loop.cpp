#include "net/loop.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <vector>

#include "net/connection.hpp"

namespace rois::net {

namespace {

constexpr auto between_sweeps = std::chrono::milliseconds{50};

}  // namespace

Loop::Loop(Shared const& shared)
    : shared_{shared}, reader_{shared.schemas, shared.settings.document, shared.settings.validation} {}

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
        for (auto* connection : std::vector(connections_.begin(), connections_.end())) connection->shut_down();
    });
}

// Holds every connection to its deadlines: one timer for all of them.
Task<> Loop::sweep() {
    Timer timer{executor()};
    while (true) {
        timer.expires_after(between_sweeps);
        co_await timer.async_wait(asio::use_awaitable_t<Executor>{});
        auto const now = std::chrono::steady_clock::now();
        for (auto* connection : std::vector(connections_.begin(), connections_.end())) {
            if (now >= last_moment_) {
                connection->cut();
            } else {
                connection->sweep(now);
            }
        }
        if (draining() && connections_.empty()) io_.stop();
    }
}

}  // namespace rois::net
