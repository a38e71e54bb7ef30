// The whole gateway in this process, under faults: it answers again, its clock goes on, and moving components halt.
#include <gmock/gmock.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <stop_token>
#include <thread>

#include "faults/driving_component.hpp"
#include "faults/faults.hpp"
#include "files/files.hpp"
#include "gateway/access/secrets.hpp"
#include "kit/vocabulary.hpp"
#include "kit/websocket_client.hpp"
#include "net/server.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

using namespace std::chrono_literals;
using faults::Of;

namespace {

net::Settings settings() {
    net::Settings settings;
    settings.port = 0;
    settings.threads = 2;
    return settings;
}

// Components of a vanished application soon become free.
EngineSettings short_windows() {
    EngineSettings settings;
    settings.session_timeout = settings.resume_window = 50ms;
    settings.motion_lease = 1s;
    return settings;
}

EngineProfile profile() {
    EngineProfile profile;
    profile.object = {
        .identifier = "urn:x-rois:def:HRIEngine:test", .code_space = {}, .name = "main", .description = {}, .meta_data = {}};
    return profile;
}

bool is_ok(pugi::xml_node answer) { return std::string_view{answer.attribute("return_code").value()} == "OK"; }

// Faults affect its own threads, but not the thread of the test.
struct Rig {
    faults::Exempt exempt;
    xml::Platform platform;
    std::shared_ptr<xml::Schemas const> schemas = std::make_shared<xml::Schemas const>(files::schemas());
    Readers readers;
    Engine engine{profile(), {common}, short_windows(), readers, fresh_secret};
    DrivingComponent* base = nullptr;
    Telemetry telemetry;
    std::atomic<bool> breaks_ticks = false;
    MemoryBudget memory{std::size_t{1} << 40, [this] { return breaks_ticks ? throw std::bad_alloc{} : std::size_t{0}; }};
    std::optional<Gateway> gateway;
    std::optional<net::Documents> documents;
    std::optional<net::Server> server;
    std::atomic<int> given_up = 0;
    std::atomic<int> broken = 0;  // connections
    std::thread thread;
    kit::Address address;

    explicit Rig(std::shared_ptr<Device> device = nullptr) {
        spdlog::set_level(spdlog::level::off);
        auto driving = std::make_unique<DrivingComponent>("base", navigation);
        base = driving.get();
        engine.add(std::move(driving));
        if (device) engine.add(std::move(device), "stage");
        gateway.emplace(engine, readers, telemetry, ClientLimits{}, memory);
        documents.emplace(*gateway, telemetry, *schemas, net::Site{"", WebFiles{{}}, ""});
        server.emplace(settings(), *gateway, telemetry, *documents, schemas);
        server->on_too_many_troubles([this] { ++given_up; });
        auto const url = server->url();
        address.port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
        address.patience = 2s;
        thread = std::thread{[this] { server->run(); }};
        EXPECT_TRUE(comes([&] { return kit::HttpClient{address}.get("/healthz").status > 0; }));
    }
    ~Rig() {
        faults::stop();
        kill(getpid(), SIGTERM);
        thread.join();
    }

    // Plays an application as far as the faults allow: drives, receives notifications, and leaves with or without disconnect.
    enum class Leaves : std::uint8_t { with_a_word, without };
    void drive(Leaves leaves = Leaves::with_a_word) {
        auto hasty = address;
        hasty.patience = 300ms;
        try {
            kit::WebSocketClient desk{hasty};
            desk.call("connect");
            desk.call("subscribe", "<event_type>reached_target</event_type>");
            bool const bound = is_ok(desk.call("bind", kit::component_ref("base")));
            desk.call("execute", kit::sequence(kit::unit({.component = "base", .id = "go"}) + kit::pause(1) +
                                               kit::unit({.component = "base", .type = "stop", .id = "stop"})));
            if (bound) desk.next();
            desk.call("execute", kit::sequence(kit::unit({.component = "base", .id = "again"})));
            kit::HttpClient other{hasty};
            other.call("connect");
            other.notifications(0, 0);
            other.get("/metrics");
            other.post("<connect/>");  // the full validator checks it
            if (leaves == Leaves::without) desk.keep_session();
        } catch (std::runtime_error const&) {
            ++broken;  // the connection: its application starts again
        }
    }

