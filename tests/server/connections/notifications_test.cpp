// Notifications over HTTP: long poll and server-sent events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "kit/application.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<unsigned> sequences(HttpReply const& reply) {
    EXPECT_EQ(reply.status, 200) << reply.body;
    std::vector<unsigned> all;
    for (auto const& notification : reply.root()) all.push_back(notification.attribute("sequence").as_uint());
    return all;
}

// One event of a stream.
struct Event {
    std::string id;
    pugi::xml_document document;
};

class Stream {
public:
    explicit Stream(std::string const& session, std::string const& lines = "", GatewayProcess const& gateway = shared_gateway())
        : line_{gateway.address()} {
        line_.send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
                   session + "\r\n" + lines + "\r\n");
        head = line_.take_until("\r\n\r\n");
    }

    std::unique_ptr<Event> next() {
        auto event = std::make_unique<Event>();
        std::string data;
        for (auto line = line_.take_until("\n"); line != "\n" || data.empty(); line = line_.take_until("\n")) {
            if (line.starts_with("id: ")) event->id = line.substr(4, line.size() - 5);
            if (line.starts_with("data: ")) data += line.substr(6);
        }
        event->document.load_string(data.c_str());
        EXPECT_EQ(event->id, event->document.document_element().attribute("sequence").value());
        return event;
    }

    bool ends() { return line_.ends(); }
    std::string rest() { return line_.rest(); }

    std::string head;

private:
    Line line_;
};

TEST(LongPoll, ReturnsWaitingNotificationsAtOnce) {
    HttpClient client;
    bind_and_complete(client, 3);
    EXPECT_THAT(sequences(client.notifications(0, 30)), ElementsAre(1, 2, 3));
    EXPECT_THAT(sequences(client.notifications(0, 30)), ElementsAre(1, 2, 3)) << "reading discards nothing";
    EXPECT_THAT(sequences(client.notifications(2, 30)), ElementsAre(3));
    EXPECT_THAT(sequences(client.notifications(3, 0)), IsEmpty());
    EXPECT_THAT(sequences(client.get("/rois/notifications")), ElementsAre(1, 2, 3)) << "both default to 0";
    EXPECT_THAT(sequences(client.get("/rois/notifications?other=x&after=2")), ElementsAre(3));
}

TEST(LongPoll, ReturnsAsManyAgainAsTheKeyKeeps) {
    GatewayProcess const gateway{{"--max-sent-notifications", "16"}};
    HttpClient client{gateway};
    bind_and_complete(client, 20);
    EXPECT_THAT(sequences(client.notifications(0, 30)), testing::SizeIs(20));
    auto const again = client.notifications(0, 30);
    EXPECT_STREQ(again.root().first_child().name(), "lost");
    EXPECT_EQ(sequences(again).front(), 4);
    EXPECT_THAT(sequences(again), testing::SizeIs(17));
}

TEST(LongPoll, WaitsForTheNext) {
    HttpClient client, waiting;
    bind_and_complete(client, 1);
    EXPECT_THAT(sequences(client.notifications(0, 30)), ElementsAre(1));
    waiting.line().send("GET /rois/notifications?after=1&wait=30 HTTP/1.1\r\nHost: localhost\r\nRoIS-Session: " + client.session +
                        "\r\n\r\n");
    complete(client, 1);
    EXPECT_THAT(sequences(waiting.read()), ElementsAre(2));
}

TEST(LongPoll, EndsWithItsTimeAndKeepsTheConnection) {
    HttpClient client;
    bind_and_complete(client, 0);
    EXPECT_THAT(sequences(client.notifications(0, 1)), IsEmpty());
    complete(client, 1);
    EXPECT_THAT(sequences(client.notifications(0, 1)), ElementsAre(1));
}

TEST(LongPoll, OfAClientThatHasClosedItsSideIsAnsweredAtOnce) {
    HttpClient client;
    bind_and_complete(client, 0);
    client.line().send("GET /rois/notifications?wait=30 HTTP/1.1\r\nHost: localhost\r\nRoIS-Session: " + client.session +
                       "\r\n\r\n");
    client.line().finish();
    EXPECT_THAT(sequences(client.read()), IsEmpty());
}

// The two requests race: the poll returns the end of its session, or is rejected because the session has ended.
TEST(LongPoll, DoesNotOutliveItsSession) {
    HttpClient client, waiting;
    client.call("connect");
    waiting.line().send("GET /rois/notifications?wait=30 HTTP/1.1\r\nHost: localhost\r\nRoIS-Session: " + client.session +
                        "\r\n\r\n");
    EXPECT_EQ(client.call("disconnect").return_code(), "OK");
    EXPECT_THAT(waiting.read().status, testing::AnyOf(200, 403));
}

TEST(LongPoll, RefusesBadNumbers) {
    HttpClient client;
    client.call("connect");
    for (auto const* query :
         {"after=-1", "after=x", "after=", "after=1.5", "wait=-1", "wait=31", "wait=soon", "after=99999999999999999999999"}) {
        auto const reply = client.get("/rois/notifications?" + std::string{query});
        EXPECT_EQ(reply.status, 400) << query;
    }
    EXPECT_EQ(client.get("/rois/notifications", {{"Accept", "text/event-stream"}, {"Last-Event-ID", "x"}}).status, 400);
}

