// What a coroutine waits on until a session's notifications, or something of its own thread, call for it.
#pragma once

#include "gateway/readers.hpp"
#include "gateway/wakes.hpp"
#include "net/asio.hpp"
#include "types/instant.hpp"

namespace rois::net {

// Always held by a shared_ptr. One coroutine waits at a time; a call that comes while none waits is kept for the next.
class Signal : public Reader {
public:
    Signal(Executor const& executor, Wakes& wakes) : Reader{wakes}, timer_{executor} {}

    // Belongs, as all that follows, to the thread of the loop.
    void raise();

    enum class Woken : std::uint8_t { raised, time_passed };
    Task<Woken> wait_until(Steady);

private:
    void woken() override { raise(); }

    Timer timer_;
    bool raised_ = false;
};

}  // namespace rois::net
