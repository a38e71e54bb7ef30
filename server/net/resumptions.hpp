// Coroutines of one loop that are to continue, each in a turn of its own.
#pragma once

#include <cstddef>
#include <vector>

#include "net/asio.hpp"
#include "net/troubles.hpp"

namespace rois::net {

// Resumes a coroutine from the loop, not inline: the caller may still use state that the coroutine would change. `add` needs no
// memory. With `asio::post`, a coroutine would be lost, and the process would end, if memory were missing.
// Belongs to the thread of the loop.
class Resumptions {
public:
    using Token = asio::use_awaitable_t<Executor>;
    using Handler = asio::async_result<Token, void()>::handler_type;  // resumes one coroutine

    Resumptions(Executor executor, Troubles& troubles) : executor_{std::move(executor)}, troubles_{troubles} {}
    Resumptions(Resumptions const&) = delete;
    Resumptions& operator=(Resumptions const&) = delete;

    // Reserves room for the coroutines that wait for one connection, and gives it back. `enter` throws std::bad_alloc.
    void enter();
    void leave() noexcept { --connections_; }

    void add(Handler) noexcept;

    // Retries to wake the loop, if there was no memory to do so. The loop calls this in each sweep.
    void look_after() noexcept;

    Executor const& executor() const { return executor_; }

private:
    void post() noexcept;
    void serve() noexcept;

    Executor executor_;
    Troubles& troubles_;
    std::size_t connections_ = 0;
    std::vector<Handler> waiting_;
    std::vector<Handler> serving_;
    bool posted_ = false;  // `serve` will be called
};

}  // namespace rois::net
