// A thread-safe queue.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace rois::command {

template <class T>
class Inbox {
public:
    void put(T one) {
        std::lock_guard const lock{mutex_};
        waiting_.push_back(std::move(one));
        changed_.notify_all();
    }

    // Ends the queue: nothing is put into it after this.
    void close() {
        std::lock_guard const lock{mutex_};
        closed_ = true;
        changed_.notify_all();
    }

    // Returns whether the queue is closed and empty.
    bool is_over() {
        std::lock_guard const lock{mutex_};
        return closed_ && waiting_.empty();
    }

    // Waits for the next item. Returns nothing at the time `until`, and if the queue is closed and empty.
    template <class Until>
    std::optional<T> take(std::optional<Until> until) {
        std::unique_lock lock{mutex_};
        auto const ready = [&] { return closed_ || !waiting_.empty(); };
        if (!until) {
            changed_.wait(lock, ready);
        } else {
            changed_.wait_until(lock, *until, ready);
        }
        if (waiting_.empty()) return std::nullopt;
        std::optional<T> first{std::move(waiting_.front())};
        waiting_.pop_front();
        return first;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<T> waiting_;
    bool closed_ = false;
};

}  // namespace rois::command
