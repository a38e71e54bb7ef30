// Every rule that is broken on purpose is found by rois-conformance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "broken/breaking.hpp"
#include "broken/judging.hpp"
#include "broken/proxy.hpp"
#include "broken/rules.hpp"

namespace rois::broken {
namespace {

TEST(Conformance, BrokenRulesAreManyAndNamedOnce) {
    std::set<std::string> names;
    for (auto const part : all_parts)
        for (auto const& rule : part.rules()) EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_GE(names.size(), 20u);
}

Judged judge_broken(BrokenRule const& rule) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), rule.breaking};
    std::string const over = rule.over == Over::http ? "http" : "websocket";
    return judge(url(proxy.port()) + " --patience 2 --limit 90 --over " + over);
}

// Four at a time: they wait for most of it.
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
