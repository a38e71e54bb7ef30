#include "main/reloading.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <span>
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
    news_.notify_all();
}

bool Reloading::finish(std::chrono::milliseconds longest) {
    thread_.request_stop();
    std::unique_lock lock{mutex_};
    return news_.wait_for(lock, longest, [this] { return !is_reading_; });
}

void Reloading::run(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    while (news_.wait(lock, stop, [this] { return is_asked_; })) {
        is_asked_ = false;
        is_reading_ = true;
        lock.unlock();
        try {
            auto const problems = reload();
            telemetry_.reloaded(problems.empty());
            for (auto const& problem : problems) spdlog::warn("SIGHUP: {}", problem);
            if (problems.empty()) spdlog::info("SIGHUP: {} read again", listed(parts_, &Part::name));
        } catch (std::bad_alloc const&) {
            telemetry_.reloaded(false);
            spdlog::warn("SIGHUP: there is no memory to read the files");
        }
        lock.lock();
        is_reading_ = false;
        news_.notify_all();
    }
}

// Returns every part that is not valid, not only the first one. Then nothing is changed. Without memory, the last parts may be
// left unchanged.
std::vector<std::string> Reloading::reload() const {
    std::vector<std::string> problems;
    auto const attempt = [&](std::string const& outcome, Part const& part, auto const& what) {
        try {
            what();
        } catch (std::exception const& problem) {
            problems.push_back(outcome + ": " + part.name + ": " + problem.what());
        }
    };
    std::vector<std::function<void()>> changes;
    for (auto const& part : parts_) attempt("nothing is changed", part, [&] { changes.push_back(part.prepare()); });
    for (std::size_t i = 0; i < changes.size() && problems.empty(); ++i) {
        auto const changed = listed(std::span{parts_}.first(i), &Part::name);
        attempt(i == 0 ? "nothing is changed" : "only " + changed + " changed", parts_[i], changes[i]);
    }
    return problems;
}

}  // namespace rois
