// Sub engines, engines that join, and programs, where tokens and TLS are needed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>

#include "server/application.hpp"
#include "server/certificates.hpp"
#include "server/token_file.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {

namespace {

using testing::Contains;
using testing::HasSubstr;

struct TrustedEngines : testing::Test {
    TokenFile file;
    std::string const engine = file.add("engine", "engine");
    std::string const desk = file.add("desk", "operator");

    void put(std::string const& name, std::string const& text) const { std::ofstream{file.folder() + "/" + name} << text; }
    std::string path(std::string const& name) const { return file.folder() + "/" + name; }
    std::vector<std::string> main(std::vector<std::string> more = {}) const {
        more.insert(more.end(), {"--robots", "none", "--engines", path("engines.json")});
        return file.of_gateway(more);
    }
};

}  // namespace

TEST_F(TrustedEngines, AreAskedWithTheTokenOfTheirEntry) {
    GatewayProcess const robot{file.of_gateway()};
    put("engine.token", engine + "\n");
    put("desk.token", desk);
    auto const entries = [&](std::string const& token) {
        put("engines.json",
            R"({"engines": [{"name": "hall", "url": ")" + robot.url() + R"(", "token_file": ")" + token + R"("}]})");
    };
    entries("desk.token");
    GatewayProcess gateway{main()};
    EXPECT_THAT(gateway.log_with("expected at least"), HasSubstr("the token has the role operator: expected at least engine"));
    entries("engine.token");
    gateway.signal(SIGHUP);
    gateway.log_with("present with");
    Application application{Transport::websocket, with_token(desk, gateway)};
    application.connect();
    EXPECT_THAT(application.search(), Contains("hall.navigation"));
    application.disconnect();
}

TEST_F(TrustedEngines, AreNotAskedWithATokenThatOthersCouldRead) {
    put("engine.token", engine);
    put("engines.json", R"({"engines": [{"name": "hall", "url": "ws://192.0.2.1:8080", "token_file": "engine.token"}]})");
    auto arguments = main();
    arguments.emplace_back("--check-config");
    EXPECT_THAT(
        run_gateway(arguments).error,
        HasSubstr("engines.json:1:61: sub engine 'hall': others could read the token on its way to 'ws://192.0.2.1:8080'"));
}

// The links show the certificate that the other side asks for.
TEST_F(TrustedEngines, MayAskEachOtherForCertificates) {
    Certificates const certificates;
    for (auto const* name : {"own", "link"}) certificates.make(name);
    auto const identity = certificates.folder() + "/identity.pem";
    std::ofstream{identity} << std::ifstream{certificates.certificate("link")}.rdbuf()
                            << std::ifstream{certificates.key("link")}.rdbuf();
    std::vector<std::string> const asks{"--tls-client-ca", certificates.certificate("link"), "--tls-clients", "required"};
    GatewayProcess const robot{certificates.of_gateway("own", asks)};
    auto const url = "wss://localhost:" + std::to_string(robot.port());
    auto const entry = R"({"name": "robot", "url": ")" + url + R"(", "ca_file": ")" + certificates.certificate("own") + "\"";
    put("engines.json", "{\"engines\": [" + entry + "}]}");
    {
        GatewayProcess refused{{"--engines", path("engines.json"), "--robots", "none"}};
        EXPECT_THAT(refused.log_with("certificate required"), HasSubstr("certificate required"));
    }
    put("engines.json", "{\"engines\": [" + entry + R"(, "certificate_file": ")" + identity + "\"}]}");
    GatewayProcess main{{"--engines", path("engines.json"), "--robots", "none"}};
    EXPECT_THAT(main.log_with("present with"), HasSubstr("sub engine robot: present with"));

    put("joins.json", R"({"engines": [{"name": "hall", "joins": "hall"}]})");
    auto more = asks;
    more.insert(more.end(), {"--engines", path("joins.json"), "--robots", "none"});
    GatewayProcess joined{certificates.of_gateway("own", more)};
    GatewayProcess const joining{{"--join", "wss://localhost:" + std::to_string(joined.port()), "--join-as", "hall",
                                  "--join-ca-file", certificates.certificate("own"), "--join-certificate-file", identity}};
    EXPECT_THAT(joined.log_with("present with"), HasSubstr("sub engine hall: present with"));
}

TEST_F(TrustedEngines, DoNotJoinWithATokenThatOthersCouldRead) {
    put("engine.token", engine);
    for (std::vector<std::string> flags : {std::vector<std::string>{"--check-config"}, {}}) {
        flags.insert(flags.end(), {"--join", "ws://192.0.2.1:8080", "--join-token-file", path("engine.token")});
        auto const refused = run_gateway(flags);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.error,
                    HasSubstr("join_token_file: others could read the token on its way to 'ws://192.0.2.1:8080': expected "));
    }
}

