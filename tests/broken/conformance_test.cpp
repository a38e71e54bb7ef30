// rois-conformance finds no broken rule in our gateway, with any settings. rules_test.cpp tests that it detects broken rules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

#include "broken/breaking.hpp"
#include "broken/judging.hpp"
#include "broken/proxy.hpp"
#include "broken/variants.hpp"
#include "kit/gateway_process.hpp"
#include "kit/profile_folder.hpp"

namespace rois::broken {
namespace {

std::string const common = "<rois:SubComponentProfile>urn:x-rois:def:component:OMG::RoISCommon</rois:SubComponentProfile>";

TEST(Conformance, FindsNoBrokenRuleInOurGateway) {
    EmptyHall gateway;
    auto const file = testing::TempDir() + "rois-conformance-" + std::to_string(getpid()) + ".xml";
    auto const judged = judge(url(gateway.port()) + " --report " + file);
    EXPECT_EQ(judged.exit_code, 0) << judged;
    EXPECT_NE(judged.text.find(", 0 found a broken rule, "), std::string::npos) << judged;
    pugi::xml_document report;
    ASSERT_TRUE(report.load_file(file.c_str())) << file;
    EXPECT_GE(report.select_nodes("//testcase").size(), 200u);
    EXPECT_TRUE(report.select_nodes("//failure").empty());
    // Ignores skipped checks of effects: at this speed, some effects are too fast to be observed. rules_test.cpp runs each of
    // these checks in a suitable world. The gateway has no logical components.
    std::vector<std::string> skipped;
    for (auto const& one : report.select_nodes("//testcase[skipped][not(starts-with(@classname, 'Effects'))]"
                                               "[not(contains(@classname, 'choosing and switching'))]"))
        skipped.emplace_back(one.node().attribute("name").value());
    EXPECT_THAT(skipped, testing::ElementsAre("errors_have_details")) << "no component fails here";
    std::filesystem::remove(file);
}

TEST(Conformance, FindsNoBrokenRuleWithFullValidation) {
    EmptyHall gateway{{"--validation", "full"}};
    auto const judged = judge(url(gateway.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

// The check must use the position of each robot itself: a drive to the position of the other robot exceeds this patience.
TEST(Conformance, FindsNoBrokenRuleWithTwoRobots) {
    EmptyHall gateway{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml", "--sim-speed", "2"}};
    auto const judged = judge(url(gateway.port()) + " --patience 3 --room 0");
    EXPECT_EQ(judged.exit_code, 0) << judged;
    EXPECT_THAT(judged.text, testing::HasSubstr("  holds          events_of_an_action_precede_its_completion over HTTP "));
}

// An engine without components of its own, above another one.
class Above {
public:
    explicit Above(std::uint16_t below) : gateway_{{"--robots", "none", "--engines", engines(below), "--sim-speed", "20"}} {
        EXPECT_THAT(gateway_.log_with("present with 17"), testing::HasSubstr("present with 17"));
    }
    std::uint16_t port() const { return gateway_.port(); }

private:
    std::string engines(std::uint16_t below) const {
        folder_.put("engines.json", R"({"engines": [{"name": "below", "url": ")" + url(below) + R"("}]})");
        return folder_.name() + "/engines.json";
    }

    kit::ProfileFolder folder_;
    kit::GatewayProcess gateway_;
};

// An engine without components of its own. The engine below joins it.
class Joined {
public:
    explicit Joined(std::vector<std::string> const& more = {}) : gateway_{arguments(more)} {}
    std::uint16_t port() const { return gateway_.port(); }
    std::vector<std::string> joining() const { return {"--join", gateway_.url(), "--join-as", "below"}; }
    void await() { EXPECT_THAT(gateway_.log_with("present with 17"), testing::HasSubstr("present with 17")); }

private:
    std::string engines() const {
        folder_.put("engines.json", R"({"engines": [{"name": "below", "joins": "below"}]})");
        return folder_.name() + "/engines.json";
    }

    std::vector<std::string> arguments(std::vector<std::string> const& more) const {
        std::vector<std::string> all{"--robots", "none", "--engines", engines(), "--sim-speed", "20"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    kit::ProfileFolder folder_;
    kit::GatewayProcess gateway_;
};

// An engine above others ends before them, because only they can confirm that their components stand still.
TEST(Conformance, FindsNoBrokenRuleThroughAJoinedEngine) {
    std::optional<EmptyHall> hall;
    Joined above;
    hall.emplace(above.joining());
    above.await();
    auto const judged = judge(url(above.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleThroughThreeJoinedLevels) {
    std::optional<EmptyHall> hall;
    std::optional<Joined> first, second;
    Joined third;
    second.emplace(third.joining());
    first.emplace(second->joining());
    hall.emplace(first->joining());
    third.await();
    auto const judged = judge(url(third.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleThroughASubEngine) {
    EmptyHall hall;
    Above const above{hall.port()};
    auto const judged = judge(url(above.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleThroughThreeLevels) {
    EmptyHall hall;
    Above const first{hall.port()};
    Above const second{first.port()};
    Above const third{second.port()};
    auto const judged = judge(url(third.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleWithComponentsOfAUser) {
    kit::ProfileFolder const folder;
    auto const put = [&](std::string const& name, std::string const& adapter, std::string const& inside) {
        auto const adapter_property =
            R"(<gml:metaDataProperty xlink:href="urn:x-rois:def:adapter:simulation::)" + adapter + R"("/>)";
        folder.put(name + ".xml", kit::profile_document("urn:x:" + name, inside, adapter_property));
    };
    put("lists", "stand_in",
        common + R"(<rois:ParameterProfile rois:name="v" rois:default_value="1 2">)"
                 R"(<rois:data_type_ref rois:code="Set&lt;Integer>"/></rois:ParameterProfile>)");
    put("named", "stand_in", "<gml:name>ランプ</gml:name>" + common);
    put("plain", "speech_synthesis", common);
    EmptyHall gateway{{"--profiles", folder.name()}};
    auto const judged = judge(url(gateway.port()) + " --over http");
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

std::string typed(std::string const& element, std::string const& name, std::string const& type, std::string const& more = "") {
    return "<rois:" + element + " rois:name=\"" + name + "\" " + more + "><rois:data_type_ref rois:code=\"" + type +
           "\"/></rois:" + element + ">";
}

std::string message(std::string const& kind, std::string const& name, std::string const& inside) {
    return "<rois:MessageProfile xsi:type=\"rois:" + kind + "MessageProfileType\" rois:name=\"" + name + "\">" + inside +
           "</rois:MessageProfile>";
}

std::string with_default(std::string const& value) { return "rois:default_value=\"" + value + "\""; }

// A user's component with any name.
struct Strange {
    std::string urn, name, inside;
    std::string adapter = "stand_in";
};

Judged judge_with(std::vector<Strange> const& components) {
    kit::ProfileFolder const folder;
    int files = 0;
    for (auto const& [urn, name, inside, adapter] : components)
        folder.put(std::to_string(++files) + ".xml",
                   kit::profile_document(
                       urn, (name.empty() ? "" : "<gml:name>" + name + "</gml:name>") + common + inside,
                       R"(<gml:metaDataProperty xlink:href="urn:x-rois:def:adapter:simulation::)" + adapter + R"("/>)"));
    EmptyHall gateway{{"--profiles", folder.name()}};
    auto judged = judge(url(gateway.port()) + " --over http");
    EXPECT_THAT(judged.text, testing::HasSubstr(", " + std::to_string(17 + components.size()) + " components\n"));
    return judged;
}

TEST(Conformance, FindsNoBrokenRuleWithAnyComponentNames) {
    auto const judged =
        judge_with({{"urn:x:a&amp;b", "amp", ""},
                    {"urn:x:quoted", "a&quot;b'c&lt;d", ""},
                    {"urn:x:face", "😀", ""},
                    {"urn:x:star", "*·", ""},
                    {"urn:x:escaped_face", "_xF0__x9F__x98__x80_", ""},
                    {"urn:x:events", "", message("Event", "a&amp;b", typed("Results", "n", "int"))},
                    {"urn:x:queries", "", message("Query", "a&lt;b", typed("Results", "n", "int", with_default("1")))},
                    {"urn:x:lines", "", typed("ParameterProfile", "text", "string", with_default("one&#13;&#10;two"))},
                    {"urn:x:names", "", typed("ParameterProfile", "te&#10;xt", "string", with_default(" one "))}});
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleWithAnyEvents) {
    auto const judged = judge_with(
        {{"urn:x:forms", "",
          typed("ParameterProfile", "i", "int", with_default("&#10; 000000000060 ")) +
              typed("ParameterProfile", "b", "bool", with_default(" true ")) +
              typed("ParameterProfile", "d", "double", with_default(" 1e3 ")) +
              typed("ParameterProfile", "s", "Component_Status", with_default(" READY ")) +
              typed("ParameterProfile", "t", "DateTime", with_default("2026-11-20T12:00:00+01:00")) +
              typed("ParameterProfile", "l", "DateTime[]", with_default("2026-11-20T12:00:00+01:00 2026-11-20T12:00:00Z"))},
         {"urn:x:shines", "",
          "<rois:SubComponentProfile>urn:x-rois:def:component:OMG::SpeechSynthesis</rois:SubComponentProfile>" +
              message("Command", "set_parameter", typed("Arguments", "brightness", "int", with_default("1")))},
         {"urn:x:silent", "", message("Query", "ping", "")},
         {"urn:x:shy", "", message("Query", "peep", typed("Results", "n", "int"))},
         {"urn:x:reads", "", message("Query", "get_parameter", typed("Results", "n", "int", with_default("7")))},
         {"urn:x:asks", "",
          message("Command", "start", typed("Arguments", "must", "int")) +
              message("Command", "stop", typed("Arguments", "how", "int"))},
         {"urn:x:voice", "", typed("ParameterProfile", "synthesizable_languages", "string[]", with_default("ja")),
          "speech_synthesis"},
         {"urn:x:wrong", "", message("Query", "get_parameter", typed("Results", "synthesizable_languages", "int")),
          "speech_synthesis"}});
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithOtherIds) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), has_other_ids};
    auto const judged = judge(url(proxy.port()) + " --over websocket");
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleWhileAnotherApplicationUsesTheGateway) {
    EmptyHall gateway;
    auto const again = [&] { return judge(url(gateway.port()) + " --over websocket"); };
    EXPECT_EQ(again().exit_code, 0);
    auto const second = again(), third = again();
    EXPECT_EQ(second.exit_code, 0) << second.text;
    // At this speed, some effects are too fast to be observed in every run.
    auto const without_effects = [](std::string const& text) { return text.substr(0, text.find("\nEffects: ")); };
    EXPECT_EQ(without_effects(second.text), without_effects(third.text))
        << "a run changes only parameters: a second run has the same result";
}

TEST(Conformance, NeedsAGateway) {
    EXPECT_EQ(judge("").exit_code, 2);
    EXPECT_EQ(judge("http://127.0.0.1:1").exit_code, 2);
    EXPECT_EQ(judge("ftp://127.0.0.1").exit_code, 2);
    EXPECT_THAT(judge("HTTP://127.0.0.1:1").text, testing::HasSubstr("the gateway at HTTP://127.0.0.1:1 does not answer"));
    EXPECT_EQ(judge("http://127.0.0.1:1 --patience soon").exit_code, 2);
    EXPECT_EQ(judge("--help").exit_code, 0);
}

TEST(Conformance, ChecksItsOptionsBeforeItStarts) {
    EmptyHall gateway;
    auto const nothing = judge(url(gateway.port()) + " --only nothing_like_this");
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_EQ(nothing.text, "rois-conformance: no check has a name that contains 'nothing_like_this' (--only)\n");
    auto const nowhere = judge(url(gateway.port()) + " --report /nowhere/report.xml");
    EXPECT_EQ(nowhere.exit_code, 2);
    EXPECT_EQ(nowhere.text, "rois-conformance: cannot write the report to '/nowhere/report.xml' (--report)\n");
}

// All checks pass through a proxy without changes: so failures in rules_test.cpp come from the broken rule.
TEST(Conformance, FindsNoBrokenRuleThroughAnUnchangingProxy) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), [] { return Breaking{}; }};
    auto const judged = judge(url(proxy.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

// Returns the same document with other prefixes of namespaces.
std::string with_other_prefixes(std::string document) {
    static std::regex const message_name{"<(/?)([a-z]\\w*)(?=[ />])"};
    replace_all(document, "xmlns=\"urn:x-rois:psm", "xmlns:m=\"urn:x-rois:psm");
    document = std::regex_replace(document, message_name, "<$1m:$2");
    for (auto const& [prefix, other] : {std::pair<std::string, std::string>{"rois", "r"}, {"gml", "geo"}, {"xsi", "i"}}) {
        for (std::string const before : {"<", "</", " ", "\"", "xmlns:"}) {
            auto const after = before == "xmlns:" ? "=" : ":";
            replace_all(document, before + prefix + after, before + other + after);
        }
    }
    return document;
}

Breaking writes_other_prefixes() {
    return {.answer = [](std::string const&, std::string const& answer, ProxiedConnection&) -> Documents {
                return {with_other_prefixes(answer)};
            },
            .notification = [](std::string const& notification) -> Documents { return {with_other_prefixes(notification)}; },
            .http_reply =
                [](Message const& request, Message& reply) {
                    for (auto const* const documents : {"GET /rois/notifications?", "GET /rois/profile"})
                        if (request.first_line.starts_with(documents)) reply.body = with_other_prefixes(reply.body);
                }};
}

// Bodies in chunks, header fields in lower case without a space (RFC 9112, 5 and 7.1).
Breaking writes_other_http() {
    return {.http_reply = [](Message const&, Message& reply) {
        constexpr std::size_t longest_chunk = 100;
        for (auto& line : reply.headers) {
            auto const colon = line.find(": ");
            std::ranges::transform(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(colon), line.begin(),
                                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            line.erase(colon + 1, 1);
        }
        if (reply.body.empty()) return;
        reply.has_length = false;
        std::erase_if(reply.headers, [](auto const& line) { return line.starts_with("content-length"); });
        reply.headers.emplace_back("transfer-encoding:chunked\r\n");
        std::ostringstream chunks;
        for (std::size_t at = 0; at < reply.body.size(); at += longest_chunk) {
            auto const chunk = reply.body.substr(at, longest_chunk);
            chunks << std::hex << chunk.size() << "\r\n" << chunk << "\r\n";
        }
        reply.body = chunks.str() + "0\r\n\r\n";
    }};
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithOtherPrefixes) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), writes_other_prefixes};
    auto const judged = judge(url(proxy.port()));
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, FindsNoBrokenRuleInAGatewayWithOtherHttp) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), writes_other_http};
    auto const judged = judge(url(proxy.port()) + " --over http");
    EXPECT_EQ(judged.exit_code, 0) << judged;
}

TEST(Conformance, ReportsInvalidAnswersInXml) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), []() -> Breaking {
                          return {.http_reply = [](Message const&, Message& reply) {
                              replace_all(reply.body, "unknown component", "\x01nknown \xFFomponent");
                              replace_all(reply.body, "<gml:name>", "<gml:name>\x1B[31m\f\n  holds   \xC2\x9B");
                          }};
                      }};
    auto const file = testing::TempDir() + "rois-rubbish-" + std::to_string(getpid()) + ".xml";
    auto const judged = judge(url(proxy.port()) + " --over http --only bind_of_an_unknown --report " + file);
    EXPECT_EQ(judged.exit_code, 1) << judged;
    for (auto const* const bad : {"\x01", "\xFF", "\x1B", "\f", "\n  holds   \uFFFD", "\xC2\x9B"})
        EXPECT_THAT(judged.text, testing::Not(testing::HasSubstr(bad)));
    std::ostringstream text;
    text << std::ifstream{file}.rdbuf();
    EXPECT_THAT(text.str(), testing::HasSubstr("<failure"));
    EXPECT_THAT(text.str(), testing::Not(testing::AnyOf(testing::HasSubstr("&#"), testing::HasSubstr("\xFF"))));
    std::filesystem::remove(file);
}

TEST(Conformance, ReportsAGatewayThatOpensNoSessionInXml) {
    EmptyHall gateway;
    Proxy const proxy{gateway.port(), []() -> Breaking {
                          return {.http_reply = [](Message const&, Message& reply) {
                              replace_all(reply.body, "return_code=\"OK\"", "return_code=\"\x1B[31m\fNO\"");
                          }};
                      }};
    auto const file = testing::TempDir() + "rois-no-session-" + std::to_string(getpid()) + ".xml";
    auto const judged = judge(url(proxy.port()) + " --report " + file);
    EXPECT_EQ(judged.exit_code, 2) << judged;
    EXPECT_THAT(judged.text, testing::Not(testing::AnyOf(testing::HasSubstr("\x1B"), testing::HasSubstr("\f"))));
    pugi::xml_document report;
    ASSERT_TRUE(report.load_file(file.c_str())) << file;
    EXPECT_THAT(report.select_node("//testcase/error").node().attribute("message").value(), testing::HasSubstr("connect failed"));
    std::filesystem::remove(file);
}

// Another application binds each component as soon as it is free.
TEST(Conformance, SkipsChecksOfComponentsInUse) {
    EmptyHall gateway;
    auto const is_taken = std::make_shared<std::atomic<bool>>(false);
    Proxy const proxy{
        gateway.port(), [=]() -> Breaking {
            return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
                if (is(request, "release") || is(request, "disconnect")) *is_taken = true;
                if (is(request, "bind") && is_taken->exchange(false))
                    return {response(request, "OUT_OF_RESOURCES", "<reason>another application</reason>")};
                return {answer};
            }};
        }};
    for (auto const* const check : {"disconnect_releases_components", "disconnect_stops_running_commands",
                                    "commands_are_refused_after_release", "release_stops_the_running_command", "follow_"}) {
        *is_taken = false;
        auto const judged = judge(url(proxy.port()) + " --only " + check);
        EXPECT_EQ(judged.exit_code, 0) << judged;
        EXPECT_THAT(judged.text, testing::HasSubstr("another application uses")) << check;
    }
}

}  // namespace
}  // namespace rois::broken
