// Two engines on the thread of the links, where each allocation in turn fails: the thread goes on, and every command ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>

#include "faults/faults.hpp"
#include "remote/two_engines.hpp"

namespace rois {

namespace {

// The n-th allocation on the thread of the links fails.
struct Failing {
    Failing(TwoEngines& engines, std::uint64_t n) : left{n} {
        engines.on_links = [&engines, this](std::function<void()> const& what) {
            if (left == 0) return what();
            faults::fail_at(faults::Of::memory, left);
            bool has_thrown = false;
            try {
                what();
            } catch (std::bad_alloc const&) {
                has_thrown = true;
            }
            auto const calls = faults::calls(faults::Of::memory);
            has_failed = faults::stop();
            left = has_failed ? 0 : left - calls;
            if (has_thrown) engines.remote().recover();
        };
    }
    std::uint64_t left;
    bool has_failed = false;
};

// The engine throws its own failures, which the gateway's clock catches.
void pass(TwoEngines& engines, std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time; passed += 50ms) {
        try {
            engines.advance(50ms);
        } catch (std::bad_alloc const&) {
        }
    }
}

std::size_t ends_of(std::vector<std::string> const& received, std::string const& command) {
    return static_cast<std::size_t>(
        std::ranges::count_if(received, [&](std::string const& each) { return each.find("completed " + command) != each.npos; }));
}

}  // namespace

TEST(SubEngineWithoutMemory, EndsEveryCommandAndComesBack) {
    std::uint64_t n = 0;
    for (bool has_failed = true; has_failed;) {
        TwoEngines engines{{navigation, speech}};
        auto desk = engines.main.connect();
        n += (n < 300 ? 1 : 7) * faults::step;
        Failing const failing{engines, n};
        engines.bind(desk, "hall.navigation");
        auto const accepted = engines.execute(desk, go("go", "hall.navigation")).return_code == ReturnCode::ok;
        engines.execute(desk, named("hold", suspend("hall.navigation")), named("on", resume("hall.navigation")));
        engines.ask(desk, Query{"route", {}});
        if (engines.hall["navigation"].latest() != CommandHandle{}) engines.hall["navigation"].finishes();
        engines.settle();
        for (auto const time : {500ms, 4000ms, 31000ms}) {  // the session goes on; it is given up; its components leave
            engines.cut();
            pass(engines, time);
            engines.repair();
            pass(engines, 31s);
        }
        has_failed = failing.left == 0;
        pass(engines, 31s);  // the longest time until the next attempt
        EXPECT_EQ(ends_of(desk.received(), "go"), accepted ? 1u : 0u) << "allocation " << n;
        EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok) << "allocation " << n;
        EXPECT_EQ(engines.execute(desk, go("again", "hall.navigation")).return_code, ReturnCode::ok) << "allocation " << n;
        EXPECT_EQ(engines.hall["navigation"].calls.back(), "start") << "allocation " << n;
    }
    EXPECT_GT(n, 100u);
}

}  // namespace rois
