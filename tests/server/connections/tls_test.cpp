// TLS on the ports of the gateway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "server/application.hpp"
#include "server/certificates.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {

namespace {

using testing::HasSubstr;

struct Tls : testing::Test {
    Certificates certificates;
    Tls() { certificates.make("own"); }

    std::vector<std::string> with(std::vector<std::string> const& more) const { return certificates.of_gateway("own", more); }
    // What the program openssl says when it connects with these options.
    static Ended connect_with(std::string const& options, GatewayProcess const& gateway) {
        return run_shell("openssl s_client -connect 127.0.0.1:" + std::to_string(gateway.port()) + " " + options + " </dev/null");
    }
    std::string trusted() const { return "--cacert " + certificates.certificate("own"); }
};

}  // namespace

TEST_F(Tls, CarriesRequestsAndNotificationsOverBothTransports) {
    GatewayProcess const gateway{with({"--sim-speed", "20"})};
    for (auto const transport : all_transports) {
        Application desk{transport, certificates.trusting("own", gateway)};
        EXPECT_EQ(desk.connect().return_code(), "OK");
        EXPECT_EQ(desk.bind("speech_synthesis").return_code(), "OK");
        Command const speech{.component = "speech_synthesis",
                             .type = "start",
                             .id = "speech",
                             .arguments = {{"speech_text", "string", {"Welcome"}}}};
        EXPECT_EQ(desk.execute(speech).return_code(), "OK");
        EXPECT_EQ(desk.status_of("speech"), "OK") << transport;
        EXPECT_EQ(desk.disconnect().return_code(), "OK");
    }
}

