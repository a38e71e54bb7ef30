// Reads the files again after SIGHUP, and makes all changes, or none if a file is not valid.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "gateway/process/telemetry.hpp"

namespace rois {

// Has a thread of its own, so that no client waits meanwhile.
class Reloading {
public:
    // Some of the files: "certificate". `prepare` reads and checks them, and throws if they are not valid. It returns the
    // function that makes the change. Only that of the first part may throw, if it changes nothing then; the others only for lack
    // of memory, which the log reports.
    struct Part {
        std::string name;
        std::function<std::function<void()>()> prepare;
    };

    // The parts may be used on the thread until the destructor has returned.
    Reloading(std::vector<Part> parts, Telemetry&);

    // Thread-safe; returns at once.
    void ask();

    // Reads nothing more. Returns false if a file is still being read after this time: then the destructor would wait for it.
    bool finish(std::chrono::milliseconds longest);

private:
    void run(std::stop_token const&);
    std::vector<std::string> reload() const;

    std::vector<Part> const parts_;
    Telemetry& telemetry_;
    std::mutex mutex_;  // guards the next three
    std::condition_variable_any news_;
    bool is_asked_ = false;
    bool is_reading_ = false;
    std::jthread thread_;
};

}  // namespace rois
