// The proof of the proof: rois-conformance finds nothing wrong with our gateway, and finds every rule that is broken on purpose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <thread>

#include "broken/rules.hpp"
#include "server/gateway_process.hpp"

namespace rois::broken {
namespace {

using test::GatewayProcess;

struct Judged {
    int exit_code = -1;
    std::string text{};
};

// Runs rois-conformance with these arguments.
Judged judge(std::string const& arguments) {
    auto const command = ROIS_BINARY_DIR "/bin/rois-conformance " + arguments + " 2>&1";
    auto* const program = popen(command.c_str(), "r");
    Judged judged;
    if (program == nullptr) return judged;
    std::array<char, 4096> buffer;
    while (auto const size = fread(buffer.data(), 1, buffer.size(), program)) judged.text.append(buffer.data(), size);
    auto const status = pclose(program);
    judged.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return judged;
}

// The names of the checks that found a broken rule.
std::set<std::string> broken_in(std::string const& report) {
    static std::string const mark = "\n  BROKEN     ";
    std::set<std::string> names;
    for (auto at = report.find(mark); at != std::string::npos; at = report.find(mark, at + 1)) {
        auto const begin = at + mark.size();
        names.insert(report.substr(begin, report.find(' ', begin) - begin));
    }
    return names;
}

struct EmptyHall : GatewayProcess {
    EmptyHall()
        : GatewayProcess{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20", "--seed", "1",
                          "--media", "127.0.0.1:0"}} {}
};

std::string url(std::uint16_t port) { return "http://127.0.0.1:" + std::to_string(port); }

TEST(Conformance, OfOurGatewayIsWhole) {
    EmptyHall gateway;
    auto const file = testing::TempDir() + "rois-conformance-" + std::to_string(getpid()) + ".xml";
    auto const judged = judge(url(gateway.port()) + " --report " + file);
    EXPECT_EQ(judged.exit_code, 0) << judged.text;
    EXPECT_THAT(judged.text, testing::HasSubstr(", 0 found a broken rule, "));
    pugi::xml_document report;
    ASSERT_TRUE(report.load_file(file.c_str())) << file;
    EXPECT_GE(report.select_nodes("//testcase").size(), 200u);
    EXPECT_TRUE(report.select_nodes("//failure").empty());
    std::filesystem::remove(file);
}

TEST(Conformance, OfAGatewayInUseFindsNothingElse) {
    EmptyHall gateway;
    auto const again = [&] { return judge(url(gateway.port()) + " --over websocket"); };
    EXPECT_EQ(again().exit_code, 0);
    auto const second = again(), third = again();
    EXPECT_EQ(second.exit_code, 0) << second.text;
    EXPECT_EQ(second.text, third.text) << "it leaves nothing behind but the parameters that it has set";
}

TEST(Conformance, NeedsAGateway) {
    EXPECT_EQ(judge("").exit_code, 2);
    EXPECT_EQ(judge("http://127.0.0.1:1").exit_code, 2);
    EXPECT_EQ(judge("ftp://127.0.0.1").exit_code, 2);
    EXPECT_EQ(judge("http://127.0.0.1:1 --patience soon").exit_code, 2);
    EXPECT_EQ(judge("--help").exit_code, 0);
}

// A proxy that breaks nothing is found whole: what is found below is the broken rule's doing.
TEST(Conformance, OfAProxyThatBreaksNothingIsWhole) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), [] { return Breaking{}; }};
    auto const judged = judge(url(proxy.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged.text;
}

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