TEST(LongPoll, WaitsAtMostAsLongAsTheKeyAllows) {
    for (auto const& [most, beyond] : {std::pair{"2", "3"}, {"40", "41"}}) {
        GatewayProcess const gateway{{"--max-poll-wait", most}};
        HttpClient client{gateway};
        bind_and_complete(client, 1);
        EXPECT_THAT(sequences(client.get("/rois/notifications?wait=" + std::string{most})), ElementsAre(1));
        auto const refused = client.get("/rois/notifications?wait=" + std::string{beyond});
        EXPECT_EQ(refused.status, 400);
        EXPECT_EQ(refused.reason(), "wait must be a whole number of seconds, " + std::string{most} +
                                        " at most (max_poll_wait), not '" + beyond + "'");
    }
}

TEST(LongPoll, RefusesAPositionThatWasNeverGivenOut) {
    HttpClient client;
    bind_and_complete(client, 3);
    EXPECT_THAT(sequences(client.get("/rois/notifications?after=3")), IsEmpty());
    for (auto const* after : {"4", "1000000", "18446744073709551615"}) {
        auto const reply = client.get("/rois/notifications?wait=30&after=" + std::string{after});
        EXPECT_EQ(reply.status, 400) << after;
        EXPECT_EQ(reply.reason(),
                  "the position " + std::string{after} + " is higher than the last sequence of this session: expected at most 3");
    }
    EXPECT_EQ(client.get("/rois/notifications?after=18446744073709551616").status, 400);
    complete(client, 1);
    EXPECT_THAT(sequences(client.get("/rois/notifications?after=3")), ElementsAre(4));
    HttpClient stranger;
    EXPECT_EQ(stranger.get("/rois/notifications?after=5").status, 403) << "without a session";
}

TEST(EventStream, RefusesAPositionThatWasNeverGivenOut) {
    HttpClient client;
    bind_and_complete(client, 2);
    for (auto const* last : {"3", "-1", "18446744073709551615", "18446744073709551616", "", "2\r\nLast-Event-ID: 2"}) {
        auto const reply = client.get("/rois/notifications", {{"Accept", "text/event-stream"}, {"Last-Event-ID", last}});
        EXPECT_EQ(reply.status, 400) << last;
        EXPECT_EQ(reply.fault(), "not_well_formed") << last;
    }
    EXPECT_THAT(Stream(client.session, "Last-Event-ID: 2\r\n").head, testing::StartsWith("HTTP/1.1 200 "));
}

TEST(EventStream, NeedsASession) {
    HttpClient client;
    auto const reply = client.get("/rois/notifications", {{"Accept", "text/event-stream"}});
    EXPECT_EQ(reply.status, 403);
    EXPECT_EQ(reply.fault(), "no_session");
}

TEST(EventStream, BeginsAtTheBeginningAndGoesOn) {
    HttpClient client;
    bind_and_complete(client, 2);
    Stream stream{client.session};
    EXPECT_THAT(stream.head, testing::HasSubstr("Content-Type: text/event-stream\r\n"));
    EXPECT_EQ(stream.next()->id, "1");
    EXPECT_EQ(stream.next()->id, "2");
    complete(client, 1);
    auto const event = stream.next();
    EXPECT_EQ(event->id, "3");
    EXPECT_STREQ(event->document.document_element().name(), "completed");
}

TEST(EventStream, SendsCommentsWhileItIsIdle) {
    GatewayProcess gateway{{"--ping-interval", "0.1"}};
    HttpClient client{gateway};
    client.call("connect");
    Line line{gateway.address()};
    line.send("GET /rois/notifications HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nRoIS-Session: " +
              client.session + "\r\n\r\n");
    line.take_until("\r\n\r\n");
    EXPECT_EQ(line.take(3), ":\n\n");
}

// The robot speaks for minutes; disconnect ends the speech.
TEST(EventStream, ReceivesTheAbortsBeforeDisconnectIsAnsweredThenEnds) {
    HttpClient client;
    client.call("connect");
    client.call("bind", component_ref("speech_synthesis"));
    std::string words;
    for (int i = 0; i < 300; ++i) words += "word ";
    auto const speak =
        kit::sequence(kit::unit({.component = "speech_synthesis", .id = "long", .arguments = {kit::speech_text(words)}}));
    EXPECT_EQ(client.call("execute", speak).return_code(), "OK");
    Stream stream{client.session};
    EXPECT_EQ(client.call("disconnect").return_code(), "OK");
    auto const event = stream.next();
    EXPECT_STREQ(event->document.document_element().child("status").text().get(), "ABORT");
    EXPECT_TRUE(stream.ends());
}

TEST(Link, OfAStreamKeepsTheSession) {
    GatewayProcess gateway{{"--session-timeout", "0.2", "--resume-window", "0.1"}};
    HttpClient watched{gateway}, other{gateway};
    bind_and_complete(watched, 1);
    other.call("connect");
    Stream stream{watched.session, "", gateway};
    EXPECT_EQ(stream.next()->id, "1");
    for (int i = 0; i < 2; ++i) EXPECT_THAT(sequences(other.notifications(0, 1)), IsEmpty());  // longer than timeout and window
    EXPECT_EQ(watched.call("get_parameter", component_ref("navigation")).return_code(), "OK");
}

// Both transports of the kit wait as long as the patience says.
TEST(Patience, IsTheSameOverBothTransports) {
    constexpr std::chrono::seconds patience{2};
    for (auto const transport : kit::all_transports) {
        auto address = shared_gateway().address();
        address.patience = patience;
        auto const connection = kit::connection_over(address, transport);
        std::vector<std::string> notifications;
        connection->set_session(kit::Document{connection->ask(request("connect"), notifications)}.text("session"));
        auto const began = std::chrono::steady_clock::now();
        EXPECT_THROW(connection->wait(notifications), LineEnded);
        auto const waited = std::chrono::steady_clock::now() - began;
        EXPECT_GE(waited, patience - std::chrono::milliseconds{50}) << transport;
    }
}

}  // namespace
}  // namespace rois::test
