#include <gtest/gtest.h>

#include "net/upgrade.hpp"
#include "net/websocket_frames.hpp"

namespace rois::net {
namespace {

TEST(Utf8, IsToldFromWhatIsNot) {
    for (auto const* good : {"", "plain", "\xC2\xA2", "\xE2\x82\xAC", "\xF0\x90\x8D\x88", "a\xED\x9F\xBFz", "\xF4\x8F\xBF\xBF",
                             "12345678\xC2\xA2"}) {
        EXPECT_TRUE(is_utf8(good)) << good;
    }
    for (auto const* bad : {"\x80", "\xC3\x28", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                            "\xF8\x88\x80\x80\x80", "\xE2\x82", "12345678\xC2", "\xFF"}) {
        EXPECT_FALSE(is_utf8(bad)) << bad;
    }
}

TEST(WebSocketKey, IsSixteenBytesInBase64) {
    EXPECT_TRUE(is_websocket_key("dGhlIHNhbXBsZSBub25jZQ=="));
    for (auto const* bad :
         {"", "dGhlIHNhbXBsZSBub25jZQ", "dGhlIHNhbXBsZSBub25jZQ=a", "dGhlIHNhbXBsZSBub25j", "dGhlIHNhbXBsZSBub25jZ!=="}) {
        EXPECT_FALSE(is_websocket_key(bad)) << bad;
    }
    EXPECT_EQ(websocket_accept("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

TEST(Frame, HasTheShortestLength) {
    for (auto const& [size, head] : {std::pair{5u, 2u}, {125u, 2u}, {126u, 4u}, {65'535u, 4u}, {65'536u, 10u}}) {
        std::string out;
        append_frame(out, Opcode::text, std::string(size, 'x'));
        EXPECT_EQ(out.size(), size + head);
    }
}

// A masked frame as a client sends it; the mask is zero.
std::string from_client(unsigned first_byte, std::string const& payload) {
    return std::string{static_cast<char>(first_byte), static_cast<char>(0x80 | payload.size())} + std::string(4, '\0') + payload;
}

std::string next_of(Pings& pings) {
    auto const payload = pings.next();
    return {payload.data(), payload.size()};
}

TEST(Pings, AreAnsweredOnce) {
    Pings pings{1'000'000};
    auto const first = next_of(pings), second = next_of(pings);
    EXPECT_NE(first, second);
    EXPECT_TRUE(pings.take_answer(first));
    EXPECT_FALSE(pings.take_answer(first));
    EXPECT_TRUE(pings.take_answer(second));
    EXPECT_FALSE(pings.take_answer(second));
}

TEST(Pings, AreAnsweredByThePongToALaterOne) {
    Pings pings{1'000'000};
    auto const first = next_of(pings), second = next_of(pings);
    EXPECT_TRUE(pings.take_answer(second));
    EXPECT_FALSE(pings.take_answer(first));
}

TEST(Pings, AreNotAnsweredByPongsThatNobodyAskedFor) {
    Pings pings{1'000'000};
    auto const sent = next_of(pings);
    auto next = Pings{pings};
    auto other = Pings{2'000'000};
    for (auto const& unsolicited :
         {std::string{}, std::string(8, '\0'), sent + "x", sent.substr(1), next_of(next), next_of(other)})
        EXPECT_FALSE(pings.take_answer(unsolicited));
    EXPECT_TRUE(pings.take_answer(sent));
}

TEST(MessageReader, WaitsForTheWholeFrame) {
    MessageReader reader{100, 10};
    auto frame = from_client(0x81, "hello");
    std::size_t used = 0;
    for (std::size_t cut = 0; cut < frame.size(); ++cut) {
        EXPECT_TRUE(std::holds_alternative<MessageReader::Incomplete>(reader.next({frame.data(), cut}, used)));
        EXPECT_EQ(used, 0u);
    }
    auto const heard = reader.next(frame, used);
    EXPECT_EQ(std::get<MessageReader::Text>(heard).text, "hello");
    EXPECT_EQ(used, frame.size());
}

TEST(MessageReader, PutsFragmentsTogetherAroundAPing) {
    MessageReader reader{100, 10};
    std::size_t used = 0;
    auto first = from_client(0x01, "\xE2\x82"), ping = from_client(0x89, "?"), last = from_client(0x80, "\xAC");
    EXPECT_TRUE(std::holds_alternative<MessageReader::Nothing>(reader.next(first, used)));
    EXPECT_TRUE(reader.in_message());
    auto const between = reader.next(ping, used);
    EXPECT_EQ(std::get<MessageReader::Ping>(between).payload, "?");
    auto const heard = reader.next(last, used);
    EXPECT_EQ(std::get<MessageReader::Text>(heard).text, "\xE2\x82\xAC");
    EXPECT_FALSE(reader.in_message());
}

TEST(MessageReader, BoundsTheMessageNotTheFrame) {
    MessageReader reader{100, 10};
    std::size_t used = 0;
    auto half = from_client(0x01, std::string(60, 'x')), more = from_client(0x80, std::string(60, 'x'));
    reader.next(half, used);
    auto const heard = reader.next(more, used);
    EXPECT_EQ(std::get<MessageReader::Violation>(heard).code, CloseCode::message_too_big);
}

}  // namespace
}  // namespace rois::net
