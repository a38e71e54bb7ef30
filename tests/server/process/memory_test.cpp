// The memory of the gateway under loads that would need much more than its budget (docs/safety.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <list>
#include <memory>
#include <thread>
#include <vector>

#include "server/certificates.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t mib = std::size_t{1} << 20U;
constexpr auto allowed_beyond = 64 * mib;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // a sanitizer needs additional memory
#else
constexpr bool sanitized = false;
#endif

// A gateway with this budget. A thread measures its memory every millisecond.
class Memory : public testing::Test {
protected:
    void SetUp() override {
        if (sanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
    }
    void TearDown() override {
        if (!gateway) return;
        watching = false;
        watch.join();
        EXPECT_LT(most, budget + allowed_beyond) << most / mib << " MiB";
        RecordProperty("most_mib", static_cast<int>(most / mib));
    }

    void start(std::size_t mibs, std::vector<std::string> arguments = {}) {
        budget = mibs * mib;
        arguments.insert(arguments.end(), {"--memory-budget", std::to_string(mibs) + "MiB"});
        gateway = std::make_unique<GatewayProcess>(std::move(arguments));
        watch = std::thread{[this] {
            for (; watching; std::this_thread::sleep_for(1ms)) most = std::max(most, gateway->resident_bytes());
        }};
    }

    HttpClient& another() { return clients.emplace_back(*gateway); }

    // Checks the requests that must always work.
    void expect_that_it_stops() {
        EXPECT_EQ(HttpClient{*gateway}.say("POST /rois/stop HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n").status,
                  200);
        EXPECT_EQ(HttpClient{*gateway}.get("/healthz").status, 200);
    }

    // Waits up to five seconds.
    bool opens_a_session() {
        for (auto const until = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < until;)
            if (HttpClient{*gateway}.call("connect").status == 200) return true;
        return false;
    }

    std::size_t budget = 0;
    std::size_t most = 0;  // of the measuring thread, until it has ended
    std::unique_ptr<GatewayProcess> gateway;
    std::list<HttpClient> clients;
    std::atomic<bool> watching = true;
    std::thread watch;
};

Xml is_equal(std::string const& reference, std::string const& literal) {
    return element("fes:PropertyIsEqualTo", text_element("fes:ValueReference", reference) + text_element("fes:Literal", literal));
}

// A condition for person_detected of the component that has it, or of one of many that do not exist.
Xml one_of(int count, std::string const& name) {
    auto all = is_equal("component_ref", "person_detection");
    for (int i = 1; i < count; ++i) all += is_equal("component_ref", std::to_string(i) + name);
    return text_element("event_type", "person_detected") +
           element("condition", element("fes:Filter", {{"xmlns:fes", "http://www.opengis.net/fes/2.0"}}, element("fes:Or", all)));
}

TEST_F(Memory, IsBoundedForSessionsWithinTheirPredicates) {
    start(512);
    for (int session = 0; session < 30; ++session) {
        auto& client = another();
        if (client.call("connect").status != 200) break;
        std::string code = "OK";
        for (int i = 0; i < 40 && code == "OK"; ++i) {
            auto const reply =
                client.call("subscribe", one_of(250, "-" + std::to_string(100 * session + i) + std::string(3'500, 'x')));
            code = reply.return_code();
            EXPECT_THAT(reply.reason(), HasSubstr(code == "OK" ? "" : "1048576 bytes of text in total"));
        }
        EXPECT_EQ(code, "OUT_OF_RESOURCES");
    }
    EXPECT_LT(gateway->resident_bytes(), 300 * mib);
}

TEST(Conditions, TakeAtMostAsManyStepsAsTheKeyAllows) {
    Xml all;
    for (int i = 0; i < 250; ++i) all += is_equal("RobotId", "robot-" + std::to_string(i));
    auto const condition =
        element("condition", element("fes:Filter", {{"xmlns:fes", "http://www.opengis.net/fes/2.0"}}, element("fes:Or", all)));
    for (auto const& [steps, code] : {std::pair{"1000000", "OUT_OF_RESOURCES"}, {"40000000", "OK"}}) {
        GatewayProcess const gateway{{"--max-condition-steps", steps}};
        HttpClient client{gateway};
        client.call("connect");
        EXPECT_EQ(client.call("search", condition).return_code(), code) << steps;
    }
}

TEST_F(Memory, IsBoundedForLongLiterals) {
    start(512);
    auto& client = another();
    client.call("connect");
    for (int i = 0; i < 60; ++i) client.call("subscribe", one_of(2, std::to_string(i) + std::string(900'000, 'x')));
    EXPECT_LT(gateway->resident_bytes(), 60 * mib);
}

// An idle connection with TLS takes 75 kB.
struct MemoryOfTls : Memory {
    void fill(std::vector<std::string> const& arguments) {
        certificates.make("robot");
        start(64, certificates.of_gateway("robot", arguments));
        address = certificates.trusting("robot", *gateway);
        desk_address = address;
    }
    // Opens more connections than there is memory for.
    void use_up() {
        for (int i = 0; i < 900; ++i) try {
                strangers.emplace_back(address);
            } catch (std::exception const&) {  // the gateway has cut it
            }
    }
    HttpReply stop(kit::HttpClient& client) const {
        auto const token = desk_address.token.empty() ? "" : "Authorization: Bearer " + desk_address.token + "\r\n";
        return client.say("POST /rois/stop HTTP/1.1\r\nHost: localhost\r\n" + token + "Content-Length: 0\r\n\r\n");
    }

    Certificates const certificates;
    kit::Address address, desk_address;
    std::list<kit::HttpClient> strangers;
};

TEST_F(MemoryOfTls, ThatIsUsedUpLeavesAnswers) {
    fill({});
    kit::HttpClient early{desk_address};
    early.call("connect");
    early.call("bind", component_ref("navigation"));
    use_up();
    EXPECT_EQ(kit::HttpClient{desk_address}.call("connect").status, 429) << "there is no memory for a session";
    EXPECT_EQ(stop(early).status, 200);
    EXPECT_EQ(early.call("release", component_ref("navigation")).return_code(), "OK");
    kit::HttpClient late{desk_address};
    EXPECT_EQ(stop(late).status, 200);
}

TEST_F(MemoryOfTls, IsTakenFromStrangers) {
    TokenFile const file;
    auto const token = file.add("desk", "operator");
    fill(file.of_gateway());
    desk_address.token = token;
    kit::HttpClient early{desk_address};
    early.call("connect");
    use_up();
    EXPECT_EQ(stop(early).status, 200) << "its connection was not cut";
    bool has_room = false;
    for (auto const until = std::chrono::steady_clock::now() + 5s; !has_room && std::chrono::steady_clock::now() < until;)
        has_room = kit::HttpClient{desk_address}.call("connect").status == 200;
    EXPECT_TRUE(has_room);
}

TEST_F(Memory, IsBoundedForUnfinishedBodies) {
    start(96);
    auto& before = another();
    before.call("connect");
    before.call("bind", component_ref("navigation"));
    std::vector<std::unique_ptr<Line>> lines;
    for (int i = 0; i < 200; ++i) {
        auto& line = *lines.emplace_back(std::make_unique<Line>(gateway->address()));
        try {
            line.send(
                "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nContent-Length: 1000000\r\n\r\n");
            line.send(std::string(999'000, ' '));
        } catch (LineEnded const&) {
        }
    }
    // The gateway reads the bodies little by little, and answers this client meanwhile.
    HttpClient observer{*gateway};
    constexpr std::string_view counter = "rois_faults_total{code=\"too_many\"} ";
    int refused = 0;
    for (auto const end = std::chrono::steady_clock::now() + 10s; refused <= 50 && std::chrono::steady_clock::now() < end;) {
        auto const metrics = observer.get("/metrics").body;
        ASSERT_THAT(metrics, HasSubstr(counter));
        refused = std::stoi(metrics.substr(metrics.find(counter) + counter.size()));
    }
    EXPECT_GT(refused, 50) << "while they arrived";
    expect_that_it_stops();
    EXPECT_EQ(before.call("release", component_ref("navigation")).return_code(), "OK");
    EXPECT_EQ(before.call("disconnect").return_code(), "OK");
    lines.clear();
    EXPECT_TRUE(opens_a_session());
}

TEST_F(Memory, IsBoundedForUnfinishedMessages) {
    start(96);
    std::vector<std::unique_ptr<WebSocketClient>> all;
    for (int i = 0; i < 200; ++i) {
        try {
            auto& client = *all.emplace_back(std::make_unique<WebSocketClient>(*gateway));
            client.send_raw(0x01, std::string(500'000, ' '));
            client.send_raw(0x00, std::string(499'000, ' '));
        } catch (LineEnded const&) {
        }
    }
    expect_that_it_stops();
    all.clear();
    EXPECT_TRUE(opens_a_session());
}

// Comments and CDATA sections divide a text.
TEST_F(Memory, IsBoundedForTextsInPieces) {
    start(96);
    auto& client = another();
    client.call("connect");
    for (std::string const piece : {"x<!---->", "x<![CDATA[y]]>"}) {
        std::string text;
        while (text.size() < 900'000) text += piece;
        auto document = request("query", text_element("query_type", "HERE"));
        document.replace(document.find("HERE"), 4, text);
        EXPECT_EQ(client.post(document).return_code(), "BAD_PARAMETER");
    }
}

TEST_F(Memory, IsBoundedForConnectionsThatWaitBehindALongHead) {
    start(64);
    auto const before = gateway->resident_bytes();
    std::string head = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
    for (int i = 0; i < 4; ++i) head += "X-" + std::to_string(i) + ": " + std::string(3'900, 'y') + "\r\n";
    std::list<Line> lines;
    for (int i = 0; i < 500; ++i) {
        lines.emplace_back(gateway->address()).send(head + "\r\n");
        EXPECT_EQ(lines.back().take_until("\r\n"), "HTTP/1.1 200 OK\r\n");
    }
    EXPECT_LT(gateway->resident_bytes() - before, 5 * mib) << "7.5 MiB of heads";
}

std::string set_texts(int count, std::size_t length) {
    Xml units;
    for (int i = 0; i < count; ++i) {
        auto const parameter = element(
            "rois:parameter", {{"rois:name", "speech_text"}},
            element("rois:data_type_ref", {{"rois:code", "string"}}) + text_element("rois:value", std::string(length, 'x')));
        units +=
            element("rois:command_unit_list",
                    {{"xsi:type", "rois:CommandMessageType"}, {"rois:command_type", "set_parameter"}, {"rois:command_id", ""}},
                    element("rois:component_ref", {{"rois:code", "speech_synthesis"}}) + element("rois:arguments", parameter));
    }
    return request("execute",
                   element("rois:CommandUnitSequence", {{"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"}}, units));
}

TEST_F(Memory, IsBoundedForEndedCommands) {
    start(512);
    for (int session = 0; session < 11; ++session) {
        auto& client = another();
        client.call("connect");
        ASSERT_EQ(client.call("bind", component_ref("speech_synthesis")).return_code(), "OK");
        for (int i = 0; i < 16; ++i) ASSERT_EQ(client.post(set_texts(60, 16'000)).return_code(), "OK");
        client.call("release", component_ref("speech_synthesis"));
    }
    EXPECT_LT(gateway->resident_bytes(), 80 * mib) << "it had 170 MiB of arguments";
}

TEST_F(Memory, IsBoundedForDelaysThatAreOver) {
    start(512);
    auto const start_unit = element("rois:command_unit_list",
                                    {{"xsi:type", "rois:CommandMessageType"},
                                     {"rois:command_type", "stop"},
                                     {"rois:command_id", ""},
                                     {"rois:delay_time", "86400000"}},
                                    element("rois:component_ref", {{"rois:code", "speech_synthesis"}}));
    Xml units = start_unit;
    for (int i = 0; i < 4'500; ++i) units += element("rois:command_unit_list", {{"rois:delay_time", "86400000"}});
    auto const text =
        request("execute", element("rois:CommandUnitSequence", {{"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"}},
                                   element("rois:command_unit_list", {{"xsi:type", "rois:ParallelCommandUnitType"}}, units)));
    for (int i = 0; i < 100; ++i) {
        HttpClient client{*gateway};
        client.call("connect");
        client.call("bind", component_ref("speech_synthesis"));
        ASSERT_EQ(client.post(text).return_code(), "OK");
        client.call("disconnect");
    }
    EXPECT_LT(gateway->resident_bytes(), 60 * mib);
}

// Short requests with long answers, on connections that read nothing.
TEST_F(Memory, IsBoundedForUnreadAnswers) {
    start(96);
    auto& owner = another();
    owner.call("connect");
    for (auto const* way : {"http", "websocket"}) {
        std::vector<std::unique_ptr<Line>> lines;
        std::string const all = std::string{"GET /rois/schemas/rois.xsd HTTP/1.1\r\nHost: localhost\r\n\r\n"};
        std::string requests;
        for (int i = 0; i < 2'000; ++i) requests += all;
        for (int i = 0; i < 60; ++i) {
            lines.push_back(std::make_unique<Line>(gateway->address()));
            lines.back()->send(requests);
        }
        EXPECT_EQ(owner.call("search").return_code(), "OK") << way;
    }
    expect_that_it_stops();
}

// Many short bodies that never end, until the gateway answers a document with 429.
class Filling : public Memory {
protected:
    void SetUp() override {
        Memory::SetUp();
        if (sanitized) return;
        start(64);
        owner = &another();
        owner->call("connect");
        owner->call("bind", component_ref("navigation"));
    }

    // Returns the refusing answer, or the last one.
    template <class Ask>
    std::unique_ptr<HttpReply> fill_until_refused(Ask const& ask) {
        std::unique_ptr<HttpReply> reply;
        for (int i = 0; i < 200 && (reply == nullptr || reply->status != 429); ++i) {
            fill();
            reply = std::make_unique<HttpReply>(ask());
        }
        return reply;
    }

    // Sends ten bodies of 59 kB.
    void fill() {
        for (int i = 0; i < 10; ++i) {
            auto& line = *lines.emplace_back(std::make_unique<Line>(gateway->address()));
            try {
                line.send(
                    "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\nContent-Length: 60000\r\n\r\n");
                line.send(std::string(59'000, ' '));
            } catch (LineEnded const&) {
            }
        }
    }

    HttpClient* owner = nullptr;  // of an earlier session
    std::vector<std::unique_ptr<Line>> lines;
};

TEST_F(Filling, To80PercentRefusesSessionsSubscriptionsAndLongDocuments) {
    auto const filled = fill_until_refused([&] { return HttpClient{*gateway}.call("connect"); });
    auto const& refused = *filled;
    EXPECT_EQ(refused.fault(), "too_many");
    EXPECT_EQ(refused.header("Retry-After"), "1");
    EXPECT_THAT(refused.reason(), AllOf(HasSubstr("new session"), HasSubstr("of the 64 MiB of its memory_budget")));
    for (int i = 0; i < 3; ++i) fill();  // beyond 80 percent, about which the memory in use may vary
    auto const too_long = fill_until_refused([&] { return HttpClient{*gateway}.post(std::string(70'000, ' ')); });
    EXPECT_THAT(too_long->reason(), HasSubstr("long document"));
    auto const subscribed = owner->call("subscribe", text_element("event_type", "person_detected"));
    EXPECT_EQ(subscribed.return_code(), "OUT_OF_RESOURCES");
    EXPECT_THAT(subscribed.reason(), HasSubstr("memory_budget"));
    auto const metrics = HttpClient{*gateway}.get("/metrics").body;
    EXPECT_THAT(metrics, HasSubstr("rois_memory_budget_bytes 67108864\n"));
    EXPECT_THAT(metrics, HasSubstr("rois_memory_used_bytes "));
    EXPECT_THAT(metrics, HasSubstr("rois_limit_reached_total{limit=\"memory_budget\"}"));
    WebSocketClient socket{*gateway};
    socket.send_raw(0x01, std::string(70'000, ' '));
    EXPECT_EQ(socket.next().close_code(), 1008);
    lines.clear();
    EXPECT_TRUE(opens_a_session());
}

TEST_F(Filling, To100PercentLeavesShortRequests) {
    EXPECT_EQ(fill_until_refused([&] { return owner->post(std::string(30'000, ' ')); })->status, 429);
    EXPECT_EQ(owner->post(set_texts(1, 10)).return_code(), "ERROR") << "it runs: the component is not bound";
    EXPECT_EQ(owner->call("search").status, 200);
    expect_that_it_stops();
    EXPECT_EQ(owner->call("release", component_ref("navigation")).return_code(), "OK");
    EXPECT_EQ(owner->call("disconnect").return_code(), "OK");
    lines.clear();
    EXPECT_TRUE(opens_a_session());
}

}  // namespace
}  // namespace rois::test
