// HTTP: rejected requests, their status, and whether the connection stays open (docs/clients.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <map>

#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

std::string head(std::string const& method_and_target, std::string const& lines = "") {
    return method_and_target + " HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n";
}

// Sends the bytes, and expects this fault and the end of the connection.
void expect_end(std::string const& bytes, int status, std::string const& fault) {
    HttpClient client;
    auto const reply = client.say(bytes);
    EXPECT_EQ(reply.status, status) << bytes.substr(0, 100);
    EXPECT_EQ(reply.fault(), fault) << bytes.substr(0, 100);
    EXPECT_EQ(reply.header("Connection"), "close");
    EXPECT_TRUE(client.line().ends());
}

TEST(Http, KeepsTheConnectionAndAnswersInOrder) {
    HttpClient client;
    auto const once =
        head("GET /healthz") + head("GET /nowhere") + head("HEAD /readyz") + head("GET /healthz", "Connection: close\r\n");
    EXPECT_EQ(client.say(once).status, 200);
    EXPECT_EQ(client.read().status, 404);
    auto const headers_only = client.read("HEAD");
    EXPECT_EQ(headers_only.status, 200);
    EXPECT_EQ(headers_only.header("Content-Length"), "6");
    EXPECT_EQ(client.read().header("Connection"), "close");
    EXPECT_TRUE(client.line().ends());
}

