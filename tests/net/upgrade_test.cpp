// The opening handshake of a WebSocket (RFC 6455, 4.2).
#include "net/websocket/upgrade.hpp"

#include <gtest/gtest.h>

#include <map>

#include "net/answers.hpp"
#include "net/http/http_head.hpp"

namespace rois::net {
namespace {

// The request of RFC 6455, 1.3, with our subprotocol. An empty value removes the field.
HttpAnswer answer_to(std::map<std::string, std::string> const& changed = {},
                     std::string const& request_line = "GET /rois HTTP/1.1") {
    std::map<std::string, std::string> fields{{"Host", "server.example"},      {"Upgrade", "websocket"},
                                              {"Connection", "Upgrade"},       {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
                                              {"Sec-WebSocket-Version", "13"}, {"Sec-WebSocket-Protocol", "rois.xml.v1"}};
    for (auto const& [name, value] : changed) fields[name] = value;
    auto request = request_line + "\r\n";
    for (auto const& [name, value] : fields)
        if (!value.empty()) request.append(name).append(": ").append(value).append("\r\n");
    RequestHead head;
    EXPECT_FALSE(read_head(request + "\r\n", Settings{}, head));
    return upgrade(head);
}

unsigned status(HttpAnswer const& answer) { return static_cast<unsigned>(answer.status); }
unsigned status(std::map<std::string, std::string> const& changed) { return status(answer_to(changed)); }

TEST(Upgrade, IsAnsweredWithTheFieldsOfRfc6455) {
    auto const answer = answer_to();
    EXPECT_EQ(status(answer), 101U);
    EXPECT_EQ(field(answer, "Upgrade"), "websocket");
    EXPECT_EQ(field(answer, "Connection"), "Upgrade");
    EXPECT_EQ(field(answer, "Sec-WebSocket-Accept"), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
    EXPECT_EQ(field(answer, "Sec-WebSocket-Protocol"), "rois.xml.v1");
    EXPECT_EQ(field(answer, "Sec-WebSocket-Extensions"), "");
    EXPECT_EQ(field(answer, "Content-Type"), "");
    std::string text;
    append(text, answer_to(), {});
    EXPECT_EQ(text.find("Content-Length"), std::string::npos);
}

TEST(Upgrade, IgnoresTheCaseOfItsTokensAndOtherMembers) {
    EXPECT_EQ(status({{"Upgrade", "h2c, WebSocket"}}), 101U);
    EXPECT_EQ(status({{"Connection", "keep-alive, UPGRADE"}}), 101U);
    EXPECT_EQ(status({{"Sec-WebSocket-Protocol", "chat, rois.xml.v1"}}), 101U);
    EXPECT_EQ(status({{"Sec-WebSocket-Extensions", "permessage-deflate"}}), 101U) << "extensions are not negotiated";
}

TEST(Upgrade, NeedsGetAndHttp11) {
    EXPECT_EQ(status(answer_to({}, "HEAD /rois HTTP/1.1")), 426U);
    EXPECT_EQ(status(answer_to({}, "GET /rois HTTP/1.0")), 426U);
}

TEST(Upgrade, NeedsItsFields) {
    EXPECT_EQ(status({{"Upgrade", ""}}), 426U);
    EXPECT_EQ(status({{"Upgrade", "websockets"}}), 426U);
    EXPECT_EQ(status({{"Connection", "keep-alive"}}), 426U);
    EXPECT_EQ(status({{"Sec-WebSocket-Protocol", ""}}), 400U);
    EXPECT_EQ(status({{"Sec-WebSocket-Protocol", "ROIS.XML.V1"}}), 400U) << "case-sensitive";
    EXPECT_EQ(status({{"Sec-WebSocket-Version", ""}}), 400U);
}

TEST(Upgrade, NamesTheVersionThatItSupports) {
    for (auto const* version : {"8", "14", "13, 8", "013"}) {
        auto const answer = answer_to({{"Sec-WebSocket-Version", version}});
        EXPECT_EQ(status(answer), 426U) << version;
        EXPECT_EQ(field(answer, "Sec-WebSocket-Version"), "13");
        EXPECT_EQ(field(answer, "Upgrade"), "websocket");
    }
    EXPECT_EQ(field(answer_to({{"Sec-WebSocket-Version", ""}}), "Sec-WebSocket-Version"), "13");
}

TEST(Upgrade, NeedsAKeyOfSixteenBytes) {
    for (auto const* key : {"", "dGhlIHNhbXBsZSBub25jZQ", "dGhlIHNhbXBsZSBub25jZQ=a", "dGhlIHNhbXBsZSBub25j",
                            "dGhlIHNhbXBsZSBub25jZ!==", "c2hvcnQ="})
        EXPECT_EQ(status({{"Sec-WebSocket-Key", key}}), 400U) << key;
}

}  // namespace
}  // namespace rois::net
