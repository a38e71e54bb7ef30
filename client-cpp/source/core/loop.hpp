// The event loop of the client's thread.
#pragma once

#include "links/asio.hpp"
// Asio first.
#include <algorithm>
#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <coroutine>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace rois::client {

using Steady = std::chrono::steady_clock::time_point;

// Limits a time to 0 to 100 years, so that it can be doubled and added to a clock.
inline std::chrono::milliseconds bounded(std::chrono::milliseconds time) {
    constexpr auto longest = std::chrono::milliseconds{std::chrono::years{100}};
    return std::clamp(time, std::chrono::milliseconds{0}, longest);
}
inline Steady from_now(std::chrono::milliseconds time) { return std::chrono::steady_clock::now() + bounded(time); }

class Loop {
public:
    Loop();
    Loop(Loop const&) = delete;
    Loop& operator=(Loop const&) = delete;

    asio::io_context& io() { return io_; }
    Executor executor() { return io_.get_executor(); }
    bool is_here() const { return std::this_thread::get_id() == own_id_; }

    // From any thread: runs the function on the client's thread. Drops it and returns false if that thread has ended.
    template <class Function>
    bool post(Function function) {
        std::lock_guard const lock{over_mutex_};
        if (!over_) asio::post(io_, std::move(function));
        return !over_;
    }

    // The awaiting coroutine continues on the client's thread. If that thread has ended, the coroutine continues on its own
    // thread. Then several coroutines may run at once and must not change shared data.
    auto here() {
        struct Awaiter {
            Loop* loop;
            bool await_ready() const { return loop->is_here(); }
            bool await_suspend(std::coroutine_handle<> waiter) const {
                return loop->post([waiter] { waiter.resume(); });
            }
            void await_resume() const {}
        };
        return Awaiter{this};
    }

    // Alarms, on the client's thread. An alarm calls `ring` once, but not after `finish`. `cancel` ignores a ticket whose alarm
    // has rung, and ticket 0.
    using Ticket = std::uint64_t;
    Ticket at(Steady, std::function<void()>);
    Ticket in(std::chrono::milliseconds time, std::function<void()> ring) { return at(from_now(time), std::move(ring)); }
    void cancel(Ticket);

    // Starts the thread. The thread keeps `owner` alive. It runs until `finish` was called and no handler is left. If an
    // exception leaves a handler, `recover` is called soon afterwards; without a `recover`, the exception ends the program.
    void start(std::shared_ptr<void> owner, std::function<void()> recover = {});
    // On the client's thread: cancels all alarms, and lets the thread end.
    void finish();
    // Waits until the thread has ended. Detaches it instead on the client's thread, and while a host name is looked up, which may
    // take long and cannot be cancelled.
    void join();

private:
    void arm();
    void run(std::function<void()> const& recover);
    void end();

    asio::io_context io_{1};
    asio::executor_work_guard<Executor> work_;
    Timer timer_;
    Steady armed_ = Steady::max();  // when the timer expires; cancelled alarms do not change it
    std::map<std::pair<Steady, Ticket>, std::function<void()>> alarms_;
    std::map<Ticket, Steady> times_;
    Ticket last_ticket_ = 0;
    bool finishing_ = false;
    std::mutex over_mutex_;  // guards over_, also during `post`
    bool over_ = false;      // `post` drops functions from now on
    std::thread thread_;
    std::atomic<std::thread::id> own_id_;
    enum class Left : std::uint8_t { nothing, something };
    std::promise<Left> finished_;  // whether handlers are left
};

}  // namespace rois::client
