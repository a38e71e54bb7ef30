// The command `rois-gateway token`, and what the gateway refuses to serve without tokens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "server/http_client.hpp"
#include "server/token_file.hpp"

namespace rois::test {

namespace {

using testing::HasSubstr;

void expect_complaint(Ended const& ended, std::string const& wanted) {
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, HasSubstr(wanted));
    EXPECT_EQ(std::ranges::count(ended.error, '\n'), 1) << ended.error;
    EXPECT_EQ(ended.out, "");
}

std::string content_of(std::string const& file) {
    std::ostringstream text;
    text << std::ifstream{file}.rdbuf();
    return text.str();
}

}  // namespace

TEST(TokenCommand, KeepsOnlyTheHashInAFileForItsOwner) {
    TokenFile const file;
    auto const token = file.add("desk", "operator");
    EXPECT_TRUE(std::regex_match(token, std::regex{"[A-Za-z0-9_-]{43}"})) << "256 bits in base64url: " << token;
    EXPECT_NE(file.add("other", "operator"), token);
    auto const kept = content_of(file.name());
    EXPECT_THAT(kept, Not(HasSubstr(token)));
    auto const hash = run_shell("printf %s '" + token + "' | sha256sum").out.substr(0, 64);
    EXPECT_THAT(kept, HasSubstr(hash));
    struct stat found {};
    ASSERT_EQ(::stat(file.name().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0600);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{file.folder()}, {}), 1) << "no other file is left";
}

TEST(TokenCommand, ListsWhatTokensAllow) {
    TokenFile const file;
    file.add("watcher", "observer", {"--components", "speech_*"});
    file.add("desk", "operator", {"--commands", "navigation", "--commands", "move", "--expires", "2099-12-31"});
    EXPECT_EQ(file.run({"list"}).out,
              "NAME     ROLE      COMPONENTS  COMMANDS          EXPIRES\n"
              "watcher  observer  speech_*    none              never\n"
              "desk     operator  *           navigation, move  2100-01-01T00:00:00.000Z\n");
}

TEST(TokenCommand, TakesPatternsThatBeginWithABracket) {
    TokenFile const file;
    file.add("desk", "operator", {"--components", "[*,x]", "--components", "[rs]obot[12]", "--commands", "[!n]"});
    EXPECT_THAT(file.run({"list"}).out, HasSubstr("[*,x], [rs]obot[12]  [!n]"));
}

TEST(TokenCommand, SaysWhatIsWrong) {
    TokenFile const file;
    file.add("desk", "operator");
    expect_complaint(file.run({"add", "desk", "--role", "observer"}), "there is a token with the name 'desk' already");
    expect_complaint(file.run({"add", "d k", "--role", "observer"}), "NAME must be letters, digits");
    expect_complaint(file.run({"add", "x", "--role", "king"}),
                     "--role must be one of observer, operator, engine, administrator, not 'king'");
    expect_complaint(file.run({"add", "x"}), "--role is required");
    expect_complaint(file.run({"add", "x", "--role", "observer", "--expires", "soon"}), "--expires must be a time in the future");
    expect_complaint(file.run({"add", "x", "--role", "observer", "--expires", "2001-01-01"}),
                     "--expires must be a time in the future");
    expect_complaint(file.run({"add", "x", "--role", "observer", "--expires", "9999-12-31"}), "before 2262: ");
    expect_complaint(file.run({"add", "x", "--role", "observer", "--expires", ""}), "--expires must be a time in the future");
    expect_complaint(file.run({"add", "x", "--role", "observer", "--components", ""}),
                     "--components cannot be '': expected patterns of refs");
    for (auto const& pattern : {std::string{"robot[12"}, std::string{"a[]"}, std::string(257, 'x'), std::string{"\xff"}})
        expect_complaint(file.run({"add", "x", "--role", "operator", "--commands", pattern}), "--commands cannot be '");
    EXPECT_EQ(file.run({"add", "long", "--role", "operator", "--commands", std::string(256, 'x')}).exit_code, 0);
    expect_complaint(file.run({"add", "x", "--role", "observer", "--commands", "move"}),
                     "--commands has no effect with --role observer");
    expect_complaint(file.run({"revoke", "unknown"}), "there is no token with the name 'unknown'");
    expect_complaint(file.run({}), "A subcommand is required");
    expect_complaint(run_gateway({"token", "list"}), "expected the file of tokens in --tokens FILE");
    expect_complaint(run_gateway({"token", "list", "--tokens", "/nowhere/at.all"}), "cannot read '/nowhere/at.all'");
    expect_complaint(run_gateway({"token", "add", "x", "--role", "observer", "--tokens", "/nowhere/at.all"}),
                     "cannot change '/nowhere/at.all': No such file or directory");
}