TEST_F(Tls, CarriesLongDocuments) {
    GatewayProcess const gateway{with({})};
    kit::HttpClient client{certificates.trusting("own", gateway)};
    auto const schema = client.get("/rois/schemas/messages.xsd");
    EXPECT_EQ(schema.status, 200);
    EXPECT_GT(schema.body.size(), 16'384U) << "more than one record";
    EXPECT_EQ(client.post("<connect>" + std::string(500'000, ' ')).status, 400);
}

TEST_F(Tls, IsTheOnlyLanguageOfThePort) {
    GatewayProcess const gateway{with({})};
    HttpClient client{gateway};
    auto const reply = client.get("/healthz");
    EXPECT_EQ(reply.status, 400);
    EXPECT_THAT(reply.body, HasSubstr("this port expects TLS: use https:// or wss://"));
    EXPECT_TRUE(client.line().ends());
}

TEST_F(Tls, HasVersions12And13) {
    GatewayProcess const gateway{with({})};
    EXPECT_THAT(connect_with("-tls1_3", gateway).out, HasSubstr("New, TLSv1.3, Cipher is"));
    EXPECT_THAT(connect_with("-tls1_2", gateway).out, HasSubstr("New, TLSv1.2, Cipher is"));
    EXPECT_NE(connect_with("-tls1_1 -cipher DEFAULT:@SECLEVEL=0", gateway).exit_code, 0);
    EXPECT_NE(connect_with("-tls1_2 -cipher ECDHE+AES+SHA:AES128-GCM-SHA256", gateway).exit_code, 0)
        << "only ciphers that authenticate, and with forward secrecy";
}

TEST_F(Tls, EndsAHandshakeThatTakesTooLong) {
    GatewayProcess const gateway{with({"--handshake-timeout", "0.2"})};
    HttpClient silent{gateway}, slow{gateway};
    slow.line().send("\x16\x03\x01");
    auto const begun = std::chrono::steady_clock::now();
    EXPECT_TRUE(silent.line().ends());
    EXPECT_TRUE(slow.line().ends());
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds{3}) << "the default is 5 s";
    kit::HttpClient client{certificates.trusting("own", gateway)};
    EXPECT_THAT(client.get("/metrics").body, HasSubstr("\nrois_handshakes_failed_total 2\n"));
}

TEST_F(Tls, EndsAHandshakeThatTakesTooLongOnTheMediaPort) {
    GatewayProcess gateway{with({"--media", "127.0.0.1:0", "--handshake-timeout", "0.2"})};
    kit::HttpClient silent{gateway.media_address()};
    silent.line().set_patience(std::chrono::seconds{3});  // the default is 5 s
    EXPECT_TRUE(silent.line().ends());
}

TEST_F(Tls, SaysThatNothingFollows) {
    GatewayProcess const gateway{with({})};
    auto const url = " https://127.0.0.1:" + std::to_string(gateway.port());
    EXPECT_EQ(run_shell("curl -sSf --http1.0 " + trusted() + url + "/healthz").error, "");
    auto const last = run_shell(
        "printf 'GET /healthz HTTP/1.1\\r\\nHost: localhost\\r\\nConnection: close\\r\\n\\r\\n' | openssl s_client "
        "-quiet -verify_return_error -CAfile " +
        certificates.certificate("own") + " -connect 127.0.0.1:" + std::to_string(gateway.port()));
    EXPECT_THAT(last.out, HasSubstr("200 OK"));
    EXPECT_THAT(last.error, Not(HasSubstr("unexpected eof")));
}

TEST_F(Tls, ShowsTheCertificateThatWasReadLast) {
    certificates.make("next");
    GatewayProcess gateway{with({})};
    kit::HttpClient before{certificates.trusting("own", gateway)};
    EXPECT_EQ(before.get("/healthz").status, 200);
    for (auto const* file : {"/own.pem", "/own.key"})
        std::filesystem::copy_file(certificates.folder() + "/next" + std::string{file}.substr(4), certificates.folder() + file,
                                   std::filesystem::copy_options::overwrite_existing);
    gateway.signal(SIGHUP);
    gateway.log_with("the certificate read again");
    EXPECT_EQ(before.get("/healthz").status, 200) << "an open connection goes on";
    kit::HttpClient after{certificates.trusting("next", gateway)};
    EXPECT_EQ(after.get("/healthz").status, 200);
}

TEST_F(Tls, KeepsItsCertificateIfTheNextOneIsUnusable) {
    GatewayProcess gateway{with({})};
    auto const trusting = certificates.trusting("own", gateway);
    auto const copy = certificates.folder() + "/copy.pem";
    std::filesystem::copy_file(trusting.ca_file, copy);
    certificates.put("own.pem", "nothing\n");
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("nothing is changed"), HasSubstr("tls_certificate: cannot use '" + trusting.ca_file + "': "));
    auto address = trusting;
    address.ca_file = copy;
    kit::HttpClient after{address};
    EXPECT_EQ(after.get("/healthz").status, 200);
}

TEST_F(Tls, WarnsOfAnExpiredCertificate) {
    GatewayProcess gateway{with({})};
    kit::HttpClient client{certificates.trusting("own", gateway)};
    auto const expires = [&] {
        auto const metrics = client.get("/metrics").body;
        std::string const name = "\nrois_certificate_expiry_timestamp_seconds ";
        auto const place = metrics.find(name);
        return place == std::string::npos ? 0 : std::stod(metrics.substr(place + name.size()));
    };
    auto const now = static_cast<double>(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()));
    constexpr double day = 86'400;
    EXPECT_NEAR(expires(), now + 2 * day, 60);
    EXPECT_EQ(run_gateway(with({"--check-config"})).error, "");
    certificates.expire("own");
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("clients refuse it"), HasSubstr("tls_certificate: the certificate expired at "));
    EXPECT_NEAR(expires(), now - day, 60);
    EXPECT_THAT(run_gateway(with({"--check-config"})).error, HasSubstr("the certificate expired at "));
}

