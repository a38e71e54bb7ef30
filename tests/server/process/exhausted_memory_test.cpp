// Without memory from the system, stop, release and disconnect still work, and the process does not end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "kit/vocabulary.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;

// A gateway with little free address space (1 MiB by default), whose robot drives for an application.
class ExhaustedMemory : public testing::Test {
protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "a sanitizer takes address space of its own";
#endif
        gateway = std::make_unique<GatewayProcess>();
        desk = std::make_unique<HttpClient>(*gateway);
        desk->call("connect");
        EXPECT_EQ(desk->call("bind", component_ref("navigation")).return_code(), "OK");
        drive();
        gateway->limit_address_space(mib_left() << 20U);
    }

    virtual std::size_t mib_left() const { return 1; }

    void drive() {
        auto const go =
            kit::sequence(kit::unit({.component = "navigation", .arguments = {kit::target_position({"8000, 6000, 30"})}}));
        EXPECT_EQ(post("/rois/clear").status, 200);
        auto const going = anew("execute", go);
        EXPECT_EQ(going.return_code(), "OK") << going.status << ' ' << going.body;
    }

    // Calls `ask` with a new connection. Without memory, one that has been idle for 0.1 s is cut, which may cross a request: then
    // the client sends it again, as browsers do.
    template <class Ask>
    HttpReply on_new_connection(Ask ask) {
        constexpr int most = 10;
        for (int tries = 1; tries < most; ++tries) {
            try {
                return ask(HttpClient{*gateway});
            } catch (LineEnded const&) {
            }
        }
        return ask(HttpClient{*gateway});
    }

    HttpReply post(std::string const& path) {
        return on_new_connection([&](HttpClient client) {
            return client.say("POST " + path + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n");
        });
    }

    // Sends a request in the desk's session. Also takes the notifications: a session ends when too many wait while memory is
    // missing.
    HttpReply anew(std::string const& operation, Xml const& children = {}) {
        return on_new_connection([&](HttpClient client) {
            client.get("/rois/notifications?after=0&wait=0", {{"RoIS-Session", desk->session}});
            return client.post(request(operation, children),
                               {{"RoIS-Session", desk->session}, {"Content-Type", "application/xml"}});
        });
    }

    // Sends `text` on `count` connections, and replaces the oldest of them again and again.
    void flood(std::size_t count, std::string const& text) {
        std::vector<std::unique_ptr<Line>> lines(count);
        for (std::size_t i = 0; floods; ++i) {
            auto& line = lines[i % count];
            try {
                line = std::make_unique<Line>(gateway->address());
                line->send_now(text);
            } catch (LineEnded const&) {
                line.reset();
            }
            if (i > count) std::this_thread::sleep_for(1ms);
        }
    }

    // Each of these requests is answered, whatever other clients do.
    void expect_to_obey() {
        for (auto const end = std::chrono::steady_clock::now() + 2s; std::chrono::steady_clock::now() < end;) {
            EXPECT_NO_THROW({
                drive();
                EXPECT_EQ(anew("execute", kit::sequence(kit::unit({.component = "navigation", .type = "stop"}))).return_code(),
                          "OK");
                EXPECT_EQ(anew("release", component_ref("navigation")).return_code(), "OK");
                EXPECT_EQ(anew("bind", component_ref("navigation")).return_code(), "OK");
                drive();
                EXPECT_THAT(post("/rois/stop").status, testing::AnyOf(200, 202)) << "202: the robot still brakes";
                EXPECT_EQ(on_new_connection([](HttpClient client) { return client.get("/healthz"); }).status, 200);
            });
            if (HasFailure()) return;
            ++rounds;
        }
        EXPECT_NO_THROW(EXPECT_EQ(anew("disconnect").return_code(), "OK"));
    }

    void expect_to_obey_during(std::size_t connections, std::string const& text) {
        std::thread attacker{[&] { flood(connections, text); }};
        std::this_thread::sleep_for(200ms);
        expect_to_obey();
        floods = false;
        attacker.join();
        EXPECT_GT(rounds, 3);
        EXPECT_TRUE(opens_a_session());
    }

    // Waits up to five seconds.
    bool opens_a_session() {
        for (auto const until = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < until;)
            if (HttpClient{*gateway}.call("connect").status == 200) return true;
        return false;
    }

    std::unique_ptr<GatewayProcess> gateway;
    std::unique_ptr<HttpClient> desk;
    std::atomic<bool> floods = true;
    int rounds = 0;
};

// A flood that uses the remaining memory within milliseconds.
class SuddenlyExhaustedMemory : public ExhaustedMemory, public testing::WithParamInterface<std::size_t> {
    std::size_t mib_left() const override { return GetParam(); }
};

}  // namespace

TEST_P(SuddenlyExhaustedMemory, DoesNotEndTheProcess) {
    auto const body =
        "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nContent-Length: 1000000\r\n\r\n" +
        std::string(900'000, ' ');
    std::vector<std::thread> attackers;
    for (int i = 0; i < 3; ++i) attackers.emplace_back([&] { flood(50, body); });
    for (auto const end = std::chrono::steady_clock::now() + 1s; std::chrono::steady_clock::now() < end;) {
        try {
            HttpClient{*gateway}.say("POST /rois/stop HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n");
        } catch (LineEnded const&) {
        }
    }
    floods = false;
    for (auto& attacker : attackers) attacker.join();
    EXPECT_TRUE(opens_a_session());
}
INSTANTIATE_TEST_SUITE_P(WithMiBLeft, SuddenlyExhaustedMemory, testing::Values(2, 8, 16, 20, 24, 40));

TEST_F(ExhaustedMemory, OfUnfinishedBodiesLeavesStopAndRelease) {
    expect_to_obey_during(
        400, "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nContent-Length: 60000\r\n\r\n" +
                 std::string(59'000, ' '));
}

TEST_F(ExhaustedMemory, OfUnfinishedHeadsLeavesStopAndRelease) {
    std::string head = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
    for (int i = 0; i < 3; ++i) head += "X-" + std::to_string(i) + ": " + std::string(3'900, 'y') + "\r\n";
    expect_to_obey_during(800, head);
}

}  // namespace rois::test
