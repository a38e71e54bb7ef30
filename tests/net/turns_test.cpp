// Strangers take turns, so that those of one address do not keep others waiting.
#include "wire/turns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <string>
#include <vector>

namespace rois::net {
namespace {

using testing::ElementsAre;

struct ATurn : testing::Test {
    Task<> work(std::string address, std::string name) {
        Timer timer{io.get_executor()};
        co_await turns.take(asio::ip::make_address(address), timer);
        done.push_back(name);
        asio::post(io, [this] { done.emplace_back("other"); });
    }
    void begin(std::string const& address, std::string const& name) { asio::co_spawn(io, work(address, name), asio::detached); }

    asio::io_context io;
    Turns turns{io.get_executor()};
    std::vector<std::string> done;
};

TEST_F(ATurn, IsTakenByOneAddressAfterTheOtherWithOtherWorkBetween) {
    for (auto const* name : {"a1", "a2", "a3"}) begin("192.0.2.1", name);
    for (auto const* name : {"b1", "b2"}) begin("192.0.2.2", name);
    io.run();
    EXPECT_THAT(done, ElementsAre("a1", "other", "b1", "other", "a2", "other", "b2", "other", "a3", "other"));
}

}  // namespace
}  // namespace rois::net