TEST_F(Tls, AsksClientsForTheirCertificates) {
    certificates.make("client");
    certificates.make("stranger");
    auto const asking = [&](std::string const& how) {
        return with({"--tls-client-ca", certificates.certificate("client"), "--tls-clients", how});
    };
    auto const status = [&](GatewayProcess const& gateway, std::string const& own) {
        auto address = certificates.trusting("own", gateway);
        if (!own.empty()) address.certificate = certificates.certificate(own), address.key = certificates.key(own);
        try {
            return kit::HttpClient{address}.get("/healthz").status;
        } catch (LineEnded const&) {
            return 0;
        }
    };
    GatewayProcess const optional{asking("optional")}, required{asking("required")};
    EXPECT_EQ(status(optional, "client"), 200);
    EXPECT_EQ(status(optional, ""), 200);
    EXPECT_EQ(status(optional, "stranger"), 0);
    EXPECT_EQ(status(required, "client"), 200);
    EXPECT_EQ(status(required, ""), 0);
    EXPECT_EQ(status(required, "stranger"), 0);
}

TEST_F(Tls, NoticesThatTheReaderOfAStreamHasGone) {
    GatewayProcess gateway{with({"--session-timeout", "0.3", "--resume-window", "0.3"})};
    auto const address = certificates.trusting("own", gateway);
    Application desk{Transport::http, address};
    desk.connect();
    {
        kit::HttpClient stream{address};
        stream.line().send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
                           desk.session() + "\r\n\r\n");
        EXPECT_THAT(stream.line().take_until("\r\n\r\n"), HasSubstr("200 OK"));
    }
    EXPECT_THAT(gateway.log_with("ended"), HasSubstr("its link was lost"));
}

TEST_F(Tls, IsSpokenWithSubEngines) {
    GatewayProcess const hall{with({})};
    certificates.put("engines.json", R"({"engines": [{"name": "hall", "url": "https://localhost:)" + std::to_string(hall.port()) +
                                         R"(", "ca_file": "own.pem"}]})");
    GatewayProcess main{{"--robots", "none", "--engines", certificates.folder() + "/engines.json"}};
    EXPECT_THAT(main.log_with("present with"), HasSubstr("present with 15"));
}

TEST_F(Tls, IsSpokenByEnginesThatJoin) {
    certificates.put("engines.json", R"({"engines": [{"name": "hall", "joins": "hall"}]})");
    GatewayProcess main{with({"--robots", "none", "--engines", certificates.folder() + "/engines.json"})};
    auto const url = "wss://localhost:" + std::to_string(main.port());
    GatewayProcess const hall{with({"--join", url, "--join-as", "hall", "--join-ca-file", certificates.certificate("own")})};
    EXPECT_THAT(main.log_with("present with"), HasSubstr("present with 15"));
    Application desk{Transport::websocket, certificates.trusting("own", main)};
    desk.connect();
    EXPECT_EQ(desk.bind("hall.speech_synthesis").return_code(), "OK");
    desk.disconnect();
}

TEST_F(Tls, IsSpokenByProgramsThatJoinWithACertificate) {
    certificates.make("program");
    certificates.put("program.identity",
                     run_shell("cat " + certificates.certificate("program") + " " + certificates.key("program")).out);
    certificates.put("engines.json", R"({"engines": [{"name": "cpp", "joins": "cpp"}, {"name": "python", "joins": "python"}]})");
    GatewayProcess main{with({"--robots", "none", "--engines", certificates.folder() + "/engines.json", "--tls-client-ca",
                              certificates.certificate("program"), "--tls-clients", "required"})};
    auto const variables = "ROIS_URL=wss://localhost:" + std::to_string(main.port()) +
                           " ROIS_CA_FILE=" + certificates.certificate("own") +
                           " ROIS_CERTIFICATE_FILE=" + certificates.folder() + "/program.identity ROIS_NAME=";
    auto const begin = [&](std::string const& name, std::string const& program) {
        return run_shell(variables + name + " " + program + " >" + certificates.folder() + "/" + name + " 2>&1 & echo $!").out;
    };
    auto const cpp = begin("cpp", ROIS_BINARY_DIR "/bin/rois-lamp");
    auto const python = begin("python", "python3 " ROIS_SOURCE_DIR "/components/sdk/python/lamp.py");
    for (auto const* name : {"cpp", "python"}) {
        auto const wanted = "sub engine " + std::string{name} + ": present with";
        EXPECT_THAT(main.log_with(wanted), HasSubstr(wanted)) << run_shell("cat " + certificates.folder() + "/" + name).out;
    }
    run_shell("kill $(echo '" + cpp + python + "')");
}

