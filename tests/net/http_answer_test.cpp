#include "net/http/http_answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "net/answers.hpp"

namespace rois::net {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(HttpAnswer, IsAnXmlDocumentThatIsNotCached) {
    auto const text = written(HttpAnswer{.body = "<a/>"});
    EXPECT_THAT(text, StartsWith("HTTP/1.1 200 OK\r\nDate: "));
    EXPECT_THAT(text, HasSubstr(" GMT\r\nContent-Type: application/xml; charset=utf-8\r\nCache-Control: no-store\r\n"));
    EXPECT_THAT(text, EndsWith("\r\nContent-Length: 4\r\n\r\n<a/>"));
}

TEST(HttpAnswer, IsWhatItSaysAndNotForPagesOfOthers) {
    auto refused = answer_of({FaultCode::not_found, "nothing"});
    for (auto const& text : {written(HttpAnswer{}), written(refused), written(HttpAnswer{.content_type = "text/event-stream"})}) {
        EXPECT_THAT(text, HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"));
        EXPECT_THAT(text, Not(HasSubstr("Access-Control")));
    }
}

TEST(HttpAnswer, IsWrittenBehindEarlierOnes) {
    std::string out = "before";
    append(out, HttpAnswer{.body = "1"}, {});
    append(out, HttpAnswer{.body = "2"}, {});
    EXPECT_THAT(out, StartsWith("beforeHTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(out, HasSubstr("\r\n\r\n1HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(out, EndsWith("\r\n\r\n2"));
}

TEST(HttpAnswer, HasALengthAlsoIfItIsEmpty) { EXPECT_THAT(written(HttpAnswer{}), EndsWith("Content-Length: 0\r\n\r\n")); }

TEST(HttpAnswer, ToHeadHasTheLengthOfTheBodyWithoutTheBody) {
    EXPECT_THAT(written(HttpAnswer{.body = "<a/>"}, {Framing::Body::omitted}), EndsWith("Content-Length: 4\r\n\r\n"));
}

TEST(HttpAnswer, MayEndTheConnection) {
    EXPECT_THAT(written(HttpAnswer{.body = "<a/>"}), Not(HasSubstr("Connection:")));
    EXPECT_THAT(written(HttpAnswer{.body = "<a/>"}, {Framing::Body::sent, true}), HasSubstr("\r\nConnection: close\r\n"));
}

TEST(HttpAnswer, WithAnEndlessBodyHasNoLength) {
    auto const text = written(HttpAnswer{.content_type = "text/event-stream"}, {Framing::Body::endless, true});
    EXPECT_THAT(text, HasSubstr("Content-Type: text/event-stream\r\n"));
    EXPECT_THAT(text, Not(HasSubstr("Content-Length")));
    EXPECT_THAT(text, EndsWith("\r\nConnection: close\r\n\r\n"));
}

TEST(HttpAnswer, ThatIsNotModifiedHasNeitherBodyNorLength) {
    HttpAnswer answer{.body = "<a/>"};
    answer.fields.set(http::field::etag, "\"1\"");
    auto const text = written(not_modified(std::move(answer)));
    EXPECT_THAT(text, StartsWith("HTTP/1.1 304 Not Modified\r\n"));
    EXPECT_THAT(text, HasSubstr("\r\nETag: \"1\"\r\n"));
    EXPECT_THAT(text, Not(HasSubstr("Content-Length")));
    EXPECT_THAT(text, EndsWith("\r\n\r\n"));
}

TEST(HttpAnswer, HasTheStatusOfItsFault) {
    auto const line = [](FaultCode code) {
        auto const text = written(answer_of({code, "why", {}, {}}));
        return text.substr(9, text.find('\r') - 9);
    };
    EXPECT_EQ(line(FaultCode::not_well_formed), "400 Bad Request");
    EXPECT_EQ(line(FaultCode::forbidden_xml), "400 Bad Request");
    EXPECT_EQ(line(FaultCode::unauthorized), "401 Unauthorized");
    EXPECT_EQ(line(FaultCode::no_session), "403 Forbidden");
    EXPECT_EQ(line(FaultCode::not_allowed), "403 Forbidden");
    EXPECT_EQ(line(FaultCode::not_found), "404 Not Found");
    EXPECT_EQ(line(FaultCode::method_not_allowed), "405 Method Not Allowed");
    EXPECT_EQ(line(FaultCode::too_slow), "408 Request Timeout");
    EXPECT_EQ(line(FaultCode::length_required), "411 Length Required");
    EXPECT_EQ(line(FaultCode::too_large), "413 Content Too Large");
    EXPECT_EQ(line(FaultCode::uri_too_long), "414 URI Too Long");
    EXPECT_EQ(line(FaultCode::unsupported_media_type), "415 Unsupported Media Type");
    EXPECT_EQ(line(FaultCode::invalid), "422 Unprocessable Content");
    EXPECT_EQ(line(FaultCode::upgrade_required), "426 Upgrade Required");
    EXPECT_EQ(line(FaultCode::too_many), "429 Too Many Requests");
    EXPECT_EQ(line(FaultCode::header_too_large), "431 Request Header Fields Too Large");
    EXPECT_EQ(line(FaultCode::shutting_down), "503 Service Unavailable");
}

}  // namespace
}  // namespace rois::net
