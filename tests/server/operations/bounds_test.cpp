// Limits of sessions and results that have a key of the configuration. The engine's tests have the details of each limit.
#include <chrono>
#include <string>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;

struct Bounds : testing::TestWithParam<Transport> {
    // Repeats the operation until it is refused, for ten seconds at most. Returns the last answer.
    static Document last_answer(auto const& operation) {
        auto answer = operation();
        for (auto const until = std::chrono::steady_clock::now() + 10s;
             answer.return_code() == "OK" && std::chrono::steady_clock::now() < until;)
            answer = operation();
        return answer;
    }

    // A condition with this number of predicates: comparisons, and the Or around them. `what` makes it different from others.
    static Xml with_predicates(int many, std::string const& what) {
        Xml all;
        for (int i = 2; i < many; ++i) all += equal("component_ref", what + std::to_string(i));
        return where(either(all, equal("component_ref", "person_detection")));
    }
};
ROIS_OVER_BOTH_WAYS(Bounds);

TEST_P(Bounds, OfThePredicatesOfASession) {
    GatewayProcess const gateway{{"--max-subscribed-predicates", "256"}};
    Application desk{GetParam(), gateway}, other{GetParam(), gateway};
    desk.connect();
    other.connect();
    EXPECT_THAT(desk.subscribe("person_detected", with_predicates(200, "a")), IsOk());
    EXPECT_THAT(desk.subscribe("person_detected", with_predicates(57, "b")),
                IsRefused("OUT_OF_RESOURCES", "a session's subscriptions may have at most 256 predicates"));
    EXPECT_THAT(desk.subscribe("person_detected", with_predicates(56, "b")), IsOk());
    EXPECT_THAT(other.subscribe("person_detected", with_predicates(200, "c")), IsOk()) << "another session";
}

TEST_P(Bounds, OfThePredicatesOfAllSessions) {
    GatewayProcess const gateway{{"--max-predicates", "256"}};
    Application desk{GetParam(), gateway}, other{GetParam(), gateway};
    desk.connect();
    other.connect();
    EXPECT_THAT(desk.subscribe("person_detected", with_predicates(200, "a")), IsOk());
    EXPECT_THAT(other.subscribe("person_detected", with_predicates(57, "b")),
                IsRefused("OUT_OF_RESOURCES", "all subscriptions may have at most 256 predicates"));
    EXPECT_THAT(other.subscribe("person_detected", with_predicates(56, "b")), IsOk());
}

TEST_P(Bounds, OfTheTextInConditions) {
    GatewayProcess const gateway{{"--max-condition-bytes", "2000"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    auto const with_text = [](std::size_t size) {
        return where(either(equal("component_ref", "person_detection"), equal("component_ref", std::string(size, 'x'))));
    };
    EXPECT_THAT(desk.subscribe("person_detected", with_text(1'500)), IsOk());
    EXPECT_THAT(desk.subscribe("person_detected", with_text(1'000)),
                IsRefused("OUT_OF_RESOURCES", "a session's subscriptions may have at most 2000 bytes of text"));
    EXPECT_THAT(desk.subscribe("person_detected", with_text(300)), IsOk());
}

TEST_P(Bounds, OfTheAgeOfCommandResults) {
    GatewayProcess const gateway{{"--command-results", "0.3"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    desk.bind("navigation");
    EXPECT_THAT(desk.execute({.component = "navigation", .type = "stop", .id = "stop"}), IsOk());
    EXPECT_EQ(desk.status_of("stop"), "OK");
    EXPECT_THAT(last_answer([&] { return desk.get_command_result("stop"); }), IsRefused("BAD_PARAMETER", "expired"));
}

TEST_P(Bounds, OfTheAgeOfErrorDetails) {
    GatewayProcess const gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unwell.xml", "--start-timeout", "0.2", "--error-details", "0.3"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    desk.bind("navigation");
    desk.execute({.component = "navigation", .id = "drive", .arguments = {target_position({"desk"})}});
    auto notification = desk.receive();
    while (notification.name() != "receive_error") notification = desk.receive();
    auto const id = notification.text("error_id");
    EXPECT_THAT(last_answer([&] { return desk.ask("get_error_detail", text_element("error_id", id)); }),
                IsRefused("BAD_PARAMETER", "expired"));
}

}  // namespace
}  // namespace rois::test