TEST_F(TrustedEngines, JoinWithATokenUntilItIsRevoked) {
    put("engines.json", R"({"engines": [{"name": "hall", "joins": "hall"}]})");
    put("engine.token", engine);
    put("wrong.token", "wrong");
    GatewayProcess gateway{main()};
    auto const joining = [&](std::string const& token) {
        return std::vector<std::string>{"--join", gateway.url(), "--join-as", "hall", "--join-token-file", path(token)};
    };
    {
        GatewayProcess stranger{joining("wrong.token")};
        EXPECT_THAT(stranger.log_with("401"), HasSubstr("401"));
    }
    GatewayProcess robot{joining("engine.token")};
    gateway.log_with("present with");
    EXPECT_EQ(file.run({"revoke", "engine"}).exit_code, 0);
    EXPECT_THAT(robot.log_with("401"), HasSubstr("401")) << "the link was cut, and another one is refused";
}

TEST_F(TrustedEngines, DoNotKeepAGatewayThatEnds) {
    put("engines.json", R"({"engines": [{"name": "hall", "joins": "hall"}]})");
    put("engine.token", engine);
    GatewayProcess gateway{main()};
    GatewayProcess const robot{{"--join", gateway.url(), "--join-as", "hall", "--join-token-file", path("engine.token")}};
    gateway.log_with("present with");
    auto const begun = std::chrono::steady_clock::now();
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds{4'500}) << "shutdown_timeout is 5 s";
}

TEST_F(TrustedEngines, JoinOnlyByTheNamesThatTheirTokensCover) {
    put("engines.json", R"({"engines": [{"name": "one", "joins": "one"}, {"name": "two", "joins": "two"}]})");
    put("one.token", file.add("one", "engine", {"--components", "one.*"}));
    GatewayProcess gateway{main()};
    auto const joining = [&](std::string const& name) {
        return std::vector<std::string>{"--join", gateway.url(), "--join-as", name, "--join-token-file", path("one.token")};
    };
    GatewayProcess thief{joining("two")};
    EXPECT_THAT(thief.log_with("refuses"), HasSubstr("unknown name 'two'"));
    GatewayProcess const robot{joining("one")};
    gateway.log_with("sub engine one: present with");
}

TEST_F(TrustedEngines, AreProgramsOfTheGatewayWithoutAnyConfiguration) {
    Certificates const certificates;
    certificates.make("own");
    put("engines.json", R"({"engines": [{"name": "lamps", "joins": "lamps", "command": ["python3", ")" ROIS_SOURCE_DIR
                        R"(/components/sdk/python/lamp.py"]}, {"name": "lamp", "joins": "lamp", "command": [")" ROIS_BINARY_DIR
                        R"(/bin/rois-lamp"]}]})");
    GatewayProcess gateway{certificates.of_gateway("own", main())};
    gateway.log_with("sub engine lamps: present with");
    gateway.log_with("sub engine lamp: present with");
    EXPECT_EQ(run_shell("ss -ltnp | grep rois-lamp").out, "") << "its engine has no port";
    auto address = certificates.trusting("own", gateway);
    address.token = desk;
    Application application{Transport::websocket, address};
    application.connect();
    auto const refs = application.search();
    EXPECT_THAT(refs, Contains(testing::StartsWith("lamps.")));
    EXPECT_THAT(refs, Contains(testing::StartsWith("lamp.")));
    application.disconnect();
}

TEST_F(TrustedEngines, HaveAPortWhereOthersCanOnlyBeRefused) {
    put("engines.json",
        R"({"engines": [{"name": "p", "joins": "p", "command": ["sh", "-c", "echo token $ROIS_TOKEN; echo url $ROIS_URL; sleep 600"]}]})");
    GatewayProcess gateway{main()};
    std::string const mark = "url http://127.0.0.1:";
    auto const log = gateway.log_with(mark);
    auto address = with_token(engine, gateway);
    address.port = static_cast<std::uint16_t>(std::stoi(log.substr(log.find(mark) + mark.size())));
    EXPECT_NE(address.port, gateway.port());
    std::string const before = "token ";
    auto const begin = log.find(before) + before.size();
    address.token = log.substr(begin, log.find('\n', begin) - begin);
    EXPECT_EQ(kit::HttpClient{rois::test::with_token(address.token, gateway)}.get("/rois/profile").status, 401)
        << "a program's token is not one of the gateway's port";
    kit::HttpClient with_token{address};
    for (auto const* path : {"/rois/profile", "/healthz", "/"}) EXPECT_EQ(with_token.get(path).status, 403) << path;
    EXPECT_EQ(kit::shake_hands(with_token).status, 403);
    address.token = engine;
    EXPECT_EQ(kit::shake_hands(*std::make_unique<kit::HttpClient>(address), {}, "/rois/engines").status, 401);
    address.token.clear();
    kit::HttpClient without{address};
    for (auto const* path : {"/rois/profile", "/healthz", "/", "/rois/engines"}) EXPECT_EQ(without.get(path).status, 401) << path;
}

}  // namespace rois::test
