// The thread of the links, in a gateway that may run out of memory.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <new>

#include "core/loop.hpp"

namespace rois {

using namespace std::chrono_literals;

TEST(Loop, GoesOnAfterAnExceptionInAnAlarm) {
    auto const loop = std::make_shared<client::Loop>();
    std::promise<void> recovered, rang;
    loop->start(loop, [&] { recovered.set_value(); });
    loop->post([&] {
        loop->in(0ms, [] { throw std::bad_alloc{}; });
        loop->in(1ms, [&] { rang.set_value(); });
    });
    recovered.get_future().wait();
    rang.get_future().wait();
    loop->post([&] { loop->finish(); });
    loop->join();
}

}  // namespace rois
