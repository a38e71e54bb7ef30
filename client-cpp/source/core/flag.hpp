// A signal that several coroutines can await on the client's thread.
#pragma once

#include <coroutine>
#include <utility>
#include <vector>

namespace rois::client {

// Used on the client's thread only. Each `raise` resumes the coroutines that wait at that time.
class Flag {
public:
    struct Awaiter {
        Flag* flag;
        bool await_ready() const { return false; }
        void await_suspend(std::coroutine_handle<> waiter) const { flag->waiters_.push_back(waiter); }
        void await_resume() const {}
    };

    Awaiter raised() { return {this}; }

    void raise() {
        auto const waiters = std::exchange(waiters_, {});
        for (auto const waiter : waiters) waiter.resume();
    }

private:
    std::vector<std::coroutine_handle<>> waiters_;
};

}  // namespace rois::client
