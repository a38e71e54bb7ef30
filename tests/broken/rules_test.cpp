// rois-conformance detects every rule that is broken on purpose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "broken/breaking.hpp"
#include "broken/judging.hpp"
#include "broken/proxy.hpp"
#include "broken/rules.hpp"

namespace rois::broken {
namespace {

TEST(BrokenRules, AreManyAndHaveUniqueNames) {
    std::set<std::string> names;
    for (auto const part : all_parts)
        for (auto const& rule : part.rules()) EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_GE(names.size(), 206u);
}

// Runs the check that must find the broken rule; all checks if the rule applies to all messages.
Judged judge_broken(BrokenRule const& rule) {
    constexpr int no_such_check = 2;
    auto [for_gateway, for_judge] = settings_of(rule.world);
    std::optional<EmptyHall> hall;
    std::optional<Team> team;
    if (rule.world == World::team) {
        team.emplace();
        for_judge += " --disturb " + team->disturbance();
    } else {
        hall.emplace(for_gateway);
    }
    Proxy const proxy{team ? team->port() : hall->port(), rule.breaking};
    std::string const over = rule.over == Over::http ? "http" : "websocket";
    auto const order = url(proxy.port()) + " --patience 2 --limit 90 --over " + over + for_judge;
    auto const judged = judge(order + " --only " + rule.found_by);
    return judged.exit_code == no_such_check ? judge(order) : judged;
}

// Runs four checks at a time: they mostly wait.
std::vector<Judged> judge_all(std::vector<BrokenRule> const& rules) {
    std::vector<Judged> judged(rules.size());
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> judges;
    for (int i = 0; i < 4; ++i)
        judges.emplace_back([&] {
            for (auto n = next++; n < rules.size(); n = next++) judged[n] = judge_broken(rules[n]);
        });
    for (auto& one : judges) one.join();
    return judged;
}

// Without a broken rule, each check passes in its world: so a failure comes from the broken rule.
TEST(BrokenRules, AreObservableInTheirWorlds) {
    std::map<std::pair<World, std::string>, BrokenRule> unbroken;
    for (auto const part : all_parts)
        for (auto const& rule : part.rules())
            if (rule.world != World::empty_hall)
                unbroken.try_emplace({rule.world, rule.found_by},
                                     BrokenRule{"nothing", rule.found_by, [] { return Breaking{}; }, rule.over, rule.world});
    std::vector<BrokenRule> rules;
    for (auto const& [where, rule] : unbroken) rules.push_back(rule);
    auto const judged = judge_all(rules);
    for (std::size_t i = 0; i < rules.size(); ++i) {
        EXPECT_EQ(judged[i].exit_code, 0) << judged[i].text;
        EXPECT_THAT(held_in(judged[i].text), testing::Contains(rules[i].found_by)) << judged[i].text;
    }
}

struct Broken : testing::TestWithParam<Part> {};

TEST_P(Broken, RulesAreFound) {
    auto const rules = GetParam().rules();
    auto const judged = judge_all(rules);
    for (std::size_t i = 0; i < rules.size(); ++i) {
        SCOPED_TRACE(rules[i].name);
        EXPECT_EQ(judged[i].exit_code, 1) << judged[i].text;
        EXPECT_THAT(broken_in(judged[i].text), testing::Contains(rules[i].found_by)) << judged[i].text;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Broken, testing::ValuesIn(all_parts), testing::PrintToStringParamName());

}  // namespace
}  // namespace rois::broken