TEST_F(Tls, IsSpokenByTheMediaServer) {
    GatewayProcess gateway{with({"--media", "127.0.0.1:0"})};
    auto const plain = gateway.media_address();
    auto address = certificates.trusting("own", gateway);
    address.port = plain.port;
    EXPECT_EQ(kit::HttpClient{address}.get("/unknown").status, 404);
    EXPECT_THAT(kit::HttpClient{plain}.get("/unknown").body, HasSubstr("this port expects TLS"));
}

TEST_F(Tls, IsRequiredOfPagesThatUseTheMediaPortAlsoAfterASighup) {
    GatewayProcess gateway{with({"--media", "127.0.0.1:0"})};
    auto address = certificates.trusting("own", gateway);
    address.port = gateway.media_address().port;
    auto const status = [&](std::string const& scheme) {
        return kit::HttpClient{address}.get("/unknown", {{"Origin", scheme + "://" + address.authority}}).status;
    };
    EXPECT_EQ(status("https"), 404);
    EXPECT_EQ(status("http"), 403);
    gateway.signal(SIGHUP);
    gateway.log_with("read again");
    EXPECT_EQ(status("https"), 404);
    EXPECT_EQ(status("http"), 403);
}

// The receiver neither closes the connection nor reads.
TEST_F(Tls, EndsWithTheStreamOnTheMediaPort) {
    GatewayProcess gateway{with({"--media", "127.0.0.1:0", "--max-media-connections", "1"})};
    Application desk{Transport::websocket, certificates.trusting("own", gateway)};
    desk.connect();
    desk.bind("audio_streaming");
    desk.set_parameter("audio_streaming", {{"encoding_parameters", "string", {"audio/wav;rate=8000"}},
                                           {"transport_parameters", "string", {"http"}}});
    auto const connected = command_ids(desk.execute(Command{.component = "audio_streaming", .type = "connect_stream"})).front();
    EXPECT_EQ(desk.status_of(connected), "OK");
    auto results = desk.get_command_result(connected).values();
    auto const url = results["transport_parameters"].front(), id = results["stream_id"].front();
    auto address = certificates.trusting("own", gateway);
    auto const port = url.rfind(':') + 1, path = url.find('/', port);
    address.port = static_cast<std::uint16_t>(std::stoi(url.substr(port, path - port)));
    Line receiver{address};
    receiver.send("GET " + url.substr(path) + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    receiver.take(44);
    auto const ended = desk.execute(
        Command{.component = "audio_streaming", .type = "disconnect_stream", .arguments = {{"stream_id", "string", {id}}}});
    EXPECT_EQ(desk.status_of(command_ids(ended).front()), "OK");
    EXPECT_EQ(kit::HttpClient{address}.get("/unknown").status, 404) << "there is a place for the next one";
}

TEST_F(Tls, IsNeededForPagesToo) {
    GatewayProcess const gateway{with({})};
    kit::HttpClient client{certificates.trusting("own", gateway)};
    auto const status_of_page = [&](std::string const& scheme) {
        return client.get("/rois/profile", {{"Origin", scheme + "://localhost"}}).status;
    };
    EXPECT_EQ(status_of_page("https"), 200);
    EXPECT_EQ(status_of_page("http"), 403) << "anybody could have sent this page";
}

TEST_F(Tls, IsCheckedAlsoIfClientsMayHaveACertificate) {
    certificates.make("other");
    GatewayProcess const gateway{with({"--tls-client-ca", certificates.certificate("other")})};
    auto const arguments = with({"--listen", "127.0.0.1:" + std::to_string(gateway.port()), "--tls-client-ca",
                                 certificates.certificate("other"), "--check-health"});
    EXPECT_EQ(run_gateway(arguments).exit_code, 0);
}

// The client first offers a key for a group that the gateway does not have, and has to begin again.
TEST_F(Tls, AsksForAnotherGroupIfItDoesNotHaveTheFirst) {
    GatewayProcess const gateway{with({})};
    auto const shown = run_shell("openssl s_client -connect 127.0.0.1:" + std::to_string(gateway.port()) + " -CAfile " +
                                 certificates.certificate("own") + " -groups P-521:P-256 -brief </dev/null 2>&1");
    EXPECT_THAT(shown.out, HasSubstr("Verification: OK"));
    EXPECT_THAT(shown.out, HasSubstr("prime256v1"));
}

TEST_F(Tls, IsChecked) {
    GatewayProcess const gateway{with({})};
    auto arguments = with({"--listen", "127.0.0.1:" + std::to_string(gateway.port()), "--check-health"});
    EXPECT_EQ(run_gateway(arguments).exit_code, 0);
    auto const ended = run_gateway({"--listen", "127.0.0.1:" + std::to_string(gateway.port()), "--check-health"});
    EXPECT_THAT(ended.error, HasSubstr("expected HTTP status 200"));
}

TEST_F(Tls, NeedsUsableFiles) {
    certificates.make("other");
    certificates.make("secret", "-passout pass:secret");
    auto const own = certificates.certificate("own");
    auto const error_of = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--check-config"});
        return run_gateway(arguments).error;
    };
    EXPECT_THAT(error_of({"--tls-certificate", own}), HasSubstr("tls_certificate needs tls_key"));
    EXPECT_THAT(error_of({"--tls-key", certificates.key("own")}), HasSubstr("tls_key needs tls_certificate"));
    EXPECT_THAT(error_of(with({"--tls-clients", "required"})), HasSubstr("tls_clients = required needs tls_client_ca"));
    EXPECT_THAT(error_of({"--tls-certificate", own, "--tls-key", certificates.key("other")}),
                HasSubstr("tls_key: cannot use '" + certificates.key("other") + "': key values mismatch"));
    EXPECT_THAT(error_of({"--tls-certificate", own, "--tls-key", certificates.key("secret")}), HasSubstr("tls_key: cannot use"));
    auto const of_other_type = certificates.key("rsa");
    run_shell("openssl genpkey -algorithm RSA -pkeyopt rsa_keygen_bits:2048 -out " + of_other_type);
    EXPECT_THAT(error_of({"--tls-certificate", own, "--tls-key", of_other_type}),
                HasSubstr("tls_key: cannot use '" + of_other_type + "': "));
    EXPECT_THAT(error_of({"--tls-certificate", "nowhere.pem", "--tls-key", certificates.key("own")}),
                HasSubstr("tls_certificate: cannot use 'nowhere.pem': No such file"));
    EXPECT_THAT(error_of(with({"--tls-client-ca", certificates.key("own")})), HasSubstr("tls_client_ca: cannot use"));
    auto const pipe = certificates.key("own") + ".pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(error_of({"--tls-certificate", pipe, "--tls-key", certificates.key("own")}), HasSubstr("is not a regular file"));
    EXPECT_THAT(error_of({"--tls-certificate", own, "--tls-key", pipe}), HasSubstr("is not a regular file"));
    EXPECT_THAT(error_of(with({"--tls-client-ca", pipe})), HasSubstr("is not a regular file"));
}

}  // namespace rois::test
