// The limits of one client: connections, sessions and event streams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ifaddrs.h>
#include <linux/capability.h>
#include <netdb.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "gateway/access/addresses.hpp"
#include "gateway/access/admission.hpp"
#include "gateway/access/session_quota.hpp"
#include "kit/profile_folder.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

std::string fault_of(pugi::xml_node answer) {
    return std::string_view{answer.name()} == "fault" ? answer.attribute("code").value() : "";
}

// Returns an IPv4 address of this machine that is not the loopback, if it has one.
std::optional<std::string> own_address() {
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0) return {};
    std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> const owner{all, freeifaddrs};
    for (auto const* one = all; one != nullptr; one = one->ifa_next) {
        std::array<char, NI_MAXHOST> name{};
        if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
        if (getnameinfo(one->ifa_addr, sizeof(sockaddr_in), name.data(), name.size(), nullptr, 0, NI_NUMERICHOST) != 0) continue;
        std::string address = name.data();
        if (!is_loopback(read_address(address).value())) return address;
    }
    return {};
}

// A gateway at an address to which the limits apply.
class ClientLimits : public testing::Test {
protected:
    void SetUp() override {
        if (!own_address()) GTEST_SKIP() << "this machine has no address but the loopback";
    }

    void start(std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--listen", "0.0.0.0:0", "--allow-anyone"});
        gateway = std::make_unique<GatewayProcess>(std::move(arguments));
    }

    // With a file of tokens. Returns the address for the holder of one, an operator.
    kit::Address start_with_tokens(std::vector<std::string> arguments) {
        auto const token = file.add("desk", "operator");
        gateway = std::make_unique<GatewayProcess>(file.of_gateway(arguments));
        auto with = gateway->address();
        with.token = token;
        return with;
    }

    std::unique_ptr<kit::HttpClient> http(bool loopback = false) const {
        return std::make_unique<kit::HttpClient>(address(loopback));
    }

    kit::Address address(bool loopback = false) const {
        kit::Address there = gateway->address();
        if (!loopback) there.host = *own_address();
        return there;
    }

    TokenFile file;
    std::unique_ptr<GatewayProcess> gateway;
};

// Opens a new session on the same connection.
HttpReply open_session(kit::HttpClient& client) {
    client.session.clear();
    return client.post(request("connect"));
}

TEST_F(ClientLimits, BoundTheSessionsOfOneAddress) {
    start({"--max-sessions-per-address", "20"});
    auto first = http(), second = http(), third = http();
    for (int i = 0; i < 16; ++i) EXPECT_EQ(open_session(*first).status, 200) << i;
    std::string last;
    for (int i = 0; i < 4; ++i) last = open_session(*second).text("session");
    auto const refused = open_session(*third);
    EXPECT_EQ(refused.status, 429);
    EXPECT_EQ(refused.fault(), "too_many");
    EXPECT_THAT(refused.reason(), HasSubstr("this address has 20 sessions open already"));
    auto local = http(true);
    EXPECT_EQ(open_session(*local).status, 200) << "the loopback is another address, and is not limited";
    second->session = last;
    EXPECT_EQ(second->call("disconnect").return_code(), "OK");
    EXPECT_EQ(open_session(*third).status, 200) << "one has ended";
    EXPECT_THAT(local->get("/metrics").body, HasSubstr("rois_limit_reached_total{limit=\"sessions_per_address\"} 1\n"));
}

// Someone behind the same address must not keep an operator from stopping the robot.
class ClientLimitsWithThreads : public ClientLimits, public testing::WithParamInterface<std::string> {};

TEST_P(ClientLimitsWithThreads, LetAConnectionReplaceOneWithoutAToken) {
    auto with = start_with_tokens({"--max-connections-per-address", "3", "--listen", "0.0.0.0:0", "--threads", GetParam()});
    with.host = address().host;
    kit::HttpClient early{with};
    EXPECT_EQ(early.get("/rois/profile").status, 200);
    std::vector<std::unique_ptr<Line>> strangers;
    for (int i = 0; i < 20; ++i) {
        strangers.push_back(std::make_unique<Line>(address()));
        strangers.back()->send("GET /rois/profile HTTP/1.1\r\n");
    }
    for (int i = 0; i < 20; ++i) EXPECT_EQ(kit::HttpClient{with}.get("/rois/stop", {}, "POST").status, 200);
    EXPECT_EQ(early.get("/rois/profile").status, 200) << "it was not replaced";
}

