// Handles SIGINT and SIGTERM on a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace rois::command {

// Construct it before any other thread starts. The first signal calls the callback. Another one within half a second counts as
// the same, so that the session can still end properly; a later one ends the program at once.
class Signals {
public:
    Signals();
    ~Signals();
    Signals(Signals const&) = delete;
    Signals& operator=(Signals const&) = delete;

    // Sets the function to call at the first signal; calls it at once if that signal has arrived. Without a function, a signal
    // ends the program. After the return, the previous function neither runs nor is called.
    void on_first(std::function<void()>);

    bool raised() const;

private:
    void wait();

    std::mutex calling_;  // locked during the callback; locked before mutex_
    mutable std::mutex mutex_;
    std::function<void()> callback_;
    std::optional<std::chrono::steady_clock::time_point> raised_;
    bool over_ = false;
    std::thread thread_;
};

}  // namespace rois::command
