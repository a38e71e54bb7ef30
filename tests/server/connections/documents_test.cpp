// Documents that need no session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "gateway/access/secrets.hpp"
#include "net/http/documents.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"
#include "net/http/routes.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Document, IsNotSentAgainToAClientThatHasIt) {
    HttpClient client;
    for (auto const* path :
         {"/", "/plain", "/rois/profile", "/rois/profile/move", "/rois/schemas", "/rois/schemas/rois.xsd", "/rois/map"}) {
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
    for (std::string const name : {"rois.xsd", "messages.xsd", "fes.xsd", "gml.xsd", "unr.xsd", "map.xsd"}) {
        EXPECT_THAT(list.body, HasSubstr("\"/rois/schemas/" + name + "\""));
        EXPECT_STREQ(client.get("/rois/schemas/" + name).root().name(), "xsd:schema") << name;
    }
}

// The floor map of a gateway.
struct Map {
    explicit Map(HttpClient& client) : reply{client.get("/rois/map")} { document.load_string(reply.body.c_str()); }

    pugi::xml_node root() const { return document.document_element(); }
    // Returns this attribute of all elements with this name.
    std::vector<std::string> all(char const* element, char const* attribute) const {
        std::vector<std::string> values;
        for (auto const node : root().children(element)) values.emplace_back(node.attribute(attribute).value());
        return values;
    }

    HttpReply reply;
    pugi::xml_document document;
};

TEST(FloorMap, ShowsTheHallAsItIsBuilt) {
    HttpClient client;
    Map const map{client};
    EXPECT_EQ(map.reply.status, 200);
    EXPECT_EQ(map.reply.header("Content-Type"), "application/xml; charset=utf-8");
    EXPECT_STREQ(map.root().name(), "floor_map");
    EXPECT_STREQ(map.root().attribute("xmlns").value(), "urn:x-rois:map:1");
    EXPECT_STREQ(map.root().attribute("name").value(), "Reception hall");
    EXPECT_STREQ(map.root().attribute("crs").value(), "urn:x-rois:def:crs:simulation::hall");
    EXPECT_THAT(map.all("bounds", "width"), ElementsAre("20000"));
    EXPECT_THAT(map.all("wall", "x1"), ElementsAre("15000", "15000", "15000", "3000"));
    EXPECT_THAT(map.all("furniture", "depth"), ElementsAre("800", "3000"));
    EXPECT_THAT(map.all("place", "name"),
                ElementsAre("entrance", "exit", "desk", "start", "waiting_area", "exhibit", "meeting_room", "cloakroom"));
    EXPECT_THAT(map.all("robot", "name"), ElementsAre("robot1"));
    EXPECT_FALSE(map.root().child("robot").child("frame")) << "the robot has no map of its own";
}