    // Repeats the question until the answer is true, up to two seconds.
    template <class What>
    bool comes(What const& what) {
        for (auto const end = std::chrono::steady_clock::now() + 2s; std::chrono::steady_clock::now() < end;) {
            try {
                if (what()) return true;
            } catch (std::runtime_error const&) {
                ++broken;  // not yet
            }
            std::this_thread::sleep_for(5ms);
        }
        return false;
    }

    void expect_to_live(std::string const& after) {
        EXPECT_TRUE(comes([&] { return !base->drives; })) << after << ": it drives on";
        EXPECT_TRUE(comes([&] { return kit::HttpClient{address}.get("/healthz").status == 200; })) << after;
        EXPECT_TRUE(comes([&] {
            kit::WebSocketClient desk{address};
            desk.call("connect");
            if (!is_ok(desk.call("bind", kit::component_ref("base")))) return false;
            desk.call("execute", kit::sequence(kit::pause(20) + kit::unit({.component = "base", .type = "stop"})));
            return std::string_view{desk.next_document().name()} == "completed";
        })) << after
            << ": no delay is fired";
    }
};

}  // namespace

TEST(Gateway, SurvivesMemoryThatRunsOutAtAnyCall) {
    Rig rig;
    rig.drive();
    faults::fail_at(Of::memory, UINT64_MAX);
    rig.drive();
    auto const calls = faults::calls(Of::memory);
    faults::stop();
    EXPECT_GT(calls, 500);
    for (std::uint64_t n = 1; n < calls && !testing::Test::HasFailure(); n += 13) {
        faults::fail_at(Of::memory, n);
        rig.drive(n % 5 == 0 ? Rig::Leaves::without : Rig::Leaves::with_a_word);
        faults::stop();
        if (n % 7 == 0) rig.expect_to_live("the call " + std::to_string(n));
    }
    rig.expect_to_live("all calls");
    EXPECT_EQ(rig.given_up, 0);
}

// Every 997th call up to the 20,000th.
TEST(Gateway, SurvivesMemoryThatRunsOutLate) {
    Rig rig;
    for (std::uint64_t n = 997; n <= 20'000 && !testing::Test::HasFailure(); n += 997) {
        faults::fail_at(Of::memory, n);
        while (faults::calls(Of::memory) < n) rig.drive(n % 5 == 0 ? Rig::Leaves::without : Rig::Leaves::with_a_word);
        faults::stop();
        if (n % 7 == 0) rig.expect_to_live("the call " + std::to_string(n));
    }
    rig.expect_to_live("all calls");
    EXPECT_EQ(rig.given_up, 0);
}

class Faults : public testing::TestWithParam<Of> {};

TEST_P(Faults, Of30MillisecondsAreSurvived) {
    Rig rig;
    for (int turn = 0; turn < 4; ++turn) {
        std::jthread others{[&](std::stop_token const& end) {
            faults::Exempt const exempt;
            while (!end.stop_requested()) rig.drive();
        }};
        std::this_thread::sleep_for(turn * 1ms);
        faults::fail(GetParam());
        std::this_thread::sleep_for(30ms);
        EXPECT_TRUE(rig.comes([] { return faults::calls(GetParam()) > 0; })) << "otherwise the test proves nothing";
        faults::stop();
        others.request_stop();
        others.join();
        rig.expect_to_live("turn " + std::to_string(turn));
    }
}

std::string name(testing::TestParamInfo<Of> const& of) {
    constexpr std::array names{"Memory", "Send", "Accept", "Epoll"};
    return names[static_cast<std::size_t>(of.param)];
}

INSTANTIATE_TEST_SUITE_P(Each, Faults, testing::Values(Of::memory, Of::send, Of::accept, Of::epoll), name);

TEST(Gateway, EndsIfEachTickFails) {
    Rig rig;
    rig.breaks_ticks = true;
    EXPECT_TRUE(rig.comes([&] { return rig.given_up == 1; }));
    EXPECT_FALSE(rig.base->drives);
}

TEST(Gateway, IsNotHealthyWhileADeviceHangs) {
    struct Hanging : Device {
        void advance(Instant) override {
            while (hangs) std::this_thread::sleep_for(1ms);
        }
        std::atomic<bool> hangs = false;
    };
    auto const device = std::make_shared<Hanging>();
    Rig rig{device};
    device->hangs = true;
    EXPECT_TRUE(rig.comes([&] { return kit::HttpClient{rig.address}.get("/healthz").status == 503; }));
    device->hangs = false;
    EXPECT_TRUE(rig.comes([&] { return kit::HttpClient{rig.address}.get("/healthz").status == 200; }));
}

}  // namespace rois
