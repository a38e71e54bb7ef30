// One call of the system fails, the n-th of its kind: the gateway goes on, and what moves can be stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <ostream>
#include <string>
#include <thread>

#include "server/http_client.hpp"

namespace rois::test {
namespace {

using namespace std::chrono_literals;

struct Failing {
    char const* call;
    int error;
    unsigned last;  // of its calls that fails, in one of the runs
};

void PrintTo(Failing const& failing, std::ostream* out) { *out << failing.call << " " << failing.error; }

class FailingCalls : public testing::TestWithParam<Failing> {
protected:
    // Repeats the request on new connections: the first one may have been cut.
    static HttpReply ask(GatewayProcess const& gateway, std::string const& session, auto const& what) {
        for (int tries = 0;; ++tries) {
            HttpClient client{gateway};
            client.session = session;
            try {
                auto const reply = what(client);
                client.session.clear();
                return reply;
            } catch (LineEnded const&) {
                client.session.clear();  // the session goes on
                if (tries == 20) throw;
                std::this_thread::sleep_for(20ms);
            }
        }
    }
};

}  // namespace

TEST_P(FailingCalls, EndNothingThatCannotBeRepeated) {
    auto const& [call, error, last] = GetParam();
    for (unsigned which = 1; which <= last; ++which) {
        auto const failure = std::string{call} + " " + std::to_string(which) + " " + std::to_string(error);
        SCOPED_TRACE(failure);
        GatewayProcess gateway{{},
                               kit::preloading(ROIS_BINARY_DIR "/tests/libfailing_call.so", {{"ROIS_FAILING_CALL", failure}})};
        auto const session = ask(gateway, "", [](HttpClient& client) { return client.call("connect"); }).text("session");
        ASSERT_NE(session, "");
        auto const in_session = [&](std::string const& operation, Xml const& children) {
            return ask(gateway, session, [&](HttpClient& client) { return client.call(operation, children); }).return_code();
        };
        EXPECT_EQ(in_session("bind", component_ref("navigation")), "OK");
        EXPECT_EQ(in_session("search", ""), "OK");
        auto const stopped = ask(gateway, "", [](HttpClient& client) { return client.get("/rois/stop", {}, "POST"); });
        EXPECT_EQ(stopped.status, 200);
        EXPECT_EQ(in_session("release", component_ref("navigation")), "OK");
        EXPECT_EQ(ask(gateway, "", [](HttpClient& client) { return client.get("/healthz"); }).status, 200);
    }
}

INSTANTIATE_TEST_SUITE_P(Each, FailingCalls,
                         testing::Values(Failing{"accept", EMFILE, 4}, Failing{"accept", ENOBUFS, 4},
                                         Failing{"accept", ECONNABORTED, 4}, Failing{"accept", EPROTO, 4},
                                         Failing{"epoll_ctl", ENOMEM, 8}, Failing{"recv", ECONNRESET, 8},
                                         Failing{"epoll_wait", EINTR, 6}, Failing{"recv", EINTR, 8}, Failing{"send", EPIPE, 6},
                                         Failing{"send", ENOBUFS, 6}),
                         [](auto const& each) { return std::string{each.param.call} + "_" + std::to_string(each.param.error); });

}  // namespace rois::test
