// What a coroutine waits on until a session's notifications, or something of its own thread, call for it.
#pragma once

#include <atomic>
#include <memory>

#include "net/asio.hpp"
#include "net/readers.hpp"
#include "types/instant.hpp"

namespace rois::net {

// Always held by a shared_ptr. One coroutine waits at a time; a call that comes while none waits is kept for the next.
class Signal : public Reader, public std::enable_shared_from_this<Signal> {
public:
    explicit Signal(Executor const& executor) : timer_{executor} {}

    void wake() override;  // from any thread
    void taken_over() override {}

    // The rest belongs to the thread of the executor.
    void raise();

    enum class Woken : std::uint8_t { raised, time_passed };
    Task<Woken> wait_until(Steady);

private:
    Timer timer_;
    std::atomic<bool> posted_ = false;
    bool raised_ = false;
};

}  // namespace rois::net
