// wss and https, with a TLS proxy before the gateway.
#include "client_cpp/rig.hpp"
#include "client_cpp/tls_proxy.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

class Tls : public BothWays {
protected:
    static std::string url(TlsProxy const& proxy, std::string const& host) {
        return (GetParam() == Way::http ? "https://" : "wss://") + host + ":" + std::to_string(proxy.port());
    }
    static std::string why_not(Settings settings) {
        settings.attempts = 1;
        Blocking robot{std::move(settings)};
        try {
            robot.open();
        } catch (Error const& error) {
            return error.what();
        }
        return "it is open";
    }
};
ROIS_BOTH_WAYS(Tls);

TEST_P(Tls, AcceptsATrustedCertificate) {
    TlsProxy const proxy{shared_gateway().port()};
    for (auto const* host : {"127.0.0.1", "localhost"}) {
        auto trusting = settings(url(proxy, host));
        trusting.ca_file = proxy.certificate();
        Blocking robot{trusting};
        auto const detection = robot.bind<SoundDetection>("sound_detection");
        auto detected = robot(detection.sound_detected());
        EXPECT_EQ(robot(detection.start()), CompletedStatus::ok);
        EXPECT_TRUE(robot(detected.next(5s))) << host;
    }
}

TEST_P(Tls, RejectsOtherCertificates) {
    TlsProxy const proxy{shared_gateway().port()};
    EXPECT_THAT(why_not(settings(url(proxy, "127.0.0.1"))), HasSubstr("certificate verify failed"))
        << "signed by an unknown authority";
    auto other_name = settings(url(proxy, "127.0.0.2"));
    other_name.ca_file = proxy.certificate();
    auto const reason = why_not(other_name);
    EXPECT_THAT(reason, testing::AnyOf(HasSubstr("certificate verify failed"), HasSubstr("no connection")));
    auto no_file = settings(url(proxy, "localhost"));
    no_file.ca_file = "/nowhere.pem";
    EXPECT_THAT(why_not(no_file), HasSubstr("No such file"));
}

TEST_P(Tls, ShowsItsOwnCertificate) {
    TlsProxy const proxy{shared_gateway().port(), TlsProxy::Kind::asks};
    auto known = settings(url(proxy, "localhost"));
    known.ca_file = proxy.certificate();
    EXPECT_NE(why_not(known), "it is open");
    known.certificate_file = proxy.identity();
    EXPECT_EQ(why_not(known), "it is open");
    known.certificate_file = proxy.certificate();
    EXPECT_THAT(why_not(known), HasSubstr("the file of the certificate and its key")) << "there is no key";
}

TEST_P(Tls, RejectsTls11) {
    TlsProxy const proxy{shared_gateway().port(), TlsProxy::Kind::tls_1_1};
    auto trusting = settings(url(proxy, "localhost"));
    trusting.ca_file = proxy.certificate();
    EXPECT_THAT(why_not(trusting), HasSubstr("alert protocol version"));
}

TEST_P(Tls, ReportsAPortWithoutTls) {
    auto url = "https://127.0.0.1:" + std::to_string(shared_gateway().port());
    EXPECT_THAT(why_not(settings(url)), HasSubstr("no TLS"));
}

}  // namespace
}  // namespace rois::test
