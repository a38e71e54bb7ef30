// rois-conformance finds no broken rule in correct gateways that differ from ours: three variants of our gateway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "broken/judging.hpp"
#include "broken/proxy.hpp"
#include "broken/rules.hpp"
#include "broken/variants.hpp"

namespace rois::broken {
namespace {

std::string const data = ROIS_SOURCE_DIR "/tests/broken/data/";

void expect_whole(Judged const& judged, std::vector<std::string> const& held) {
    EXPECT_EQ(judged.exit_code, 0) << judged;
    for (auto const& check : held) EXPECT_THAT(held_in(judged.text), testing::Contains(check)) << judged.text;
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithMandatoryPartsOnly) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), has_mandatory_parts_only};
    expect_whole(judge(url(proxy.port())),
                 {"basic_components_have_their_parameters", "navigation_reaches_its_target",
                  "set_parameter_completes_once_and_stores_the_value", "suspended_speech_completes_after_resume",
                  "move_follows_its_line", "every_component_starts_and_stops"});
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithMandatoryPartsOnlyAmongPeople) {
    auto const [settings, options] = settings_of(World::visitor);
    EmptyHall gateway{settings};
    Proxy const proxy{gateway.port(), has_mandatory_parts_only};
    expect_whole(judge(url(proxy.port()) + options + " --over websocket --only follow"), {"follow_keeps_its_distance"});
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithOtherNames) {
    EmptyHall gateway{{"--engine-name", "Empfang-7", "--floor-plan", data + "other_names.xml"}};
    Proxy const with_names{gateway.port(), [] { return has_names(other_component_names()); }};
    Proxy const with_ids{with_names.port(), has_other_ids};
    std::vector<std::string> const held{"like_supports_wildcards", "engine_selects_components", "navigation_reaches_its_target"};
    expect_whole(judge(url(with_names.port()) + " --over http"), held);
    expect_whole(judge(url(with_ids.port()) + " --over websocket"), held);
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithSubEngines) {
    EmptyHall gateway{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml"}};
    auto names = component_names("", "building.ground_floor.robot1.");
    names.merge(component_names("robot2.", "building.robot2."));
    names.merge(Names{{"robot1", "building.ground_floor.robot1"}, {"robot2", "building.robot2"}});
    Proxy const proxy{gateway.port(), [&] { return has_nested_engines(names); }};
    expect_whole(judge(url(proxy.port()) + " --room 600"),
                 {"engine_selects_components", "engine_selects_profiles", "engine_selects_the_robot", "robots_move_independently",
                  "bind_any_prefers_a_free_component"});
}

}  // namespace
}  // namespace rois::broken
