// The notification thread of the C++ PSM. It calls the functions of the application's receivers, one at a time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rois::psm {

// Identifies a receiver: the address of its ServiceApplicationBase or Event.
using Receiver = void const*;

// Thread-safe. The thread starts with the first notice or `begin_signs`.
class Delivery {
public:
    enum class Kind : unsigned char {
        droppable,  // an event: the oldest one is dropped if the queue is full
        kept,
    };

    static constexpr std::size_t most_waiting = 1'024;

    Delivery() = default;
    // Ends the thread; discards queued notices.
    ~Delivery();
    Delivery(Delivery const&) = delete;
    Delivery& operator=(Delivery const&) = delete;

    // Lets the notification thread call `sign` at this interval and between two notices, but not while a receiver's function
    // runs. Only the first call has an effect.
    void begin_signs(std::function<void()> sign, std::chrono::milliseconds every);

    // Queues a function for the notification thread. Returns false if an event had to be dropped to make room.
    bool post(Kind, std::function<void()>);

    // On the notification thread: calls the function, unless `end` was called for the receiver.
    void call(Receiver, std::function<void()> const&);
    void begin(Receiver);
    // Ends the receiver: none of its functions runs after this. Waits for a running function, unless that function calls this.
    void end(Receiver);

    // Waits until the queue is empty and no function runs. Returns at once on the notification thread.
    void drain();
    bool is_here() const { return std::this_thread::get_id() == here_; }

private:
    struct Notice {
        Kind kind;
        std::function<void()> run;
    };

    void run();
    void begin_thread();
    void wait_for_notice(std::unique_lock<std::mutex>&);

    std::mutex mutex_;
    std::condition_variable news_;
    std::function<void()> sign_;
    std::chrono::milliseconds every_{};
    std::deque<Notice> waiting_;
    std::vector<Receiver> receivers_;
    Receiver called_ = nullptr;  // the receiver whose function runs
    bool busy_ = false;          // a notice is being handled
    bool over_ = false;
    std::thread thread_;
    std::thread::id here_;
};

}  // namespace rois::psm
