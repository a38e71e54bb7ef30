#include "main/reloading.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "types/text/listing.hpp"

namespace rois {

Reloading::Reloading(std::vector<Part> parts, Telemetry& telemetry) : parts_{std::move(parts)}, telemetry_{telemetry} {
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
}

void Reloading::ask() {
    {
        std::lock_guard const lock{mutex_};
        is_asked_ = true;
    }
    asked_.notify_one();
}

void Reloading::run(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    while (asked_.wait(lock, stop, [this] { return is_asked_; })) {
        is_asked_ = false;
        lock.unlock();
        telemetry_.reloaded(reload());
        lock.lock();
    }
}

// Reports every part that is not valid, not only the first one.
bool Reloading::reload() const {
    std::vector<std::function<void()>> changes;
    auto const attempt = [](Part const& part, auto const& what) {
        try {
            what();
            return true;
        } catch (std::exception const& problem) {
            spdlog::warn("SIGHUP: nothing is changed: {}: {}", part.name, problem.what());
            return false;
        }
    };
    bool are_valid = true;
    for (auto const& part : parts_) are_valid = attempt(part, [&] { changes.push_back(part.prepare()); }) && are_valid;
    if (!are_valid) return false;
    for (std::size_t i = 0; i < changes.size(); ++i)
        if (!attempt(parts_[i], changes[i])) return false;
    spdlog::info("SIGHUP: {} read again", listed(parts_, &Part::name));
    return true;
}

}  // namespace rois
