// The `rois` program over TLS, before a TLS proxy; its token; and a slow host name lookup.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "client_cpp/slow_name.hpp"
#include "client_cpp/tls_proxy.hpp"
#include "command/exit.hpp"
#include "command/http.hpp"
#include "command/rois_process.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

struct RoisOverTls : testing::Test {
    TlsProxy const proxy{shared_gateway().port()};
    std::string const url = "https://localhost:" + std::to_string(proxy.port());
    Variables const trusting{{"ROIS_URL", url}, {"ROIS_CA_FILE", proxy.certificate()}};
};

TEST_F(RoisOverTls, ReportsWhetherTheEngineIsReady) {
    EXPECT_EQ(run_rois({"health"}, {}, trusting).out, "healthy\n");
    auto const stranger = run_rois({"health"}, {}, {{"ROIS_URL", url}});
    EXPECT_EQ(stranger.exit_code, 1);
    EXPECT_THAT(stranger.error, HasSubstr("certificate verify failed"));
}

TEST_F(RoisOverTls, NamesTheFileOfCertificatesThatItCannotRead) {
    for (std::string const command : {"health", "search"}) {
        auto const missing = run_rois({command, "--ca-file", "/no/such.pem"}, {}, {{"ROIS_URL", url}});
        EXPECT_EQ(missing.exit_code, 2) << "a file is wrong";
        EXPECT_THAT(missing.error, HasSubstr("'/no/such.pem' cannot be read: No such file")) << command;
        for (auto const& wrong : {file_with("garbage.pem", "a letter"), file_named("")})
            EXPECT_EQ(run_rois({command, "--ca-file", wrong}, {}, {{"ROIS_URL", url}}).exit_code, 2) << command;
    }
}

TEST_F(RoisOverTls, ExplainsAPortThatSpeaksPlainHttp) {
    auto const plain = "https://127.0.0.1:" + std::to_string(shared_gateway().port());
    for (std::string const command : {"health", "search"}) {
        auto const refused = run_rois({command, "--url", plain});
        EXPECT_NE(refused.exit_code, 0);
        EXPECT_THAT(refused.error, HasSubstr("this port speaks plain HTTP: use http: or ws:")) << command;
    }
}

TEST_F(RoisOverTls, ShowsItsOwnCertificate) {
    TlsProxy const asking{shared_gateway().port(), TlsProxy::Kind::asks};
    for (std::string const command : {"health", "search"}) {
        std::vector<std::string> arguments{command, "--url", "https://localhost:" + std::to_string(asking.port()), "--ca-file",
                                           asking.certificate()};
        EXPECT_NE(run_rois(arguments).exit_code, 0) << command;
        EXPECT_EQ(run_rois(arguments, {}, {{"ROIS_CERTIFICATE_FILE", asking.identity()}}).exit_code, 0) << command;
        arguments.insert(arguments.end(), {"--certificate-file", "/no/such.pem"});
        EXPECT_EQ(run_rois(arguments).exit_code, 2) << command;
    }
}

TEST_F(RoisOverTls, DoesNotUseTls11) {
    TlsProxy const old{shared_gateway().port(), TlsProxy::Kind::tls_1_1};
    for (std::string const command : {"health", "search"}) {
        auto const refused =
            run_rois({command, "--url", "https://localhost:" + std::to_string(old.port()), "--ca-file", old.certificate()});
        EXPECT_NE(refused.exit_code, 0);
        EXPECT_THAT(refused.error, HasSubstr("alert protocol version")) << command;
    }
}

TEST_F(RoisOverTls, SharesASession) {
    RoisProcess holding{{"bind", "speech_synthesis"}, trusting};
    auto const id = holding.line_with("session ").substr(8);
    auto const said = run_rois({"--session", id, "start", "speech_synthesis", "speech_text=Hi."}, {}, trusting);
    EXPECT_EQ(said.out, "start speech_synthesis  OK\n") << said.error;
    EXPECT_THAT(run_rois({"--session", id, "watch", "--for", "3"}, {}, trusting).out, HasSubstr("completed"));
    holding.signal(SIGINT);
    EXPECT_EQ(holding.wait().exit_code, 0);
}

TEST(TheHealth, DoesNotWaitForAHostNameLookup) {
    SlowName name;
    try {
        command::http_get({"http://robot.slow"}, "/readyz", std::chrono::milliseconds{50});
        ADD_FAILURE() << "a gateway answers";
    } catch (command::Trouble const& trouble) {
        EXPECT_EQ(trouble.exit(), command::Exit::no_answer);
    }
    name.end_lookup();
}

TEST(Token, IsNotSentInTheClearToAnotherMachineAndIsOneLine) {
    auto const error = [](std::string const& url, std::string const& token) {
        auto const ended = run_rois({"search", "--url", url, "--token", token});
        EXPECT_EQ(ended.exit_code, 2) << url;
        return ended.error;
    };
    for (auto const* url : {"http://192.0.2.1:8080", "ws://robot.example"})
        EXPECT_THAT(error(url, "secret"), HasSubstr("without TLS, because others could read it: expected https:// or wss://"));
    for (auto const* token : {"a b", "a\r\nX: y", "a\n"})
        EXPECT_THAT(error(shared_gateway().url(), token), HasSubstr("a token has only letters, digits and signs"));
}

}  // namespace
}  // namespace rois::test