INSTANTIATE_TEST_SUITE_P(Of, ClientLimitsWithThreads, testing::Values("1", "4"));

TEST_F(ClientLimits, BoundTheConnectionsOfEachToken) {
    auto const observer = file.add("screen", "observer");
    auto with = start_with_tokens({"--max-connections-per-address", "3", "--listen", "0.0.0.0:0"});
    auto const token = std::exchange(with.token, observer);
    with.host = address().host;
    std::list<kit::HttpClient> screens;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(screens.emplace_back(with).get("/rois/profile").status, 200) << i;
    for (int i = 0; i < 10; ++i) {
        auto const refused = screens.emplace_back(with).get("/rois/profile");
        EXPECT_EQ(refused.status, 429);
        EXPECT_THAT(refused.reason(), HasSubstr("this token has 3 connections open already"));
    }
    with.token = token;
    kit::HttpClient desk{with};
    EXPECT_EQ(desk.get("/rois/stop", {}, "POST").status, 200) << "another token is another holder";
    std::list<kit::HttpClient> desks;
    for (int i = 0; i < 3; ++i) desks.emplace_back(with).get("/rois/profile");
    EXPECT_EQ(desks.emplace_back(with).get("/rois/stop", {}, "POST").status, 200) << "also beyond the limit";
    EXPECT_EQ(desks.emplace_back(with).get("/healthz").status, 200) << "which needs no token";
    EXPECT_EQ(screens.front().get("/rois/profile").status, 200);
    screens.pop_front();
    with.token = observer;
    int status = 429;
    for (int i = 0; i < 1'000 && status == 429; ++i) status = kit::HttpClient{with}.get("/rois/profile").status;
    EXPECT_EQ(status, 200) << "one has closed";
}

TEST_F(ClientLimits, LetClientsShowTheirTokensBeforeTheyAreTakenForStrangers) {
    auto const with = start_with_tokens({"--max-connections", "4"});
    std::list<kit::HttpClient> idle, late;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(idle.emplace_back(with).get("/rois/profile").status, 200);
    gateway->signal(SIGSTOP);
    for (int i = 0; i < 3; ++i)
        late.emplace_back(with).line().send("GET /rois/profile HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
                                            with.token + "\r\n\r\n");
    gateway->signal(SIGCONT);
    for (auto& each : late) EXPECT_EQ(each.read().status, 200);
}

// Strangers whose connections are held by any thread of the gateway, and who wait at any place of a request.
TEST_F(ClientLimits, CutStrangersBeforeIdleClients) {
    auto const with = start_with_tokens({"--max-connections", "20", "--threads", "4"});
    std::string const refused = "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nabc";
    for (auto const& begun : {std::string{}, std::string{"G"}, refused}) {
        kit::HttpClient desk{with};
        EXPECT_EQ(desk.get("/rois/stop", {}, "POST").status, 200);
        std::vector<std::unique_ptr<Line>> strangers;
        for (int i = 0; i < 60; ++i) {
            strangers.push_back(std::make_unique<Line>(gateway->address()));
            if (!begun.empty()) strangers.back()->send_now(begun);
        }
        kit::HttpClient late{with};
        EXPECT_EQ(late.get("/rois/profile").status, 200) << "takes the place of a stranger";
        EXPECT_EQ(desk.get("/rois/stop", {}, "POST").status, 200) << "on its old connection";
    }
}

TEST_F(ClientLimits, LetAConnectionReplaceAnIdleOneOfAnyThread) {
    auto const with = start_with_tokens({"--max-connections", "4", "--threads", "4"});
    std::list<kit::HttpClient> all;
    for (int i = 0; i < 12; ++i) EXPECT_EQ(all.emplace_back(with).get("/rois/profile").status, 200);
}

TEST_F(ClientLimits, BoundTheConnectionsOfOneAddress) {
    start({"--max-connections-per-address", "3"});
    std::vector<std::unique_ptr<kit::HttpClient>> all;
    for (int i = 0; i < 3; ++i) {
        all.push_back(http());
        EXPECT_EQ(all.back()->get("/healthz").status, 200) << i;
    }
    auto refused = http();
    auto const reply = refused->read();
    EXPECT_EQ(reply.status, 429);
    EXPECT_THAT(reply.reason(), HasSubstr("this address has 3 connections open already"));
    EXPECT_TRUE(refused->line().ends());
    std::vector<std::unique_ptr<kit::HttpClient>> locals;
    for (int i = 0; i < 5; ++i) {
        locals.push_back(http(true));
        EXPECT_EQ(locals.back()->get("/healthz").status, 200) << "the loopback is not limited";
    }
    all.pop_back();
    auto const status_of_another = [&] {
        auto another = http();
        another->line().send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
        return another->read().status;
    };
    int status = status_of_another();
    for (int i = 0; i < 1'000 && status == 429; ++i) status = status_of_another();
    EXPECT_EQ(status, 200) << "one has closed";
}

TEST_F(ClientLimits, DoNotApplyToProxies) {
    start({"--max-connections-per-address", "3", "--max-sessions-per-address", "3", "--max-sessions-per-connection", "3",
           "--proxies", "198.51.100.0/24 " + *own_address()});
    std::vector<std::unique_ptr<kit::HttpClient>> all;
    for (int i = 0; i < 10; ++i) {
        all.push_back(http());
        EXPECT_EQ(open_session(*all.front()).status, 200) << i;
        EXPECT_EQ(open_session(*all.back()).status, 200) << i;
    }
}

TEST(ClientLimitsOfTheLoopback, ApplyToEachConnectionAlone) {
    GatewayProcess const gateway{{"--max-connections-per-address", "2", "--max-sessions-per-address", "2"}};
    std::vector<std::unique_ptr<HttpClient>> all;
    all.reserve(4);
    for (int i = 0; i < 4; ++i) all.push_back(std::make_unique<HttpClient>(gateway));
    for (auto& each : all) EXPECT_EQ(open_session(*each).status, 200);
    auto& one = *all.front();
    for (int i = 1; i < 16; ++i) EXPECT_EQ(open_session(one).status, 200) << i;
    auto const refused = open_session(one);
    EXPECT_EQ(refused.status, 429);
    EXPECT_THAT(refused.reason(), HasSubstr("this connection has 16 sessions open already"));
    EXPECT_EQ(one.get("/healthz").status, 200) << "the connection goes on";
    EXPECT_EQ(open_session(*all.back()).status, 200) << "another connection may";
}

TEST(Sessions, ThatAreIdleMakeRoomForNewOnes) {
    GatewayProcess const gateway{{"--max-sessions", "3"}};
    std::array<HttpClient, 3> old{HttpClient{gateway}, HttpClient{gateway}, HttpClient{gateway}};
    for (auto& each : old) each.call("connect");
    old[0].call("bind", component_ref("navigation"));
    old[1].call("subscribe", "<event_type>person_detected</event_type>");
    HttpClient next{gateway};
    EXPECT_EQ(next.call("connect").status, 200);
    EXPECT_EQ(old[2].call("search").fault(), "no_session") << "it was idle";
    EXPECT_EQ(old[0].call("search").status, 200);
    EXPECT_EQ(old[1].call("search").status, 200);
    next.call("bind", component_ref("follow"));
    HttpClient refused{gateway};
    auto const reply = refused.call("connect");
    EXPECT_EQ(reply.status, 429) << "no session is idle";
    EXPECT_THAT(refused.get("/metrics").body, HasSubstr("rois_sessions_replaced_total 1\n"));
}

TEST(EventStreams, OfASessionAreEightAtMost) {
    HttpClient client;
    client.call("connect");
    auto const ask = [&](Line& line) {
        line.send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
                  client.session + "\r\n\r\n");
        return line.take_until("\r\n").substr(9, 3);
    };
    std::vector<std::unique_ptr<Line>> streams;
    for (int i = 0; i < 8; ++i) {
        streams.push_back(std::make_unique<Line>(shared_gateway().address()));
        EXPECT_EQ(ask(*streams.back()), "200") << i;
    }
    Line ninth{shared_gateway().address()};
    EXPECT_EQ(ask(ninth), "429");
    EXPECT_EQ(client.notifications(0, 0).status, 200) << "a long poll does not count as a stream";
    streams.pop_back();
    auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{5};
    std::string status = "429";
    while (status == "429" && std::chrono::steady_clock::now() < until) {
        streams.push_back(std::make_unique<Line>(shared_gateway().address()));
        status = ask(*streams.back());
    }
    EXPECT_EQ(status, "200") << "one has closed";
}

TEST(EventStreams, OfASessionAreAsManyAsTheKeyAllows) {
    GatewayProcess const gateway{{"--max-streams-per-session", "2"}};
    HttpClient client{gateway}, first{gateway}, second{gateway}, third{gateway};
    client.call("connect");
    auto const status_of = [&](HttpClient& stream) {
        return stream
            .say("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
                 client.session + "\r\n\r\n")
            .status;
    };
    EXPECT_EQ(status_of(first), 200);
    EXPECT_EQ(status_of(second), 200);
    EXPECT_EQ(status_of(third), 429);
}

TEST(WebSocketWithoutASession, ClosesAfterAWhile) {
    GatewayProcess const gateway{{"--connect-timeout", "0.3", "--ping-interval", "5"}};
    WebSocketClient mute{gateway}, speaks{gateway}, left{gateway};
    speaks.call("connect");
    left.call("connect");
    left.call("disconnect");
    EXPECT_EQ(mute.await_close(), 1008);
    EXPECT_EQ(left.await_close(), 1008);
    EXPECT_EQ(fault_of(speaks.call("search")), "") << "it has a session";
}

// Restores the limit of the test program.
class OpenFiles : public testing::Test {
protected:
    void SetUp() override { getrlimit(RLIMIT_NOFILE, &before_); }
    void TearDown() override { setrlimit(RLIMIT_NOFILE, &before_); }
    rlimit before_{};
};

TEST_F(OpenFiles, AreAsManyAsConnectionsNeed) {
    rlimit const low{256, before_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &low);
    GatewayProcess const gateway{{"--max-connections", "300"}};
    std::vector<std::unique_ptr<HttpClient>> all;
    all.reserve(290);
    rlimit const own{1'024, before_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &own);
    for (int i = 0; i < 290; ++i) all.push_back(std::make_unique<HttpClient>(gateway));
    for (auto& each : all) ASSERT_EQ(each->get("/healthz").status, 200);
}

// A shell lowers its limit and becomes the gateway, which may not raise it again.
TEST_F(OpenFiles, TooFewAreLoggedInOneLine) {
    auto const starts = [] {
        prctl(PR_CAPBSET_DROP, CAP_SYS_RESOURCE, 0, 0, 0);  // for this thread and what it starts
        std::vector<std::string> const arguments{
            "-c", R"(ulimit -n 200; exec "$0" "$@")", gateway_program, "--max-connections", "1000", "--threads", "1"};
        return std::make_unique<GatewayProcess>(arguments, Variables{}, "sh");
    };
    auto const gateway = std::async(std::launch::async, starts).get();
    EXPECT_THAT(gateway->log_with("listening on"),
                HasSubstr("the limit of open files is 200 and cannot be raised to 1072, which max_connections = 1000 needs: "
                          "at most 128 connections are accepted"));
    EXPECT_EQ(HttpClient{*gateway}.get("/healthz").status, 200);
}

TEST(Networks, ContainTheAddressesOfTheirPrefix) {
    auto const holds = [](std::string_view network, std::string_view address) {
        return read_network(network).value().contains(read_address(address).value());
    };
    EXPECT_TRUE(holds("192.0.2.1", "192.0.2.1"));
    EXPECT_FALSE(holds("192.0.2.1", "192.0.2.2"));
    EXPECT_TRUE(holds("192.0.2.1", "::ffff:192.0.2.1"));
    EXPECT_TRUE(holds("10.0.0.0/8", "10.255.0.7"));
    EXPECT_FALSE(holds("10.0.0.0/8", "11.0.0.0"));
    EXPECT_TRUE(holds("192.0.2.128/25", "192.0.2.200"));
    EXPECT_FALSE(holds("192.0.2.128/25", "192.0.2.100"));
    EXPECT_TRUE(holds("2001:db8::/33", "2001:db8:7fff::1"));
    EXPECT_FALSE(holds("2001:db8::/33", "2001:db8:8000::1"));
    EXPECT_TRUE(holds("0.0.0.0/0", "203.0.113.1"));
    EXPECT_FALSE(holds("0.0.0.0/0", "2001:db8::1"));
    for (auto const* wrong : {"", "proxy", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/-1", "::/129", "10.0.0", "[::1]"})
        EXPECT_FALSE(read_network(wrong)) << wrong;
    for (std::string const text : {"192.0.2.1", "10.0.0.0/8", "2001:db8::/32", "::1"})
        EXPECT_EQ(text_of(read_network(text).value()), text);
}

TEST(Limits, DependOnTheAddress) {
    std::vector<Network> const proxies{read_network("192.0.2.0/24").value()};
    auto const of = [&](std::string_view address) { return limits_of(read_address(address).value(), proxies); };
    for (auto const* loopback : {"127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1"})
        EXPECT_EQ(of(loopback), Limits::of_connection) << loopback;
    EXPECT_EQ(of("192.0.2.9"), Limits::none);
    EXPECT_EQ(of("198.51.100.1"), Limits::all);
    EXPECT_EQ(limits_of(read_address("127.0.0.1").value(), {read_network("127.0.0.1").value()}), Limits::none);
}

TEST(Admission, CountsAConnectionForItsTokenOnceItHasShownOne) {
    auto const here = read_address("192.0.2.1").value();
    Admission admission{10, 2};
    std::list<Admission::Place> places;
    auto const enters = [&] {
        auto entered = admission.enter(here, Limits::all);
        auto* place = std::get_if<Admission::Place>(&entered);
        if (place != nullptr) places.push_back(std::move(*place));
        return place != nullptr;
    };
    ASSERT_TRUE(enters() && enters());
    EXPECT_TRUE(places.front().show("desk") && places.back().show("desk"));
    ASSERT_TRUE(enters());
    EXPECT_FALSE(places.back().show("desk"));
    EXPECT_TRUE(places.back().show("chief"));
    EXPECT_TRUE(places.front().show("chief")) << "another one";
    ASSERT_TRUE(enters());
    EXPECT_TRUE(places.back().show("desk"));
    places.clear();
    ASSERT_TRUE(enters() && enters());
    EXPECT_FALSE(enters());
    places.front().leave();
    EXPECT_TRUE(places.front().is_left());
    EXPECT_TRUE(enters());
}

TEST(Admission, CountsEachAddressForAsLongAsItsConnectionsLive) {
    auto const here = read_address("192.0.2.1").value(), there = read_address("192.0.2.2").value();
    Admission admission{4, 2};
    std::list<Admission::Place> places;
    auto const enter = [&](rois::Address const& address, Limits limits) {
        auto entered = admission.enter(address, limits);
        if (auto* place = std::get_if<Admission::Place>(&entered)) return places.push_back(std::move(*place)), std::string{"in"};
        return std::string{std::get<Admission::Refused>(entered) == Admission::Refused::full ? "full" : "full of address"};
    };
    EXPECT_EQ(enter(here, Limits::all), "in");
    EXPECT_EQ(enter(here, Limits::all), "in");
    EXPECT_EQ(enter(here, Limits::all), "full of address");
    EXPECT_EQ(enter(there, Limits::all), "in");
    EXPECT_EQ(enter(here, Limits::of_connection), "in");
    EXPECT_EQ(enter(there, Limits::all), "full");
    {
        auto const own = admission.enter_from_inside();
        places.pop_front();
        EXPECT_EQ(enter(here, Limits::all), "full") << "it counts";
    }
    EXPECT_EQ(enter(here, Limits::all), "in");
}

// Only the loopback proves that the engine is on this machine.
TEST_F(ClientLimits, LetEnginesJoinFromTheLoopbackOnly) {
    kit::ProfileFolder const folder;
    folder.put("engines.json", R"({"engines": [{"name": "robot1", "joins": "robot1"}]})");
    start({"--robots", "none", "--engines", folder.name() + "/engines.json"});
    auto const from_outside = http(), from_here = http(true);
    auto const refused = kit::shake_hands(*from_outside, {}, "/rois/engines");
    EXPECT_EQ(refused.status, 403);
    EXPECT_THAT(refused.reason(), HasSubstr("a connection from this machine"));
    EXPECT_EQ(kit::shake_hands(*from_here, {}, "/rois/engines").status, 101);
}

TEST(SessionQuota, CountsSessionsUntilTheyEnd) {
    using Verdict = SessionQuota::Verdict;
    auto const here = read_address("192.0.2.1").value();
    auto const make = [&](Limits limits) { return std::make_shared<Client>(Client{here, limits}); };
    auto const first = make(Limits::all), second = make(Limits::all), local = make(Limits::of_connection),
               proxy = make(Limits::none);
    SessionQuota quota{2, 3};
    quota.opened(1, first);
    quota.opened(2, first);
    EXPECT_EQ(quota.verdict(*first), Verdict::full_connection);
    quota.opened(3, second);
    EXPECT_EQ(quota.verdict(*second), Verdict::full_address);
    EXPECT_EQ(quota.verdict(*local), Verdict::open);
    EXPECT_EQ(quota.verdict(*proxy), Verdict::open);
    quota.ended(1);
    quota.ended(7);
    EXPECT_EQ(quota.verdict(*first), Verdict::open);
    EXPECT_EQ(quota.verdict(*second), Verdict::open);
}

}  // namespace
}  // namespace rois::test
