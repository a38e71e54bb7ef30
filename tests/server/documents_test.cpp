// What can be read without a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Document, OfTheEngineListsItsComponents) {
    HttpClient client;
    auto const reply = client.get("/rois/profile");
    EXPECT_STREQ(reply.root().name(), "rois:HRIEngineProfile");
    EXPECT_THAT(reply.body, HasSubstr("navigation"));
}

TEST(Document, OfEachComponentIsThere) {
    HttpClient client;
    for (auto const* name : {"system_information", "person_detection", "person_localization", "person_identification",
                             "face_detection", "face_localization", "sound_detection", "sound_localization", "speech_recognition",
                             "gesture_recognition", "speech_synthesis", "reaction", "navigation", "follow", "move"}) {
        auto const reply = client.get("/rois/profile/" + std::string{name});
        EXPECT_EQ(reply.status, 200) << name;
        EXPECT_STREQ(reply.root().name(), "rois:HRIComponentProfile") << name;
    }
}

TEST(Document, IsNotSentAgainToWhoeverHasIt) {
    HttpClient client;
    for (auto const* path : {"/", "/rois/profile", "/rois/profile/move", "/rois/schemas", "/rois/schemas/rois.xsd"}) {
        auto const reply = client.get(path);
        auto const etag = reply.header("ETag");
        EXPECT_EQ(reply.header("Cache-Control"), "no-cache") << path;
        for (auto const& known : {etag, std::string{"*"}, "\"other\", " + etag, "W/" + etag}) {
            auto const again = client.get(path, {{"If-None-Match", known}});
            EXPECT_EQ(again.status, 304) << path << " " << known;
            EXPECT_EQ(again.header("ETag"), etag);
            EXPECT_EQ(again.body, "");
        }
        EXPECT_EQ(client.get(path, {{"If-None-Match", "\"other\""}}).body, reply.body) << path;
        auto const headers_only = client.get(path, {}, "HEAD");
        EXPECT_EQ(headers_only.header("Content-Length"), std::to_string(reply.body.size())) << path;
    }
}

TEST(Document, SchemasAreListedAndServed) {
    HttpClient client;
    auto const list = client.get("/rois/schemas");
    for (std::string const name : {"rois.xsd", "messages.xsd", "fes.xsd", "gml.xsd", "unr.xsd"}) {
        EXPECT_THAT(list.body, HasSubstr("\"/rois/schemas/" + name + "\""));
        EXPECT_STREQ(client.get("/rois/schemas/" + name).root().name(), "xsd:schema") << name;
    }
}

TEST(Page, LinksToAllOfItAndShowsTheRealAddress) {
    HttpClient client;
    auto const page = client.say("GET / HTTP/1.1\r\nHost: robot.example:8080\r\n\r\n");
    EXPECT_THAT(page.header("Content-Type"), HasSubstr("text/html"));
    EXPECT_THAT(page.header("Content-Security-Policy"),
                ContainsRegex("default-src 'none'; style-src 'sha256-[A-Za-z0-9+/]{43}='"));
    EXPECT_THAT(page.body, HasSubstr("url=http://robot.example:8080\n"));
    EXPECT_THAT(page.body, testing::Not(HasSubstr("{{")));
    for (std::size_t at = page.body.find("href=\"/"); at != std::string::npos; at = page.body.find("href=\"/", at + 1)) {
        auto const target = page.body.substr(at + 6, page.body.find('"', at + 6) - at - 6);
        EXPECT_EQ(client.get(target).status, 200) << target;
    }
}

TEST(Page, ReflectsNoMarkup) {
    HttpClient client;
    auto const page = client.say("GET / HTTP/1.1\r\nHost: $(reboot)&lt;script&gt;\r\n\r\n");
    EXPECT_THAT(page.body, testing::Not(HasSubstr("script&gt;")));
    EXPECT_THAT(page.body, HasSubstr("url=http://localhost\n"));
    auto const refused = client.say("GET / HTTP/1.1\r\nHost: <script>alert(1)</script>\r\n\r\n");
    EXPECT_EQ(refused.status, 400);
    EXPECT_THAT(refused.body, testing::Not(HasSubstr("<script")));
}

TEST(Health, IsGood) {
    HttpClient client;
    EXPECT_EQ(client.get("/healthz").status, 200);
    EXPECT_EQ(client.get("/readyz").status, 200);
}

TEST(Metrics, SayThatDocumentsAreCheckedInFullWhenTheyAre) {
    GatewayProcess gateway{{"--validation", "full"}};
    HttpClient client{gateway};
    bind_and_complete(client, 1);
    auto const reply = client.get("/metrics");
    EXPECT_THAT(reply.body, HasSubstr("rois_documents_checked_total{validation=\"fast\"} 0\n"));
    EXPECT_THAT(reply.body, HasSubstr("rois_documents_checked_total{validation=\"full\"} 3\n"));
}

TEST(Metrics, CountWhatHappens) {
    GatewayProcess gateway;
    HttpClient client{gateway};
    bind_and_complete(client, 3);
    client.post("<oops");
    client.notifications(0, 0);
    auto const reply = client.get("/metrics");
    EXPECT_THAT(reply.header("Content-Type"), HasSubstr("text/plain; version=0.0.4"));
    for (auto const* line :
         {"rois_requests_total{operation=\"set_parameter\",return_code=\"OK\"} 3",
          "rois_faults_total{code=\"not_well_formed\"} 1", "rois_sessions 1", "rois_components 15",
          "rois_commands_completed_total{status=\"OK\"} 3", "rois_notifications_delivered_total 3",
          "rois_documents_checked_total{validation=\"fast\"} 5", "rois_documents_checked_total{validation=\"full\"} 1",
          "rois_connections{kind=\"http\"} 1", "rois_request_duration_seconds_count 5", "rois_connections_accepted_total 1"}) {
        EXPECT_THAT(reply.body, HasSubstr(std::string{line} + "\n"));
    }
}

}  // namespace
}  // namespace rois::test