TEST(FloorMap, ShowsTheFramesOfRobots) {
    GatewayProcess gateway{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml"}};
    HttpClient client{gateway};
    Map const map{client};
    EXPECT_THAT(map.all("robot", "name"), ElementsAre("robot1", "robot2"));
    auto const frame = map.root().find_child_by_attribute("robot", "name", "robot2").child("frame");
    EXPECT_STREQ(frame.attribute("crs").value(), "urn:x-rois:def:crs:simulation::robot2_map");
    EXPECT_STREQ(frame.attribute("x").value(), "20000");
    EXPECT_STREQ(frame.attribute("heading").value(), "90");
}

// The hall always has a map; this engine has none.
TEST(FloorMap, OfAnEngineWithoutOneIsNotFound) {
    xml::Platform const platform;
    xml::Schemas const schemas{{}};
    Readers readers;
    Engine engine{{}, {}, {}, readers, fresh_secret};
    Telemetry telemetry;
    Gateway gateway{engine, readers, telemetry};
    net::Documents const documents{gateway, telemetry, schemas, {}};
    auto const answer = documents.answer(net::route_of("/rois/map"), {}, nullptr);
    EXPECT_EQ(answer.status, net::http::status::not_found);
    ASSERT_TRUE(answer.fault);
    EXPECT_EQ(answer.fault->code, FaultCode::not_found);
    EXPECT_THAT(answer.body, HasSubstr("this engine has no floor map"));
}

TEST(Page, LinksToExistingDocumentsAndShowsTheAddressOfTheRequest) {
    GatewayProcess const gateway{{"--hosts", "robot.example"}};
    HttpClient client{gateway};
    auto const page = client.say("GET /plain HTTP/1.1\r\nHost: robot.example:8080\r\n\r\n");
    EXPECT_THAT(page.header("Content-Type"), HasSubstr("text/html"));
    EXPECT_THAT(page.header("Content-Security-Policy"),
                ContainsRegex("default-src 'none'; style-src 'sha256-[A-Za-z0-9+/]{43}='"));
    EXPECT_THAT(page.body, HasSubstr("url=http://robot.example:8080\n"));
    EXPECT_THAT(page.body, Not(HasSubstr("{{")));
    for (std::size_t at = page.body.find("href=\"/"); at != std::string::npos; at = page.body.find("href=\"/", at + 1)) {
        auto const target = page.body.substr(at + 6, page.body.find('"', at + 6) - at - 6);
        EXPECT_EQ(client.get(target).status, 200) << target;
    }
}

TEST(Page, ReflectsNoMarkup) {
    HttpClient client;
    auto const page = client.say("GET /plain HTTP/1.0\r\n\r\n");
    EXPECT_THAT(page.body, HasSubstr("url=http://localhost\n"));
    auto const misdirected = HttpClient{}.say("GET /plain HTTP/1.1\r\nHost: $(reboot)&lt;script&gt;\r\n\r\n");
    EXPECT_EQ(misdirected.status, 421);
    EXPECT_THAT(misdirected.body, Not(HasSubstr("&lt;script")));
    auto const refused = HttpClient{}.say("GET / HTTP/1.1\r\nHost: <script>alert(1)</script>\r\n\r\n");
    EXPECT_EQ(refused.status, 400);
    EXPECT_THAT(refused.body, Not(HasSubstr("<script")));
}

TEST(Metrics, CountFullyCheckedDocuments) {
    GatewayProcess gateway{{"--validation", "full"}};
    HttpClient client{gateway};
    bind_and_complete(client, 1);
    auto const reply = client.get("/metrics");
    EXPECT_THAT(reply.body, HasSubstr("rois_documents_checked_total{validation=\"fast\"} 0\n"));
    EXPECT_THAT(reply.body, HasSubstr("rois_documents_checked_total{validation=\"full\"} 3\n"));
}

TEST(Metrics, CountRequestsFaultsAndConnections) {
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

TEST(Metrics, NameTheSessionThatHasBoundAComponent) {
    GatewayProcess gateway;
    HttpClient first{gateway}, second{gateway}, third{gateway};
    first.call("connect");
    second.call("connect");
    second.call("bind", component_ref("navigation"));
    second.call("bind", component_ref("move"));
    third.call("connect");
    third.call("bind", component_ref("reaction"));
    third.call("disconnect");
    auto const text = first.get("/metrics").body;
    EXPECT_THAT(text, HasSubstr("rois_component_bound{component_ref=\"move\",session=\"2\"} 1\n"
                                "rois_component_bound{component_ref=\"navigation\",session=\"2\"} 1\n#"))
        << "and nothing else";
    EXPECT_THAT(text, ContainsRegex("rois_session_age_seconds\\{session=\"1\"\\} [0-9.e-]+\nrois_session_age_seconds"
                                    "\\{session=\"2\"\\} [0-9.e-]+\n#"));
    for (auto const& session : {first.session, second.session}) EXPECT_THAT(text, Not(HasSubstr(session))) << "ids are secrets";
}

TEST(Metrics, HaveTheLimitsAndHowOftenTheyWereReached) {
    GatewayProcess gateway{{"--max-sessions", "1", "--max-connections", "2"}};
    HttpClient desk{gateway}, guest{gateway};
    desk.call("connect");
    desk.call("bind", component_ref("navigation"));
    EXPECT_EQ(guest.call("connect").fault(), "too_many");
    EXPECT_EQ(guest.call("connect").fault(), "too_many");
    auto const reply = desk.get("/metrics");
    for (auto const* line :
         {"rois_limit{limit=\"sessions\"} 1", "rois_limit_reached_total{limit=\"sessions\"} 2",
          "rois_limit{limit=\"connections\"} 2", "rois_limit{limit=\"connections_per_address\"} 256",
          "rois_limit{limit=\"sessions_per_address\"} 64", "rois_limit{limit=\"sessions_per_connection\"} 16",
          "rois_limit{limit=\"streams_per_session\"} 8", "rois_limit{limit=\"commands\"} 1024",
          "rois_limit_reached_total{limit=\"commands\"} 0", "rois_limit{limit=\"subscribed_predicates\"} 10000",
          "rois_limit{limit=\"waiting_notifications\"} 1024", "rois_session_commands{session=\"1\"} 0",
          "rois_session_subscriptions{session=\"1\"} 0", "rois_session_notifications_waiting{session=\"1\"} 0"})
        EXPECT_THAT(reply.body, HasSubstr(std::string{line} + "\n"));
    EXPECT_THAT(reply.body, ContainsRegex("rois_limit_reached_total\\{limit=\"connections\"\\} [01]\n"));
}

// docs/metrics.md has a line for each family of metrics, and no other lines.
TEST(Metrics, AreAllDocumented) {
    GatewayProcess gateway;
    HttpClient client{gateway};
    client.call("connect");
    std::set<std::string> served, documented;
    std::istringstream text{client.get("/metrics").body};
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("# TYPE ")) served.insert(line.substr(7, line.find(' ', 7) - 7));
    std::ifstream document{ROIS_SOURCE_DIR "/docs/metrics.md"};
    for (std::string line; std::getline(document, line);)
        if (line.starts_with("| `")) documented.insert(line.substr(3, line.find_first_of("{`", 3) - 3));
    EXPECT_EQ(served, documented);
}

}  // namespace
}  // namespace rois::test
