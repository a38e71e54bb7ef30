// Steered visitors, in a hall where time passes only on request.

#include <algorithm>

#include "server/conversation.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::MatchesRegex;
using testing::Not;
using testing::SizeIs;

constexpr auto nobody = ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml";

Command steer(std::string const& type, std::vector<Argument> arguments, std::string const& id = "") {
    return {.component = "simulated_hall", .type = type, .id = id, .arguments = std::move(arguments)};
}
Argument who(std::string const& visitor) { return {"visitor_ref", "string", {visitor}}; }
Command enter(std::string const& visitor, std::string const& known = "true") {
    return steer("enter", {who(visitor), {"known", "bool", {known}}});
}
Command walk(std::string const& visitor, std::string const& to) { return steer("walk", {who(visitor), target_position({to})}); }
Command say(std::string const& visitor, std::string const& text) {
    return steer("say", {who(visitor), {"text", "string", {text}}});
}
Command let_pass(int milliseconds, std::string const& id = "") {
    return steer("let_pass", {{"time", "int", {std::to_string(milliseconds)}}}, id);
}

class StillHall : public testing::TestWithParam<Transport> {
protected:
    StillHall() {
        desk.connect();
        for (auto const* component : {"simulated_hall", "navigation", "person_identification", "speech_recognition",
                                      "gesture_recognition", "speech_synthesis", "person_localization"})
            desk.bind(component);
    }

    // Runs these units while this time passes. Returns the notifications until then.
    std::vector<Document> run(std::vector<Command> const& commands, int milliseconds) {
        auto const before = desk.history().size();
        for (auto const& command : commands) EXPECT_THAT(desk.execute(command), IsOk());
        auto const pass = "pass-" + std::to_string(++passes_);
        EXPECT_THAT(desk.execute(let_pass(milliseconds, pass)), IsOk());
        EXPECT_EQ(desk.status_of(pass), "OK");
        auto const& history = desk.history();
        return {history.begin() + static_cast<std::ptrdiff_t>(before), history.end()};
    }

    GatewayProcess gateway{{"--scenario", nobody, "--sim-speed", "0", "--seed", "1"}};
    Application desk{GetParam(), gateway};

private:
    int passes_ = 0;
};
ROIS_OVER_BOTH_WAYS(StillHall);

