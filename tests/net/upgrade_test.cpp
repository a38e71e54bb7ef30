// The opening handshake of a WebSocket (RFC 6455, 4.2).
#include "net/websocket/upgrade.hpp"

#include <gtest/gtest.h>

#include <map>

namespace rois::net {
namespace {

// The request of RFC 6455, 1.3, with our subprotocol. An empty value removes the field.
HttpAnswer answer_to(std::map<std::string, std::string> const& changed = {}, http::verb method = http::verb::get,
                     unsigned version = 11) {
    std::map<std::string, std::string> fields{{"Host", "server.example"},      {"Upgrade", "websocket"},
                                              {"Connection", "Upgrade"},       {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
                                              {"Sec-WebSocket-Version", "13"}, {"Sec-WebSocket-Protocol", "rois.xml.v1"}};
    for (auto const& [name, value] : changed) fields[name] = value;
    RequestHead head;
    head.message.method(method);
    head.message.version(version);
    head.message.target("/rois");
    for (auto const& [name, value] : fields)
        if (!value.empty()) head.message.insert(name, value);
    return upgrade(head);
}

unsigned status(std::map<std::string, std::string> const& changed) { return answer_to(changed).message.result_int(); }

std::string field(HttpAnswer const& answer, std::string_view name) { return std::string{answer.message[name]}; }

TEST(Upgrade, IsAnsweredAsTheStandardSays) {
    auto const answer = answer_to();
    EXPECT_EQ(answer.message.result_int(), 101U);
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
    EXPECT_EQ(answer_to({}, http::verb::head).message.result_int(), 426U);
    EXPECT_EQ(answer_to({}, http::verb::get, 10).message.result_int(), 426U);
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
        EXPECT_EQ(answer.message.result_int(), 426U) << version;
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
