// `rois scenario`.
#include "command/rois_fixture.hpp"

namespace rois::test {
namespace {

constexpr auto reception = ROIS_SOURCE_DIR "/client-cpp/scenarios/reception.xml";

// Returns the printed texts of a scenario, without its transitions.
std::vector<std::string> said_in(std::string const& out) {
    auto lines = lines_of(out);
    std::erase_if(lines, [](std::string const& line) { return line.find(" -> ") != std::string::npos; });
    return lines;
}

// The times are long enough for a busy machine, so that they end only for the unknown visitor.
TEST(TheReceptionAsAScenario, ReceivesThreeVisitorsAndIsReplayed) {
    std::string const data = ROIS_SOURCE_DIR "/tests/server/data/";
    GatewayProcess const gateway{{"--floor-plan", data + "watchful_hall.xml", "--scenario", data + "three_visitors.xml",
                                  "--sim-speed", "20", "--seed", "7"}};
    auto const file = file_named("reception.jsonl");
    std::vector<std::string> const scenario{"scenario", reception, "visitors=3", "identifying=5"};
    auto recorded = scenario;
    recorded.insert(recorded.end(), {"--record", file});
    auto const live = run_rois(recorded, {}, {{"ROIS_URL", gateway.url()}});
    ASSERT_EQ(live.exit_code, 0) << live.error << live.out;
    EXPECT_THAT(said_in(live.out),
                testing::UnorderedElementsAre("tanaka: told \"Mr. Tanaka, your meeting is in room 3.\"",
                                              "suzuki: told \"Ms. Suzuki, your taxi is waiting at the entrance.\"",
                                              "somebody: told \"Welcome. How can I help you?\", heard \"I have an appointment.\"",
                                              "visitors received: 3"))
        << live.out;
    RoisProcess engine{{"replay", file, "--listen", "127.0.0.1:0", "--json"}};
    auto const again = run_rois(scenario, {}, {{"ROIS_URL", json::parse(engine.line())["listening"]}});
    EXPECT_EQ(again.exit_code, 0) << "without a robot: " << again.error << again.out;
    EXPECT_EQ(said_in(again.out), said_in(live.out)) << again.out << live.out;
}

std::string scenario_with(std::string const& states, std::string const& start = "a") {
    return file_with("scenario.xml", "<robot_scenario xmlns='urn:x-rois:scenario:1' start='" + start +
                                         "'>\n<component name='move'/>\n<variable name='x'/>\n" + states +
                                         "\n</robot_scenario>\n");
}

TEST_F(Rois, ReportsEachTransitionOfAScenario) {
    auto const file = scenario_with(
        "<state name='a'><command component='move' type='stop'/><completed status='OK' to='b'/></state>"
        "<end name='b' failed='true'><print>x is {x}</print></end>");
    auto const ended = run({"scenario", file, "x=1", "--json"});
    EXPECT_EQ(ended.exit_code, 1) << "failed";
    auto const lines = lines_of(ended.out);
    ASSERT_EQ(lines.size(), 2u) << ended.out << ended.error;
    auto const transition = json::parse(lines[0]);
    EXPECT_EQ(transition["from"], "a");
    EXPECT_EQ(transition["to"], "b");
    EXPECT_EQ(transition["by"], "completed OK");
    EXPECT_EQ(lines[1], "{\"print\":\"x is 1\"}");
}

TEST_F(Rois, ChecksAScenarioAndItsVariables) {
    auto const file = scenario_with("<state name='a'/><end name='b'/>");
    expect(2, file + ":4:1: this state has no trigger", {"scenario", "--check", file});
    EXPECT_EQ(run({"scenario", "--check", reception}).out, "scenario ok\n");
    expect(2, "no variable 'guests'", {"scenario", reception, "guests=2"});
    expect(2, "robot_scenario", {"scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml"});
}

TEST_F(Rois, ReportsWhyTheCommandsOfAScenarioFailed) {
    auto const file = scenario_with(
        "<state name='a'><command component='move' type='resume'/><completed status='OK' to='b'/></state><end name='b'/>");
    expect(1, "ended with ERROR, and no trigger expects that: ", {"scenario", file});
}

}  // namespace
}  // namespace rois::test
