// Resumes a coroutine when its session has notifications, or when its own thread calls `raise`.
#pragma once

#include <utility>

#include "gateway/readers.hpp"
#include "gateway/wakes.hpp"
#include "types/instant.hpp"
#include "wire/asio.hpp"

namespace rois::net {

// Always held by a shared_ptr. One coroutine may wait at a time. If none waits, the next one returns at once.
class WakeUp : public Reader {
public:
    WakeUp(Executor const& executor, Wakes& wakes) : Reader{wakes}, timer_{executor} {}

    // Call these functions on the loop's thread.
    void raise() {
        raised_ = true;
        timer_.cancel();
    }

    enum class Woken : std::uint8_t { raised, time_passed };
    Task<Woken> wait_until(Steady until) {
        boost::system::error_code error;
        timer_.expires_at(until);
        if (!raised_) co_await timer_.async_wait(into(error));
        co_return std::exchange(raised_, false) ? Woken::raised : Woken::time_passed;
    }

private:
    void woken() override { raise(); }

    Timer timer_;
    bool raised_ = false;
};

}  // namespace rois::net
