// A hundred random cuts during 10,000 events and 500 commands: no notification is lost or repeated without a report.
#include <map>

#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

constexpr int commands = 500;
constexpr int subscriptions = 20;
constexpr std::size_t cuts = 100;

class TheStorm : public BothWays {};
ROIS_BOTH_WAYS(TheStorm);

// Counts the received notifications: events by subscription and id, and the ends of each command.
struct Received {
    std::map<std::string, int> events;  // "subscribe_id event_id"
    std::map<std::string, int> completions;
    std::uint64_t last = 0;
    std::uint64_t unreported = 0;
    std::uint64_t twice = 0;
    std::uint64_t lost = 0;

    void take(Notification const& notification, std::uint64_t sequence) {
        auto const step = sequence - last;
        if (sequence <= last) ++twice;
        last = std::max(last, sequence);
        if (auto const* const gap = std::get_if<Lost>(&notification)) {
            lost += gap->count;
            unreported += step - gap->count;
            return;
        }
        unreported += step - 1;
        if (auto const* const event = std::get_if<ReceiveEvent>(&notification))
            ++events[event->subscribe_id.text + " " + event->event_id.text];
        if (auto const* const completed = std::get_if<Completed>(&notification)) ++completions[completed->command_id.text];
    }
};

// Runs one command after the other. Each start sends one event to every subscription.
Task<int> detect(Client& robot, std::vector<EventStream>& streams) {
    auto const detection = co_await robot.bind<PersonDetection>("person_detection");
    for (int i = 0; i < subscriptions; ++i) {
        auto condition = result("number") > -1 - i;
        auto stream = co_await detection.subscribe("person_detected", std::move(condition));
        streams.push_back(std::move(stream));
    }
    int good = 0;
    for (int i = 0; i < commands; ++i) {
        auto const status = co_await detection.start();
        if (status == CompletedStatus::ok) ++good;
        for (auto& stream : streams) {
            auto const event = co_await stream.next_event(10s);
            if (!event) co_return good;
        }
    }
    co_return good;
}

TEST_P(TheStorm, MissesNothingAndRepeatsNothing) {
    GatewayProcess const gateway{{"--sim-speed", "20"}};
    Proxy proxy{gateway.port()};
    Received received;
    std::uint64_t gaps = 0;
    Observers observers;
    observers.notification = [&](Notification const& notification, std::uint64_t sequence) {
        received.take(notification, sequence);
    };
    observers.gap = [&](Gap const&) { ++gaps; };
    std::vector<EventStream> streams;
    {
        auto patient = settings(proxy.url());
        patient.deadline = 30s;
        Client robot{patient, observers};
        EXPECT_FALSE(robot.wait(robot.opened()));
        proxy.cut_at_random(7, 45'000, cuts);
        EXPECT_EQ(robot.wait(detect(robot, streams)), commands);
        EXPECT_EQ(robot.wait(robot.call(Search{})).return_code, ReturnCode::ok);
        streams.clear();
    }
    EXPECT_GE(proxy.cuts(), cuts);
    EXPECT_EQ(gaps, 0U);
    EXPECT_EQ(received.unreported, 0U);
    EXPECT_EQ(received.twice, 0U);
    EXPECT_EQ(received.lost, 0U);
    EXPECT_EQ(received.completions.size(), static_cast<std::size_t>(commands));
    for (auto const& [id, count] : received.completions) EXPECT_EQ(count, 1) << id;
    EXPECT_GE(received.events.size(), static_cast<std::size_t>(commands) * subscriptions);
    for (auto const& [id, count] : received.events) EXPECT_EQ(count, 1) << id;
}

}  // namespace
}  // namespace rois::test
