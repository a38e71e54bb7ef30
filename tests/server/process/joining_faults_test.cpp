// Engines that join and break off, or come too often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kit/names.hpp"
#include "kit/profile_folder.hpp"
#include "server/application.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::Contains;

// What an engine sends first: the handshake and `join`.
std::string first_bytes(std::string const& instance) {
    auto const join = R"(<join xmlns="urn:x-rois:psm:xml:message:1" name="robot1" instance=")" + instance + R"("/>)";
    return "GET /rois/engines HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " +
           std::string{kit::good_key} + "\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n" +
           kit::whole_frame(kit::Kind::text, join, kit::Masked::yes);
}

class JoiningWithFaults : public testing::Test {
protected:
    // Another engine can still join, and its components can be used.
    void expect_that_a_robot_can_join() {
        GatewayProcess const robot{{"--join", main.url(), "--join-as", "robot1", "--sim-speed", "20"}};
        main.log_with("present with");
        Application desk{Transport::websocket, main};
        desk.connect();
        EXPECT_THAT(desk.search(), Contains("robot1.navigation"));
    }

private:
    std::string engines() const {
        folder_.put("engines.json", R"({"engines": [{"name": "robot1", "joins": "robot1", "window": 1}]})");
        return folder_.name() + "/engines.json";
    }
    kit::ProfileFolder folder_;

protected:
    GatewayProcess main{{"--robots", "none", "--engines", engines()}};
};

TEST_F(JoiningWithFaults, EndsAtEachByte) {
    auto const bytes = first_bytes("a");
    for (std::size_t sent = 1; sent <= bytes.size(); ++sent) {
        kit::Line line{main.address()};
        line.send(bytes.substr(0, sent));
    }
    expect_that_a_robot_can_join();
}

TEST_F(JoiningWithFaults, ReplacesItsOwnLinkAsOftenAsItJoins) {
    auto const bytes = first_bytes("a");
    HttpClient neighbour{main};
    for (int i = 0; i < 300; ++i) {
        kit::Line line{main.address()};
        line.send(bytes);
        line.take_until("join_response");
        EXPECT_EQ(neighbour.get("/readyz").status, 200);
    }
    expect_that_a_robot_can_join();
}

// They wait for five seconds; the gateway takes no more than a hundred.
TEST_F(JoiningWithFaults, DoesNotKeepOthersAwayForEver) {
    std::vector<std::unique_ptr<kit::Line>> silent;
    auto const handshake = first_bytes("a").substr(0, first_bytes("a").find("\r\n\r\n") + 4);
    for (int i = 0; i < 100; ++i) {
        silent.push_back(std::make_unique<kit::Line>(main.address()));
        silent.back()->send(handshake);
        silent.back()->take_until("\r\n\r\n");
    }
    kit::Line late{main.address()};
    late.send(handshake);
    EXPECT_TRUE(late.ends()) << "without an answer";
    silent.clear();
    expect_that_a_robot_can_join();
}

}  // namespace
}  // namespace rois::test
