// Tools for the tests of the client library: quick settings, a history of observations, and pending operations.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client_cpp/proxy.hpp"
#include "kit/gateway_process.hpp"
#include "rois/blocking.hpp"
#include "rois/client.hpp"

namespace rois::test {

using namespace std::chrono_literals;
using namespace rois::conditions;
using kit::GatewayProcess;
using kit::shared_gateway;

// Settings with short pauses.
inline Settings quick(std::string url, Way way = Way::websocket) {
    Settings settings;
    settings.url = std::move(url);
    settings.way = way;
    settings.first_pause = 5ms;
    settings.longest_pause = 50ms;
    return settings;
}

// Records the calls of observers. Must outlive the connection.
class History {
public:
    Observers observers() {
        Observers all;
        all.state = [this](StateChange const& change) { note([&] { states_.emplace_back(to_text(change.state)); }); };
        all.gap = [this](Gap const& gap) { note([&] { gaps_.push_back(gap); }); };
        all.notification = [this](Notification const& notification, std::uint64_t sequence) {
            note([&] { notifications_.emplace_back(sequence, notification); });
        };
        return all;
    }

    // Waits until `reached` returns true; fails the test after `within`.
    void await(std::function<bool()> const& reached, std::chrono::seconds within = 20s) {
        std::unique_lock lock{mutex_};
        EXPECT_TRUE(news_.wait_for(lock, within, reached)) << "not reached; states: " << testing::PrintToString(states_);
    }
    void await_state(std::string const& state) {
        await([&] { return !states_.empty() && states_.back() == state; });
    }
    void await_once(std::string const& state) {  // returns at once if it was reached before
        await([&] { return std::ranges::count(states_, state) > 0; });
    }
    void await_gap() {
        await([&] { return !gaps_.empty(); });
    }
    void await_notifications(std::size_t count) {
        await([&] { return notifications_.size() >= count; });
    }
    void await_states(std::vector<std::string> const& states) {
        await([&] { return states_ == states; });
    }

    std::vector<std::string> states() const { return locked(states_); }
    std::vector<Gap> gaps() const { return locked(gaps_); }
    std::vector<std::pair<std::uint64_t, Notification>> notifications() const { return locked(notifications_); }

    // Returns how many `completed` notifications each command had.
    std::map<std::string, int> completions() const {
        std::map<std::string, int> count;
        for (auto const& [sequence, notification] : notifications())
            if (auto const* const completed = std::get_if<Completed>(&notification)) ++count[completed->command_id.text];
        return count;
    }

private:
    template <class Function>
    void note(Function function) {
        std::lock_guard const lock{mutex_};
        function();
        news_.notify_all();
    }
    template <class T>
    T locked(T const& value) const {
        std::lock_guard const lock{mutex_};
        return value;
    }

    mutable std::mutex mutex_;
    std::condition_variable news_;
    std::vector<std::string> states_;
    std::vector<Gap> gaps_;
    std::vector<std::pair<std::uint64_t, Notification>> notifications_;
};

// Starts an operation. Returns its outcome as a future.
template <class T>
std::future<T> begun(Client& client, Task<T> task) {
    auto const promise = std::make_shared<std::promise<T>>();
    client.spawn([](Task<T> operation, std::shared_ptr<std::promise<T>> outcome) -> Task<> {
        auto delivered = detail::deliver(std::move(operation), *outcome);
        co_await std::move(delivered);
    }(std::move(task), promise));
    return promise->get_future();
}

// For tests over WebSocket and HTTP.
class BothWays : public testing::TestWithParam<Way> {
public:
    Settings settings(std::string url = shared_gateway().url()) const { return quick(std::move(url), GetParam()); }
};

inline std::string name_of(testing::TestParamInfo<Way> const& info) { return info.param == Way::http ? "Http" : "WebSocket"; }

#define ROIS_BOTH_WAYS(Suite) INSTANTIATE_TEST_SUITE_P(Over, Suite, testing::Values(Way::websocket, Way::http), name_of)

}  // namespace rois::test
