// Figure 1 of the specification: over HTTP, over a WebSocket, and by docs/examples/reception.sh.
#include <algorithm>

#include "server/conversation.hpp"
#include "server/hall/reception.hpp"

namespace rois::test {
namespace {

using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

constexpr auto message_for_tanaka = "Mr. Tanaka, your meeting is in room 3.";

GatewayProcess hall_with(std::string const& scenario) {
    return GatewayProcess{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/" + scenario, "--sim-speed", "20", "--seed", "7"}};
}

bool is_completed(Document const& notification) { return notification.name() == "completed"; }

// Returns the ids of the completed commands, in order.
std::vector<std::string> completed(std::vector<Document> const& history) {
    std::vector<std::string> ids;
    for (auto const& one : history)
        if (is_completed(one)) ids.push_back(one.text("command_id"));
    return ids;
}

// Returns the notifications after the previous `completed` up to that of this command.
std::vector<Document> notifications_of(std::string const& id, std::vector<Document> const& history) {
    std::vector<Document> notifications;
    for (auto const& one : history) {
        notifications.push_back(one);
        if (!is_completed(one)) continue;
        if (one.text("command_id") == id) return notifications;
        notifications.clear();
    }
    return {};
}

void expect_targets_before_their_completed(Reception const& reception) {
    for (auto const& id : reception.driven()) {
        auto const received = lines(notifications_of(id, reception.history()));
        auto const arrived = received.back() == "completed " + id + " OK";
        bool const unsubscribed = id == reception.driven().back();
        EXPECT_EQ(std::ranges::count(received, "reached_target"), arrived && !unsubscribed ? 1 : 0) << id;
    }
}

struct TheReception : testing::TestWithParam<Transport> {};
ROIS_OVER_BOTH_WAYS(TheReception);

TEST_P(TheReception, ReceivesFourVisitors) {
    auto const gateway = hall_with("four_visitors.xml");
    Reception reception{GetParam(), gateway, {{"tanaka", message_for_tanaka}}};
    std::vector<Received> received;
    for (int i = 0; i < 4; ++i) received.push_back(reception.receive());
    auto const received_until_closed = reception.history().size();
    reception.close();

    Received const tanaka{"tanaka", message_for_tanaka, {"Room 3, thank you."}};
    Received const traveller{"", "Welcome. How can I help you?", {"Where is the exhibition?"}};
    Received const suzuki{"suzuki", "Welcome. There is no message for you today.", {}};
    Received const courier{"", "Welcome. How can I help you?", {}};
    EXPECT_THAT(received, ElementsAre(tanaka, traveller, suzuki, courier));

    EXPECT_EQ(completed(reception.history()), reception.commanded()) << "each once, and in the order commanded";
    expect_targets_before_their_completed(reception);
    for (auto i = received_until_closed; i < reception.history().size(); ++i)
        EXPECT_TRUE(is_completed(reception.history()[i])) << "after unsubscribe: " << reception.history()[i].whole();
    EXPECT_LT(distance(reception.where(), reception.start()), 150);
}

// Returns the output of a shell command; checks its exit code.
std::string printed_by(std::string const& command) {
    auto const ended = run_shell(command);
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.error;
    return ended.out;
}

// Returns the lines of the script without their time, with N in place of each number and its sign.
std::vector<std::string> steps(std::string const& text) {
    std::vector<std::string> steps;
    for (std::size_t begin = 0; begin < text.size();) {
        auto const end = text.find('\n', begin);
        auto const line = text.substr(begin + 10, end - begin - 10);
        begin = end + 1;
        std::string step;
        for (char const c : line) {
            bool const digit = c >= '0' && c <= '9';
            if (digit && step.ends_with(" -")) step.pop_back();
            if (!digit || !step.ends_with('N')) step.push_back(digit ? 'N' : c);
        }
        steps.push_back(step);
    }
    return steps;
}

// Waits until the only visitor stands at the end of their way.
void wait_for_tanaka(GatewayProcess const& gateway) {
    Application guard{Transport::websocket, gateway};
    guard.connect();
    guard.bind("person_localization");
    guard.subscribe("person_localized", "", true);
    guard.execute(Command{.component = "person_localization"});
    Pose const end{9'000, 4'500};
    Pose now;
    while (distance(now, end) > 300) {
        auto const text = guard.next_event("person_localized").values()["position_data"].at(0);
        std::sscanf(text.c_str(), "%lf, %lf", &now.x, &now.y);
    }
}

TEST(TheReceptionScript, ReceivesAVisitor) {
    auto const gateway = hall_with("one_visitor.xml");
    wait_for_tanaka(gateway);
    auto const text =
        printed_by("ROIS_URL=" + gateway.url() + " " ROIS_SOURCE_DIR "/docs/examples/reception.sh 1 2>&1 >/dev/null");
    auto seen = steps(text);
    std::erase_if(seen,
                  [](auto const& step) { return step.ends_with("now; going on."); });  // the sensor may miss the visitor once
    EXPECT_THAT(seen, ElementsAre("Connected to http://N.N.N.N:N; the robot stands at N, N, N.", "Waiting for somebody to come.",
                                  "There is somebody: N person(s).", HasSubstr("(mm, mm, degree); going there."),
                                  "Arrived at person-N.", "This is tanaka.", "Robot: \"Mr. Tanaka, your meeting is in room N.\"",
                                  "The robot bows.", "Robot: \"Goodbye.\"", "Going back to the start."))
        << text;
}

// The visitor enters after the start of the script, and walks on after being seen.
TEST(TheReceptionScript, WaitsUntilAVisitorStands) {
    GatewayProcess const gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml", "--sim-speed", "2", "--seed", "7"}};
    auto const text =
        printed_by("ROIS_URL=" + gateway.url() + "/ " ROIS_SOURCE_DIR "/docs/examples/reception.sh 2>&1 >/dev/null");
    EXPECT_THAT(steps(text), IsSupersetOf({HasSubstr("Arrived at person-N."), HasSubstr("This is tanaka.")})) << text;
    EXPECT_THAT(text, Not(HasSubstr("//rois"))) << "a slash at the end of ROIS_URL does no harm";
}

TEST(TheReceptionScript, PrintsItsUsageAndRejectsInvalidArguments) {
    std::string const script = ROIS_SOURCE_DIR "/docs/examples/reception.sh ";
    EXPECT_THAT(printed_by(script + "-h"), StartsWith("use: reception.sh [VISITORS]"));
    for (auto const* bad : {"abc", "0", "-1", "''", "99999999", "1.5"}) {
        auto const text = printed_by(script + bad + " 2>&1 >&-; test $? -eq 2");
        EXPECT_THAT(text, StartsWith("reception.sh: VISITORS is a whole number")) << bad;
        EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
    }
}

}  // namespace
}  // namespace rois::test
