// SIGINT and SIGTERM, as something that is waited for beside other things.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace rois::command {

// Made before any other thread. The first signal is reported to the callback. Another one within half a second counts as the
// same, so that the session can still be ended properly; a later one ends the program at once.
class Signals {
public:
    Signals();
    ~Signals();
    Signals(Signals const&) = delete;
    Signals& operator=(Signals const&) = delete;

    // Called on a thread of its own at the first signal, or now when it has come. Nobody: then a signal ends the program at once.
    // Whoever was told until now is told no more, nor is still being told, when this returns.
    void on_first(std::function<void()>);

    bool raised() const;

private:
    void wait();

    std::mutex telling_;  // taken before the other
    mutable std::mutex mutex_;
    std::function<void()> told_;
    std::optional<std::chrono::steady_clock::time_point> raised_;
    bool over_ = false;
    std::thread thread_;
};

}  // namespace rois::command