// Heads that differ only in the fields for the body and the session.
TEST(Http, DistinguishesSimilarRequests) {
    std::array<HttpClient, 2> applications;
    for (auto& application : applications) application.call("connect");
    auto const post = [&](std::string const& session, std::string const& id, std::string const& blanks) {
        auto const body = request("search", "", {{"request_id", id}}) + blanks;
        return head("POST /rois", "RoIS-Session: " + session +
                                      "\r\nContent-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) + "\r\n") +
               body;
    };
    auto const &first = applications[0].session, &second = applications[1].session;
    std::string const nobody(first.size(), 'x');
    HttpClient client;
    std::string all;
    for (auto const& one : {post(first, "a", ""), post(first, "b", "  "), post(second, "c", "   "), post(nobody, "d", "   "),
                            post(first, "e", std::string(1'000, ' ')), post(first, "f", std::string(100'001, ' '))})
        all += one;
    client.line().send(all + head("GET /healthz") + head("GET /healthz") + post(second, "g", ""));
    for (std::string const id : {"a", "b", "c", "d", "e", "f"}) {
        auto const reply = client.read();
        EXPECT_EQ(reply.status, id == "d" ? 403 : 200) << id;
        EXPECT_EQ(reply.root().attribute("request_id").value(), id);
    }
    EXPECT_EQ(client.read().status, 200);
    EXPECT_EQ(client.read().status, 200);
    EXPECT_EQ(client.read().return_code(), "OK");
}

TEST(Http, TakesARequestByteByByte) {
    HttpClient client;
    auto const body = request("connect");
    for (char const byte : "\r\nPOST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nContent-Length: " +
                               std::to_string(body.size()) + "\r\n\r\n" + body) {
        client.line().send({&byte, 1});
    }
    EXPECT_EQ(client.read().return_code(), "OK");
}

TEST(Http, AnswersWithXmlThatIsNotStored) {
    HttpClient client;
    auto const reply = client.call("connect");
    EXPECT_EQ(reply.header("Content-Type"), "application/xml; charset=utf-8");
    EXPECT_EQ(reply.header("Cache-Control"), "no-store");
    EXPECT_NE(reply.header("Date"), "");
}

TEST(Http, RefusesALargeHeader) {
    expect_end(head("GET /healthz", "X: " + std::string(17 * 1024, 'x') + "\r\n"), 431, "header_too_large");
    std::string fields;
    for (int i = 0; i < 100; ++i) fields += "X-" + std::to_string(i) + ": y\r\n";
    expect_end(head("GET /healthz", fields), 431, "header_too_large");  // 101 fields, with Host
}

TEST(Http, RefusesALongTarget) {
    expect_end(head("GET /" + std::string(5 * 1024, 'x')), 414, "uri_too_long");
    expect_end("GET /" + std::string(20 * 1024, 'x'), 414, "uri_too_long");
}

TEST(Http, RefusesBytesThatAreNotHttp) {
    expect_end("hello\r\n\r\n", 400, "not_well_formed");
    expect_end("GET /healthz HTTP/1.1\r\n\r\n", 400, "not_well_formed");
    expect_end(head("GET /healthz", "Host: another\r\n"), 400, "not_well_formed");
    expect_end(head("GET /healthz", " folded\r\n"), 400, "not_well_formed");
    for (auto const* host : {"a b", "a,b", "user@a", "a/b"})
        expect_end("GET /healthz HTTP/1.1\r\nHost: " + std::string{host} + "\r\n\r\n", 400, "not_well_formed");
    expect_end("GET /healthz HTTP/1.1\nHost: h\n\n", 400, "not_well_formed");
}

TEST(Http, ChecksTheAuthorityOfATargetLikeHost) {
    auto const get = [](std::string const& target) { return head("GET " + target); };
    for (auto const* target : {"http://user@a/healthz", "http://a,b/healthz", "http://a\\b/healthz", "http:///healthz", "http://",
                               "http://?x", "http://a#b/healthz", "HTTPS://user:secret@a"})
        expect_end(get(target), 400, "not_well_formed");
    HttpClient client;
    for (auto const* target : {"http://localhost/healthz", "http://127.0.0.1:81/healthz", "HTTP://[::1]:8080/healthz?x"})
        EXPECT_EQ(client.say(get(target)).status, 200) << target;
    EXPECT_EQ(client.say(head("GET http://localhost")).status, 200) << "the page at /";
}

TEST(Http, TakesTheAuthorityOfATargetBeforeHost) {
    HttpClient client;
    EXPECT_THAT(client.say(head("GET http://127.0.0.1:81/plain")).body, HasSubstr("http://127.0.0.1:81"));
    EXPECT_THAT(client.say(head("GET /plain")).body, HasSubstr("http://localhost"));
}

// The client would read a body as the beginning of the next answer.
TEST(Http, RefusesHeadWithoutABody) {
    auto const length_of = [](HttpReply const& reply) { return std::stoul(reply.header("Content-Length")); };
    for (auto const& [bytes, status] :
         std::map<std::string, int>{{head("HEAD /healthz", "Transfer-Encoding: chunked\r\n"), 411},
                                    {head("HEAD /healthz", "Host: another\r\n"), 400},
                                    {head("HEAD http://user@a/healthz"), 400},
                                    {"HEAD /healthz HTTP/2.0\r\nHost: localhost\r\n\r\n", 400},
                                    {"HEAD /healthz HTTP/1.1\r\n\r\n", 400},
                                    {head("HEAD /healthz", "X: " + std::string(17 * 1024, 'x') + "\r\n"), 431},
                                    {"HEAD /" + std::string(20 * 1024, 'x'), 414},
                                    {head("HEAD /" + std::string(5 * 1024, 'x')), 414},
                                    {head("HEAD /rois", "Content-Length: 9999999\r\n"), 413}}) {
        HttpClient client;
        auto const refused = client.say(bytes, "HEAD");
        EXPECT_EQ(refused.status, status) << bytes.substr(0, 100);
        EXPECT_GT(length_of(refused), 0u);
        EXPECT_TRUE(client.line().ends()) << bytes.substr(0, 100);
    }
    HttpClient after_another;
    EXPECT_EQ(after_another.say(head("HEAD /nowhere"), "HEAD").status, 404);
    EXPECT_EQ(after_another.say(head("HEAD /rois"), "HEAD").status, 426);
    EXPECT_EQ(after_another.say(head("GET /healthz", "Host: another\r\n")).fault(), "not_well_formed") << "this is not HEAD";
}

TEST(Http, RefusesADoubtfulLength) {
    for (auto const* length : {"-1", "1e3", "0x10", "5, 5"}) {
        expect_end(head("POST /rois", "Content-Type: text/xml\r\nContent-Length: " + std::string{length} + "\r\n"), 400,
                   "not_well_formed");
    }
    expect_end(head("POST /rois", "Content-Length: 5\r\nContent-Length: 5\r\n"), 400, "not_well_formed");
}

TEST(Http, WantsALengthInsteadOfATransferEncoding) {
    expect_end(head("POST /rois", "Transfer-Encoding: chunked\r\n") + "0\r\n\r\n", 411, "length_required");
    expect_end(head("POST /rois", "Transfer-Encoding: identity\r\nContent-Length: 5\r\n"), 411, "length_required");
}

TEST(Http, NamesTheMethodsThatItTakes) {
    HttpClient client;
    for (auto const* method : {"PUT", "DELETE", "TRACE", "OPTIONS", "PATCH", "get", "Post"}) {
        auto const reply = client.get("/rois", {}, method);
        EXPECT_EQ(reply.status, 405) << method;
        EXPECT_EQ(reply.fault(), "method_not_allowed") << method;
        EXPECT_EQ(reply.header("Allow"), "GET, HEAD, POST") << method;
    }
    auto const reply = client.say(head("POST /rois/profile", "Content-Length: 2\r\n") + "hi");
    EXPECT_EQ(reply.status, 405);
    EXPECT_EQ(reply.header("Allow"), "GET, HEAD");
    EXPECT_EQ(client.get("/healthz").status, 200);  // the connection still works
}

TEST(Http, ChecksInTheOrderOfTheContract) {
    HttpClient client;
    EXPECT_EQ(client.say(head("PUT /rois", "Content-Length: 2\r\n") + "hi").status, 405);  // before 415
    EXPECT_EQ(client.say(head("POST /rois", "Content-Type: text/plain\r\nContent-Length: 2\r\n") + "hi").status,
              415);                                                                        // before 400
    EXPECT_EQ(client.post("<unknown/>").status, 422);                                      // before 403
    EXPECT_EQ(client.say(head("POST /rois", "Content-Length: 9999999\r\n")).status, 413);  // before 415
}

TEST(Http, AnswersUnknownPathsWith404) {
    HttpClient client;
    for (auto const* path : {"/nowhere", "/rois/", "/rois/profile/", "/rois/profile/unknown", "/rois/schemas/../x",
                             "/rois/schemas/%2e%2e%2fx", "/rois/profile/%0d%0aX:%20y", "/rois/profile/%zz"}) {
        auto const reply = client.get(path);
        EXPECT_EQ(reply.status, 404) << path;
        EXPECT_EQ(reply.fault(), "not_found") << path;
    }
    EXPECT_EQ(client.get("/rois/profile/unknown").reason(), "unknown component 'unknown'; /rois/profile lists the components");
    EXPECT_EQ(client.get("/rois/schemas/x%0ay.xsd").reason(), "unknown schema 'x y.xsd'; /rois/schemas lists the schemas");
}

TEST(Http, BoundsTheBody) {
    std::string const document = request("connect");
    auto const padded = [&](std::size_t size) { return document + std::string(size - document.size(), ' '); };
    HttpClient client;
    EXPECT_EQ(client.post(padded(1 << 20)).status, 200);
    auto const reply = client.post(padded((1 << 20) + 1));
    EXPECT_EQ(reply.status, 413);
    EXPECT_EQ(reply.fault(), "too_large");
    EXPECT_THAT(reply.reason(), HasSubstr("1048576"));
    EXPECT_TRUE(client.line().ends());
}

TEST(Http, AsksForABodyThatTheClientHoldsBack) {
    HttpClient client;
    auto const body = request("connect");
    auto const lines = "Content-Type: text/xml\r\nExpect: 100-continue\r\nContent-Length: ";
    EXPECT_EQ(client.say(head("POST /rois", lines + std::to_string(body.size()) + "\r\n")).status, 100);
    EXPECT_EQ(client.say(body).return_code(), "OK");
    EXPECT_EQ(client.say(head("POST /rois", lines + std::string{"9999999\r\n"})).status, 413);
}

TEST(Http, TakesXmlOnly) {
    HttpClient client;
    for (auto const* type :
         {"application/xml", "text/xml; charset=utf-8", "application/soap+xml;charset=\"UTF-8\"", "Text/XML;version=1"}) {
        EXPECT_EQ(client.post(request("connect"), {{"Content-Type", type}}).status, 200) << type;
    }
    for (auto const* type : {"text/plain", "application/json", "application/x-www-form-urlencoded",
                             "application/xml; charset=utf-16", "text/xml;charset=iso-8859-1", "xml", "image/+xml"}) {
        auto const reply = client.post(request("connect"), {{"Content-Type", type}});
        EXPECT_EQ(reply.status, 415) << type;
        EXPECT_EQ(reply.fault(), "unsupported_media_type") << type;
        EXPECT_THAT(reply.reason(), HasSubstr("expected application/xml"));
    }
    EXPECT_EQ(client.post(request("connect"), {}).status, 415);
}

// At all sizes around the receive buffer's (1,024 bytes, doubled as needed), with and without a peer that has closed its side.
TEST(Http, AnswersRequestsOfAnySizeAndAPeerThatHasClosedItsSide) {
    for (std::size_t const size : {1023, 1024, 1025, 2047, 2048, 2049, 4096, 65'536, 65'537}) {
        auto const post = [&](std::size_t blanks) {
            auto const body = request("connect") + std::string(blanks, ' ');
            return head("POST /rois", "Content-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) + "\r\n") + body;
        };
        std::size_t blanks = 0;
        while (post(blanks).size() < size) ++blanks;
        HttpClient goes_on, says_no_more;
        EXPECT_EQ(goes_on.say(post(blanks) + post(blanks)).return_code(), "OK") << size;
        EXPECT_EQ(goes_on.say("").return_code(), "OK") << size;
        EXPECT_EQ(goes_on.say(post(blanks)).return_code(), "OK") << size;
        says_no_more.line().send(post(blanks));
        says_no_more.line().finish();
        EXPECT_EQ(says_no_more.say("").return_code(), "OK") << size;
        EXPECT_TRUE(says_no_more.line().ends()) << size;
    }
}

// Also when the request has filled the receive buffer.
TEST(Http, ClosesAStreamWhosePeerHasGone) {
    GatewayProcess const gateway;
    HttpClient session{gateway};
    session.call("connect");
    for (std::size_t const size : {1000, 1024}) {
        auto const stream = [&](std::size_t padding) {
            return head("GET /rois/notifications", "Accept: text/event-stream\r\nRoIS-Session: " + session.session +
                                                       "\r\nX: " + std::string(padding, 'x') + "\r\n");
        };
        {
            HttpClient reader{gateway};
            reader.line().send(stream(size - stream(0).size()));
            reader.line().take_until("text/event-stream");
        }
        auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{5};
        auto const gone = [&] {
            return session.get("/metrics").body.find("rois_connections{kind=\"stream\"} 0\n") != std::string::npos;
        };
        bool seen = gone();
        while (!seen && std::chrono::steady_clock::now() < until) seen = gone();
        EXPECT_TRUE(seen) << size;
    }
}

TEST(Http, ServesHttp10AndEndsTheConnection) {
    HttpClient client;
    EXPECT_EQ(client.say("GET /healthz HTTP/1.0\r\n\r\n").status, 200);
    EXPECT_TRUE(client.line().ends());
}

}  // namespace
}  // namespace rois::test