TEST(TokenCommand, AddsNoTokenThatNobodyCanRead) {
    TokenFile const file;
    file.add("desk", "operator");
    for (auto const* output : {">&-", ">/dev/full"}) {
        auto const ended = run_shell(std::string{kit::gateway_program} + " token add lost --role observer --tokens " +
                                     file.name() + " " + output);
        EXPECT_EQ(ended.exit_code, 2) << output;
        EXPECT_THAT(ended.error, HasSubstr("it cannot be written to the standard output, and was not added"));
    }
    EXPECT_THAT(file.run({"list"}).out, Not(HasSubstr("lost")));
}

TEST(TokenCommand, ChangesTheFileThatALinkStandsFor) {
    TokenFile const file;
    file.add("desk", "operator");
    auto const link = file.folder() + "/link.json";
    std::filesystem::create_symlink(file.name(), link);
    EXPECT_EQ(run_gateway({"token", "revoke", "desk", "--tokens", link}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_THAT(content_of(file.name()), Not(HasSubstr("desk")));
}

TEST(TokenCommand, LosesNoTokenWhenManyAreAddedAtOnce) {
    TokenFile const file;
    std::string commands;
    for (int i = 0; i < 8; ++i)
        commands += std::string{kit::gateway_program} + " token add t" + std::to_string(i) + " --role observer --tokens " +
                    file.name() + " & ";
    run_shell("(" + commands + "wait) 2>/dev/null");
    auto const listed = file.run({"list"}).out;
    EXPECT_EQ(std::ranges::count(listed, '\n'), 9) << listed;
}

TEST(FileOfTokens, HasAtMostAThousand) {
    TokenFile const file;
    auto const write = [&](int many) {
        std::string entries;
        for (int i = 0; i < many; ++i) {
            auto const number = std::to_string(i);
            entries += std::string{i == 0 ? "" : ","} + R"({"name": "t)" + number + R"(", "role": "observer", "sha256": ")" +
                       std::string(64 - number.size(), 'a') + number + R"("})";
        }
        std::ofstream{file.name()} << R"({"tokens": [)" << entries << "]}";
        std::filesystem::permissions(file.name(), std::filesystem::perms{0600});
    };
    write(1'001);
    expect_complaint(run_gateway({"--tokens", file.name(), "--check-config"}), "expected at most 1000 tokens");
    write(999);
    EXPECT_EQ(file.run({"add", "last", "--role", "observer"}).exit_code, 0);
    EXPECT_EQ(run_gateway({"--tokens", file.name(), "--check-config"}).exit_code, 0);
    expect_complaint(file.run({"add", "more", "--role", "observer"}), "there are 1000 tokens already: revoke one");
}

