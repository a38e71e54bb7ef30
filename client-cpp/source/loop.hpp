// The client's thread: what runs there, and when.
#pragma once

#include "asio.hpp"
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

// A time that a clock can count twice from now on: a century is for ever here, and what is negative is over at once.
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

    // From any thread; it runs on the client's. When that has ended, the function is dropped: false.
    template <class Function>
    bool post(Function function) {
        std::lock_guard const lock{over_mutex_};
        if (!over_) asio::post(io_, std::move(function));
        return !over_;
    }

    // What follows runs on the client's thread, at once when it is there. When that has ended, it runs where it is: several may
    // then, so nothing is changed but what is theirs alone.
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

    // Alarms, on the client's thread. A ticket is good once; one that has rung or is 0 may be cancelled all the same. After
    // `finish` none rings.
    using Ticket = std::uint64_t;
    Ticket at(Steady, std::function<void()>);
    Ticket in(std::chrono::milliseconds time, std::function<void()> ring) { return at(from_now(time), std::move(ring)); }
    void cancel(Ticket);

    // Runs until `finish` was called and nothing is left. Keeps `owner` as long.
    void start(std::shared_ptr<void> owner);
    // On the client's thread: all alarms are forgotten, and the thread ends when nothing is left to do.
    void finish();
    // Waits for its end. Lets it end alone on the client's thread itself, and when a name is still looked up, which may take long
    // and cannot be ended.
    void join();

private:
    void arm();
    void end();

    asio::io_context io_{1};
    asio::executor_work_guard<Executor> work_;
    Timer timer_;
    Steady armed_ = Steady::max();  // when the timer expires; alarms that were cancelled do not change it
    std::map<std::pair<Steady, Ticket>, std::function<void()>> alarms_;
    std::map<Ticket, Steady> times_;
    Ticket last_ticket_ = 0;
    bool finishing_ = false;
    std::mutex over_mutex_;  // guards over_, also while something is posted
    bool over_ = false;      // the thread runs nothing more that is posted from now on
    std::thread thread_;
    std::atomic<std::thread::id> own_id_;
    enum class Left : std::uint8_t { nothing, something };
    std::promise<Left> finished_;  // whether something is still under way
};

}  // namespace rois::client