TEST_P(StillHall, MovesOnlyWhileTimePasses) {
    EXPECT_EQ(desk.query("component_status", where(equal("component_ref", "navigation"))).values()["status"].front(), "READY");
    auto const start = desk.query("robot_position").values()["position_data"];
    Command const go{.component = "navigation", .id = "go", .arguments = {target_position({"7000, 6000"})}};
    EXPECT_THAT(desk.execute(go), IsOk());
    EXPECT_EQ(desk.query("robot_position").values()["position_data"], start);
    EXPECT_EQ(desk.get_command_result("go").values()["status"].front(), "RUNNING");
    run({}, 1'000);
    EXPECT_EQ(desk.get_command_result("go").values()["status"].front(), "RUNNING");
    EXPECT_NE(desk.query("robot_position").values()["position_data"], start);
    run({}, 5'000);
    EXPECT_EQ(desk.get_command_result("go").values()["status"].front(), "OK");
}

TEST_P(StillHall, TheRobotIdentifiesAndUnderstandsSteeredVisitors) {
    for (auto const* event : {"person_identified", "speech_recognized", "gesture_recognized"}) desk.subscribe(event, {}, true);
    run({{.component = "person_identification"},
         {.component = "speech_recognition"},
         {.component = "gesture_recognition"},
         enter("anna")},
        20);
    EXPECT_EQ(desk.query("visitors").values()["visitor_ref"], std::vector<std::string>{"anna"});
    EXPECT_THAT(lines(run({walk("anna", "7500, 6000, 180")}, 10'000)), Contains("person_identified"));
    auto const notifications =
        run({say("anna", "Good morning."), steer("gesture", {who("anna"), {"gesture", "string", {"wave"}}})}, 3'000);
    EXPECT_THAT(lines(notifications), Contains("speech_recognized"));
    EXPECT_THAT(lines(notifications), Contains("gesture_recognized"));
    auto const recognized =
        std::ranges::find(notifications, "speech_recognized", [](auto const& one) { return one.text("event_type"); });
    ASSERT_NE(recognized, notifications.end());
    EXPECT_EQ(recognized->values()["recognized_text"], std::vector<std::string>{"Good morning."});
    run({steer("leave", {who("anna")})}, 30'000);
    EXPECT_THAT(desk.query("visitors").values()["visitor_ref"], IsEmpty());
}

TEST_P(StillHall, StandsStillWhenTheSessionEnds) {
    run({enter("anna")}, 20);
    EXPECT_THAT(desk.execute(walk("anna", "cloakroom")), IsOk());
    EXPECT_THAT(desk.execute(let_pass(3'600'000)), IsOk());
    desk.disconnect();
    Application other{GetParam(), gateway};
    other.connect();
    auto const where = [&] { return other.query("visitors").values()["position_data"]; };
    auto const here = where();
    EXPECT_THAT(here, SizeIs(1));
    other.bind("simulated_hall");
    other.execute(let_pass(2'000, "pass"));
    EXPECT_EQ(other.status_of("pass"), "OK");
    EXPECT_EQ(where(), here) << "the visitor does not walk on";
    EXPECT_THAT(HttpClient{gateway}.get("/metrics").body, HasSubstr("rois_stray_component_answers_total 0\n"));
}

TEST(Gateway, IsReadyOnlyWhenAllComponentsHaveHalted) {
    GatewayProcess gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--sim-speed", "0"}};
    HttpClient watching{gateway};
    auto const not_ready = watching.get("/readyz");
    EXPECT_EQ(not_ready.status, 503);
    EXPECT_EQ(not_ready.body, "navigation has not confirmed that it stands still\n");
    Application desk{Transport::websocket, gateway};
    desk.connect();
    EXPECT_THAT(desk.bind("simulated_hall"), IsOk());
    desk.execute(let_pass(1'000, "pass"));
    EXPECT_EQ(desk.status_of("pass"), "OK");
    while (watching.get("/readyz").status != 200) {
    }
    EXPECT_THAT(desk.bind("navigation"), IsOk());
}

// Returns the words that the robot recognized and its position, after the same commands at the same world times.
std::vector<std::string> story(std::vector<int> const& passes) {
    GatewayProcess gateway{{"--sim-speed", "0", "--seed", "5"}};
    Application desk{Transport::websocket, gateway};
    desk.connect();
    for (auto const* component : {"simulated_hall", "navigation", "speech_synthesis", "person_localization"})
        desk.bind(component);
    desk.subscribe("person_localized", {}, true);
    desk.execute({.component = "person_localization"});
    desk.execute(sequential_unit(unit({.component = "navigation", .arguments = {target_position({"9000, 5000", "start"})}}) +
                                 unit({.component = "speech_synthesis", .arguments = {speech_text("Here I am.")}}) +
                                 unit({.component = "navigation", .arguments = {target_position({"desk"})}})));
    desk.execute(sequential_unit(unit(enter("anna")) + unit(walk("anna", "11000, 6000, 180")) + unit(say("anna", "Hello."))));
    int pass = 0;
    for (auto const time : passes) {
        desk.execute(let_pass(time, "pass-" + std::to_string(++pass)));
        desk.status_of("pass-" + std::to_string(pass));
    }
    std::vector<std::string> positions{desk.query("robot_position").values()["position_data"].front()};
    for (auto const& news : desk.history())
        if (news.text("event_type") == "person_localized")
            positions.push_back(testing::PrintToString(news.values()["position_data"]));
    auto const truth = desk.query("visitors").values()["position_data"];
    positions.insert(positions.end(), truth.begin(), truth.end());
    return positions;
}

TEST(StillHallHistory, DoesNotDependOnTheSizeOfTheTimeSteps) {
    auto const at_once = story({40'000});
    EXPECT_THAT(at_once, SizeIs(testing::Gt(10U)));
    EXPECT_EQ(story({20, 980, 19'000, 60, 19'940}), at_once);
}

// A hall in real time has the component only with the setting.
TEST(Steering, IsAvailableOnlyOnRequest) {
    GatewayProcess plain{{"--scenario", nobody}}, asked{{"--scenario", nobody, "--steering", "on", "--sim-speed", "20"}};
    Application guest{Transport::http, plain}, desk{Transport::http, asked};
    guest.connect();
    EXPECT_THAT(guest.search(), AllOf(SizeIs(15), Not(Contains("simulated_hall"))));
    desk.connect();
    EXPECT_THAT(desk.search(), AllOf(SizeIs(16), Contains("simulated_hall")));
    EXPECT_THAT(HttpClient{asked}.get("/rois/profile/simulated_hall").body,
                HasSubstr("urn:x-rois:def:component:simulation::Hall"));
    desk.bind("simulated_hall");
    EXPECT_THAT(desk.execute(let_pass(20)), IsRefused("BAD_PARAMETER", "let_pass needs --sim-speed 0"));
    auto comes = enter("anna");
    comes.id = "come";
    desk.execute(comes);
    EXPECT_EQ(desk.status_of("come"), "OK");
    auto leaves = steer("leave", {who("anna")}, "go");
    desk.execute(leaves);
    EXPECT_EQ(desk.status_of("go"), "OK");
    EXPECT_THAT(desk.query("visitors").values()["visitor_ref"], IsEmpty());
}

// A position may be given in the frame of a robot's own map.
TEST(Steering, TakesPositionsInEveryFrame) {
    GatewayProcess gateway{
        {"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml", "--scenario", nobody, "--sim-speed", "0"}};
    Application desk{Transport::http, gateway};
    desk.connect();
    EXPECT_THAT(desk.search(), AllOf(SizeIs(31), Not(Contains("robot2.simulated_hall"))));
    desk.bind("simulated_hall");
    desk.execute(enter("anna"));
    desk.execute(let_pass(20, "in"));
    desk.status_of("in");
    auto const target =
        element("rois:parameter", {{"rois:name", "target_position"}},
                element("rois:data_type_ref",
                        {{"rois:code", "string[]"}, {"rois:codebook_ref", "urn:x-rois:def:crs:simulation::robot2_map"}}) +
                    text_element("rois:value", "3000, 8000, 90"));
    auto const visitor = element("rois:parameter", {{"rois:name", "visitor_ref"}},
                                 element("rois:data_type_ref", {{"rois:code", "string"}}) + text_element("rois:value", "anna"));
    desk.execute(element(
        "rois:command_unit_list",
        {{"xsi:type", "rois:CommandMessageType"}, {"rois:command_type", "walk"}, {"rois:command_id", "go"}},
        element("rois:component_ref", {{"rois:code", "simulated_hall"}}) + element("rois:arguments", {}, visitor + target)));
    desk.execute(let_pass(30'000, "walked"));
    desk.status_of("walked");
    EXPECT_THAT(desk.query("visitors").values()["position_data"].front(),
                MatchesRegex("(119|120)[0-9]{2}, (29|30)[0-9]{2}, 180"));
}

}  // namespace
}  // namespace rois::test