TEST(FileOfTokens, ThatOthersMayReadGetsAWarning) {
    TokenFile const file;
    file.add("desk", "operator");
    std::filesystem::permissions(file.name(), std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    GatewayProcess gateway{file.of_gateway()};
    EXPECT_THAT(gateway.log_with("other users"), HasSubstr("other users may read " + file.name()));
}

TEST(FileOfTokens, MustBeValidAndForItsOwnerOnly) {
    TokenFile const file;
    auto const refused = [&](std::string const& text, std::string const& wanted) {
        std::ofstream{file.name()} << text;
        expect_complaint(run_gateway({"--tokens", file.name(), "--check-config"}), wanted);
    };
    std::string const hash(64, 'a');
    refused("", ": this is not JSON");
    refused(R"({"tokens": 3})", R"(expected only "tokens": [ ... ])");
    refused("{\"tokens\": [\n{\"name\": \"x\"}]}", ":2:1: role must be one of observer, operator, engine, administrator");
    refused(R"({"tokens": [{"name": "x", "role": "observer", "sha256": "123"}]})", "sha256 must be 64 hexadecimal digits");
    refused(R"({"tokens": [{"name": "x", "role": "observer", "sha256": ")" + hash + R"(", "expires": "soon"}]})",
            "expires must be a time");
    refused(R"({"tokens": [{"name": "x", "role": "observer", "sha256": ")" + hash + R"(", "components": "a"}]})",
            "components must be a list of patterns");
    for (auto const* pattern : {"", "robot[12", "[", R"(a\nb)"})
        refused(
            R"({"tokens": [{"name": "x", "role": "observer", "sha256": ")" + hash + R"(", "components": [")" + pattern + "\"]}]}",
            "of 1 to 256 characters, with a ']' for each '['");
    refused(R"({"tokens": [{"name": "x", "role": "observer", "sha256": ")" + hash + R"(", "rights": 1}]})",
            "'rights' is not a key of a token");
    auto const entry = [&](std::string const& name) {
        return R"({"name": ")" + name + R"(", "role": "observer", "sha256": ")" + hash + R"("})";
    };
    refused(R"({"tokens": [)" + entry("x") + ", " + entry("x") + "]}", "there are two tokens with the name 'x'");
    refused(R"({"tokens": [)" + entry("x") + ", " + entry("y") + "]}", "there are two entries for one token");
    std::filesystem::permissions(file.name(), std::filesystem::perms::group_write, std::filesystem::perm_options::add);
    refused(R"({"tokens": []})", "others may write");
    expect_complaint(run_gateway({"--tokens", file.folder()}), "is not a file");
    auto const pipe = file.folder() + "/pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    expect_complaint(run_gateway({"--tokens", pipe}), "'" + pipe + "' is not a file");
    if (::geteuid() == 0) {
        std::filesystem::permissions(file.name(), std::filesystem::perms::group_write, std::filesystem::perm_options::remove);
        ASSERT_EQ(::chown(file.name().c_str(), 65534, 65534), 0);
        refused(R"({"tokens": []})", "belongs to another user");
    }
    expect_complaint(run_gateway({"--tokens", "/nowhere/at.all"}), "cannot read '/nowhere/at.all': No such file or directory");
}

TEST(FileOfTokens, ThatBecomesInvalidChangesNothing) {
    TokenFile const file;
    auto const token = file.add("desk", "operator");
    GatewayProcess gateway{file.of_gateway()};
    std::ofstream{file.name()} << "{";
    EXPECT_THAT(gateway.log_with("the tokens are those of before"), HasSubstr(file.name() + ":1:2: this is not JSON"));
    kit::HttpClient desk{with_token(token, gateway)};
    EXPECT_EQ(desk.get("/rois/profile").status, 200);
}

TEST(WithoutTokens, OnlyThisMachineIsServed) {
    for (auto const* flag : {"--listen", "--media"})
        for (auto const* address : {"0.0.0.0:0", "[::]:0", "192.0.2.1:1"}) {
            auto const wanted =
                std::string{flag}.substr(2) + ": other machines can reach " + address + ", and no client needs a token";
            expect_complaint(run_gateway({flag, address}), wanted);
            expect_complaint(run_gateway({flag, address, "--check-config"}), wanted);
        }
    expect_complaint(run_gateway({"--listen", "robot.invalid:0", "--check-config"}),
                     "listen: 'robot.invalid' cannot be resolved");
    TokenFile const file;
    file.add("desk", "operator");
    auto const with_tokens = run_gateway({"--listen", "0.0.0.0:0", "--check-config", "--tokens", file.name()});
    EXPECT_EQ(with_tokens.exit_code, 0);
    EXPECT_THAT(with_tokens.error, HasSubstr("clients send their tokens to 0.0.0.0:0 without TLS"));
    auto const for_anyone = run_gateway({"--listen", "0.0.0.0:0", "--check-config", "--allow-anyone"});
    EXPECT_EQ(for_anyone.exit_code, 0);
    EXPECT_THAT(for_anyone.error, HasSubstr("everyone who reaches 0.0.0.0:0 may command the robot"));
    EXPECT_EQ(run_gateway({"--listen", "0.0.0.0:0", "--check-config"}, {{"ROIS_ALLOW_ANYONE", "yes"}}).exit_code, 0);
    EXPECT_EQ(run_gateway({"--listen", "localhost:0", "--media", "[::1]:0", "--check-config"}).exit_code, 0);
}

}  // namespace rois::test
