// The notification thread of the C++ PSM: calls the functions of the application's receivers, one after the other.
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

// What a receiver is registered by: the address of its ServiceApplicationBase or Event.
using Receiver = void const*;

// Thread-safe. The thread begins with the first notice or `begin_signs`.
class Delivery {
public:
    enum class Kind : unsigned char {
        droppable,  // an event: the oldest of these makes room when too many wait
        kept,
    };

    static constexpr std::size_t most_waiting = 1'024;

    Delivery() = default;
    // Ends the thread; what waits is not delivered.
    ~Delivery();
    Delivery(Delivery const&) = delete;
    Delivery& operator=(Delivery const&) = delete;

    // From now on the notification thread calls this again and again after the time, and between two notices; not while a
    // receiver's function runs. Once.
    void begin_signs(std::function<void()> sign, std::chrono::milliseconds every);

    // Queues a function for the notification thread. Returns false if an event had to be dropped to make room.
    bool post(Kind, std::function<void()>);

    // On the notification thread: calls the function unless the receiver has been ended.
    void call(Receiver, std::function<void()> const&);
    void begin(Receiver);
    // No function of the receiver runs after this. Waits for one that runs, unless it is called by that one.
    void end(Receiver);

    // Waits until nothing waits and nothing runs. Does not wait on the notification thread.
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
    Receiver called_ = nullptr;  // whose function runs
    bool busy_ = false;          // a notice is being handled
    bool over_ = false;
    std::thread thread_;
    std::thread::id here_;
};

}  // namespace rois::psm
