#include "psm/delivery.hpp"

#include <algorithm>
#include <utility>

namespace rois::psm {

Delivery::~Delivery() {
    {
        std::lock_guard const lock{mutex_};
        over_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

bool Delivery::post(Kind kind, std::function<void()> run) {
    bool all_kept = true;
    {
        std::lock_guard const lock{mutex_};
        if (waiting_.size() >= most_waiting) {
            auto const oldest = std::ranges::find(waiting_, Kind::droppable, &Notice::kind);
            if (oldest != waiting_.end()) {
                waiting_.erase(oldest);
                all_kept = false;
            }
        }
        waiting_.push_back({kind, std::move(run)});
        begin_thread();
    }
    news_.notify_all();
    return all_kept;
}

void Delivery::begin_signs(std::function<void()> sign, std::chrono::milliseconds every) {
    {
        std::lock_guard const lock{mutex_};
        if (sign_) return;
        sign_ = std::move(sign);
        every_ = every;
        begin_thread();
    }
    news_.notify_all();
}

void Delivery::begin_thread() {
    if (thread_.joinable()) return;
    thread_ = std::thread{[this] { this->run(); }};
    here_ = thread_.get_id();
}

void Delivery::wait_for_notice(std::unique_lock<std::mutex>& lock) {
    auto const ready = [&] { return over_ || !waiting_.empty(); };
    for (;;) {
        if (!sign_) {
            news_.wait(lock, [&] { return ready() || sign_; });
            if (ready()) return;
        }
        lock.unlock();
        sign_();
        lock.lock();
        if (news_.wait_for(lock, every_, ready)) return;
    }
}

void Delivery::run() {
    std::unique_lock lock{mutex_};
    for (;;) {
        wait_for_notice(lock);
        if (over_) return;
        auto const notice = std::move(waiting_.front());
        waiting_.pop_front();
        busy_ = true;
        lock.unlock();
        notice.run();
        lock.lock();
        busy_ = false;
        news_.notify_all();
    }
}

void Delivery::call(Receiver receiver, std::function<void()> const& function) {
    std::unique_lock lock{mutex_};
    if (std::ranges::count(receivers_, receiver) == 0) return;
    called_ = receiver;
    lock.unlock();
    function();
    lock.lock();
    called_ = nullptr;
    news_.notify_all();
}

void Delivery::begin(Receiver receiver) {
    std::lock_guard const lock{mutex_};
    receivers_.push_back(receiver);
}

void Delivery::end(Receiver receiver) {
    std::unique_lock lock{mutex_};
    std::erase(receivers_, receiver);
    if (!is_here()) news_.wait(lock, [&] { return called_ != receiver; });
}

void Delivery::drain() {
    std::unique_lock lock{mutex_};
    if (!is_here()) news_.wait(lock, [&] { return waiting_.empty() && !busy_; });
}

}  // namespace rois::psm
