// Web pages of other sites must not use the gateway through a browser (docs/clients.md: 421, 403).
#include "gateway/access/host_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

std::string machine() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string upper_case(std::string text) {
    for (auto& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string get(std::string const& path, std::string const& host, std::string const& lines = "") {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + lines + "\r\n";
}

std::string post(std::string const& host, std::string const& lines = "") {
    auto const body = request("connect");
    return "POST /rois HTTP/1.1\r\nHost: " + host + "\r\n" + lines +
           "Content-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string upgrade(std::string const& host, std::string const& lines = "") {
    return get("/rois", host,
               "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n" +
                   lines);
}

// Returns the statuses of all kinds of requests: GETs of documents, probes and notifications, POSTs, and upgrades.
void expect_of_all(GatewayProcess const& gateway, std::string const& host, std::string const& lines, int status) {
    HttpClient client{gateway};
    for (auto const* path : {"/", "/plain", "/rois", "/rois/profile", "/rois/notifications", "/rois/schemas", "/rois/map",
                             "/healthz", "/readyz", "/metrics", "/nowhere"}) {
        auto const reply = client.say(get(path, host, lines));
        EXPECT_EQ(reply.status, status) << path << " of " << host;
        EXPECT_EQ(reply.fault(), "not_allowed") << path << " of " << host;
    }
    EXPECT_EQ(client.say(post(host, lines)).status, status) << host;
    EXPECT_EQ(client.say("OPTIONS /rois HTTP/1.1\r\nHost: " + host + "\r\n" + lines + "\r\n").status, status) << host;
    EXPECT_EQ(client.say(upgrade(host, lines)).status, status) << host;
    EXPECT_EQ(client.say(get("/healthz", "localhost")).status, 200) << "the connection goes on";
}

TEST(Host, OfTheGatewayIsAccepted) {
    for (auto const& host :
         {std::string{"localhost"}, std::string{"localhost:8080"}, std::string{"LOCALHOST:1"}, std::string{"localhost."},
          std::string{"localhost:"}, std::string{"127.0.0.1"}, std::string{"127.0.0.1:8080"}, std::string{"192.0.2.7:81"},
          std::string{"[::1]"}, std::string{"[::1]:8080"}, std::string{"[2001:DB8::7]:8080"}, std::string{"[fe80::1%25eth0]"},
          machine(), machine() + ":8080", upper_case(machine()), machine() + "."}) {
        HttpClient client;
        for (auto const* path : {"/healthz", "/readyz", "/metrics", "/", "/plain"})
            EXPECT_EQ(client.say(get(path, host)).status, 200) << path << " of " << host;
        EXPECT_EQ(client.say(post(host)).status, 200) << host;
        EXPECT_EQ(client.say(upgrade(host)).status, 101) << host;
    }
}

TEST(Host, OfOthersIsMisdirectedOnEveryRequest) {
    GatewayProcess const gateway;
    for (auto const* host :
         {"evil.example", "evil.example:8080", "localhost.evil.example", "evil.localhost", "127.0.0.1.evil.example", "127.1",
          "[::1", "[evil.example]", "::1", "localhost:port", "localhost:99999", "localhost..", ".", "local\xC3\xA9host", ""})
        expect_of_all(gateway, host, "", 421);
    HttpClient client{gateway};
    EXPECT_THAT(client.say(post("evil.example")).reason(), HasSubstr("this gateway is not known as 'evil.example'"));
    EXPECT_THAT(client.get("/metrics").body, HasSubstr("rois_sessions 0\n"));
}

// Names that mDNS or name servers derive from the machine's name are rejected; the key `hosts` allows them.
TEST(Host, OfTheMachineInADomainIsMisdirected) {
    HttpClient client;
    for (auto const* domain : {".local", ".lan", ".example"})
        EXPECT_EQ(client.say(get("/healthz", machine() + domain)).status, 421) << domain;
    GatewayProcess const gateway{{"--hosts", machine() + ".local"}};
    EXPECT_EQ(HttpClient{gateway}.say(get("/healthz", machine() + ".local")).status, 200);
}

TEST(Host, OfATargetInAbsoluteFormIsCheckedToo) {
    auto const target = [](std::string const& of_target, std::string const& host) {
        return HttpClient{}.say("GET http://" + of_target + "/healthz HTTP/1.1\r\nHost: " + host + "\r\n\r\n").status;
    };
    EXPECT_EQ(target("127.0.0.1:8080", "localhost"), 200);
    EXPECT_EQ(target("evil.example", "localhost"), 421);
    EXPECT_EQ(target("localhost", "evil.example"), 421);
}

TEST(Host, MayBeAbsentInHttp10) {
    EXPECT_EQ(HttpClient{}.say("GET /healthz HTTP/1.0\r\n\r\n").status, 200);
    EXPECT_EQ(HttpClient{}.say("GET /healthz HTTP/1.0\r\nHost: evil.example\r\n\r\n").status, 421);
    EXPECT_EQ(HttpClient{}.say("GET /healthz HTTP/1.0\r\nOrigin: http://evil.example\r\n\r\n").status, 403);
}

TEST(Host, OfTheKeyHostsIsAccepted) {
    GatewayProcess const gateway{{"--hosts", "Gateway robots.example."}};
    HttpClient client{gateway};
    for (auto const* host : {"gateway:8080", "GATEWAY", "robots.example", "robots.example.:443", "localhost"})
        EXPECT_EQ(client.say(post(host)).status, 200) << host;
    EXPECT_EQ(client.say(post("other.example")).status, 421);
    EXPECT_EQ(client.say(post("gateway", "Origin: https://gateway\r\n")).status, 200);
}

// A repeated head is not checked again; a rejected head is rejected again.
TEST(Host, IsCheckedInEachOfManyRequests) {
    HttpClient client;
    for (auto const& [host, status] : {std::pair{"localhost", 200}, {"evil.example", 421}, {"localhost", 200}}) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(client.say(post(host)).status, status) << host;
    }
}

TEST(Origin, OfOthersIsRefusedOnEveryRequest) {
    auto const& gateway = shared_gateway();
    for (auto const* origin : {"http://evil.example", "null", "http://localhost:3000", "file://localhost:8080", "http://", "",
                               "http://localhost:8080.evil.example", "http://localhost:8080\r\nOrigin: http://localhost:8080"})
        expect_of_all(gateway, "localhost:8080", std::string{"Origin: "} + origin + "\r\n", 403);
    EXPECT_THAT(HttpClient{gateway}.say(post("localhost", "Origin: null\r\n")).reason(),
                HasSubstr("pages of the origin 'null' are not allowed here"));
}

TEST(Origin, OfThisServerIsAccepted) {
    for (auto const& host :
         {std::string{"127.0.0.1:8080"}, std::string{"localhost:8080"}, machine() + ":8080", std::string{"[::1]:8080"}}) {
        HttpClient client;
        for (auto const& origin : {"http://" + host, "https://" + host}) {
            auto const lines = "Origin: " + origin + "\r\n";
            EXPECT_EQ(client.say(get("/", host, lines)).status, 200) << origin;
            EXPECT_EQ(client.say(get("/plain", host, lines)).status, 200) << origin;
            EXPECT_EQ(client.say(post(host, lines)).status, 200) << origin;
        }
        EXPECT_EQ(client.say(upgrade(host, "Origin: http://" + host + "\r\n")).status, 101) << host;
    }
}

TEST(Origin, OfTheKeyAllowedOriginsIsAccepted) {
    GatewayProcess const gateway{{"--allowed-origins", "https://console.example"}};
    HttpClient client{gateway};
    EXPECT_EQ(client.say(post("127.0.0.1", "Origin: https://console.example\r\n")).status, 200);
    EXPECT_EQ(client.say(post("127.0.0.1", "Origin: http://console.example\r\n")).status, 403);
    EXPECT_EQ(client.say(post("console.example", "Origin: https://console.example\r\n")).status, 421) << "a page, not a host";
}

TEST(MachineName, IsThatOfGethostname) { EXPECT_EQ(machine_name(), host_name(machine())); }

TEST(HostName, IsInLowerCaseWithoutADotAtItsEnd) {
    EXPECT_EQ(host_name("Robots.Example."), "robots.example");
    EXPECT_EQ(host_name("my_gateway-2"), "my_gateway-2");
    for (auto const* wrong : {"", ".", "a..b", ".a", "a..", "a:80", "http://a", "*.example", "a b", "[::1]", "\xC3\xA9"})
        EXPECT_EQ(host_name(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace rois::test
