// The frames of RFC 6455. The kit writes frames independently of the code that is tested here.
#include "net/websocket/websocket_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>
#include <utility>
#include <vector>

#include "kit/websocket_frames.hpp"
#include "types/text/text_encoding.hpp"

namespace rois::net {
namespace {

using Kind = Received::Kind;

std::string big_endian(std::uint64_t number, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text.push_back(static_cast<char>(number >> (8 * i) & 0xFF));
    return text;
}

// A masked frame, as a client sends it.
std::string frame(unsigned first_byte, std::string_view payload, std::string_view key = "mask") {
    return kit::frame_bytes(first_byte, payload, kit::Masked::yes, key);
}

std::string close_frame(unsigned code, std::string const& reason = "") { return frame(0x88, big_endian(code, 2) + reason); }

// What a new reader makes of one frame.
struct Read {
    Kind kind;
    std::string text;
    CloseCode code;
};
Read read(std::string bytes) {
    MessageReader reader;
    reader.limit(1'000'000, 10);
    std::size_t used = 0;
    auto const received = reader.next(bytes, used);
    return {received.kind, std::string{received.text}, received.code};
}

void expect_violation(std::string const& bytes, CloseCode code, std::string const& why) {
    auto const result = read(bytes);
    EXPECT_EQ(result.kind, Kind::violation) << why;
    EXPECT_EQ(result.code, code) << why;
}

void expect_protocol_error(std::string const& bytes, std::string const& why) {
    expect_violation(bytes, CloseCode::protocol_error, why);
}

TEST(Frame, IsWrittenWithTheShortestLengthAndWithoutAMask) {
    for (std::size_t const size : {0, 125, 126, 65'535, 65'536}) {
        std::string const payload(size, 'x');
        std::string out;
        append_frame(out, Opcode::text, payload);
        EXPECT_TRUE(out == kit::frame_bytes(0x81, payload, kit::Masked::no)) << size;
        std::string head;
        append_text_head(head, size);
        EXPECT_TRUE(head + payload == out) << size;
    }
}

TEST(Frame, OfAPongHasThePayloadOfThePing) {
    std::string out;
    append_frame(out, Opcode::pong, "abc");
    EXPECT_EQ(out,
              "\x8A\x03"
              "abc");
}

TEST(Frame, OfACloseHasACodeAndAReasonThatFits) {
    std::string out;
    append_close(out, CloseCode::policy_violation, "why");
    EXPECT_EQ(out, "\x88\x05\x03\xF0why");
    out.clear();
    append_close(out, CloseCode::normal, std::string(200, 'x'));
    EXPECT_EQ(out, "\x88\x7D\x03\xE8" + std::string(123, 'x'));
}

TEST(MessageReader, WaitsForTheWholeFrame) {
    for (std::size_t const size : {0, 5, 125, 126, 300, 65'535, 65'536}) {
        MessageReader reader;
        reader.limit(100'000, 10);
        auto bytes = frame(0x81, std::string(size, 'x'));
        std::size_t used = 0;
        for (std::size_t cut = 0; cut < bytes.size(); cut += cut < 20 ? 1 : 997) {
            EXPECT_EQ(reader.next({bytes.data(), cut}, used).kind, Kind::nothing) << size << ": " << cut;
            EXPECT_EQ(used, 0u);
        }
        auto const received = reader.next(bytes, used);
        EXPECT_EQ(received.kind, Kind::text);
        EXPECT_TRUE(received.text == std::string(size, 'x'));
        EXPECT_EQ(used, bytes.size());
    }
}

TEST(MessageReader, JoinsFragmentsAroundAPing) {
    MessageReader reader;
    reader.limit(100, 10);
    std::size_t used = 0;
    auto first = frame(0x01, "\xE2\x82"), ping = frame(0x89, "?"), last = frame(0x80, "\xAC");
    EXPECT_EQ(reader.next(first, used).kind, Kind::fragment);
    EXPECT_TRUE(reader.in_message());
    EXPECT_EQ(reader.gathered(), 2u);
    auto const between = reader.next(ping, used);
    EXPECT_EQ(between.kind, Kind::ping);
    EXPECT_EQ(between.text, "?");
    auto const whole = reader.next(last, used);
    EXPECT_EQ(whole.kind, Kind::text);
    EXPECT_EQ(whole.text, "\xE2\x82\xAC");
    EXPECT_FALSE(reader.in_message());
}

TEST(MessageReader, LimitsTheMessageNotTheFrame) {
    MessageReader reader;
    reader.limit(100, 10);
    std::size_t used = 0;
    auto half = frame(0x01, std::string(60, 'x')), more = frame(0x80, std::string(60, 'x'));
    reader.next(half, used);
    auto const received = reader.next(more, used);
    EXPECT_EQ(received.kind, Kind::violation);
    EXPECT_EQ(received.code, CloseCode::message_too_big);
}

TEST(MessageReader, RejectsAMessageThatIsTooLargeByItsHeadAlone) {
    expect_violation("\x81\xFF" + big_endian(1'000'001, 8) + "mask", CloseCode::message_too_big, "1,000,001 bytes");
}

TEST(MessageReader, LimitsTheNumberOfFragments) {
    MessageReader reader;
    reader.limit(100, 10);
    std::size_t used = 0;
    auto first = frame(0x01, "");
    reader.next(first, used);
    auto kind = Kind::fragment;
    int fragments = 1;
    for (; kind == Kind::fragment && fragments < 100; ++fragments) {
        auto more = frame(0x00, "");
        auto const received = reader.next(more, used);
        kind = received.kind;
        if (kind == Kind::violation) {
            EXPECT_EQ(received.code, CloseCode::policy_violation);
        }
    }
    EXPECT_EQ(fragments, 11);
}

TEST(MessageReader, RejectsReservedBits) {
    for (unsigned const bit : {0x40U, 0x20U, 0x10U}) expect_protocol_error(frame(0x81 | bit, "x"), "RSV " + std::to_string(bit));
}

TEST(MessageReader, RejectsUnmaskedFrames) {
    expect_protocol_error("\x81\x02hi", "a text");
    expect_protocol_error(std::string{"\x89\0", 2}, "a ping");
}

TEST(MessageReader, RejectsUnknownOpcodes) {
    for (unsigned const opcode : {3U, 4U, 5U, 6U, 7U, 11U, 12U, 13U, 14U, 15U})
        expect_protocol_error(frame(0x80 | opcode, "x"), "opcode " + std::to_string(opcode));
}

TEST(MessageReader, RejectsBinaryMessages) {
    expect_violation(frame(0x82, "x"), CloseCode::unsupported_data, "whole");
    expect_violation(frame(0x02, "x"), CloseCode::unsupported_data, "fragment");
}

TEST(MessageReader, RejectsFragmentsOutOfOrder) {
    expect_protocol_error(frame(0x80, "x"), "a last fragment without a beginning");
    expect_protocol_error(frame(0x00, "x"), "a fragment without a beginning");
    for (unsigned const first_byte : {0x81U, 0x01U}) {
        MessageReader reader;
        reader.limit(100, 10);
        std::size_t used = 0;
        auto begun = frame(0x01, "x"), again = frame(first_byte, "x");
        reader.next(begun, used);
        EXPECT_EQ(reader.next(again, used).kind, Kind::violation);
    }
}

TEST(MessageReader, RejectsLongAndFragmentedControlFrames) {
    for (unsigned const opcode : {8U, 9U, 10U}) {
        expect_protocol_error(frame(0x80 | opcode, std::string(126, 'x')), "126 bytes");
        expect_protocol_error(frame(opcode, ""), "a fragment");
    }
    EXPECT_EQ(read(frame(0x89, std::string(125, 'x'))).kind, Kind::ping);
    EXPECT_EQ(read(frame(0x8A, std::string(125, 'x'))).kind, Kind::pong);
}

TEST(MessageReader, RejectsLengthsThatAreNotTheShortest) {
    expect_protocol_error("\x81\xFE" + big_endian(125, 2) + "mask" + std::string(125, 'x'), "125 in two bytes");
    expect_protocol_error("\x81\xFF" + big_endian(65'535, 8) + "mask", "65,535 in eight bytes");
    expect_protocol_error("\x81\xFF" + big_endian(std::uint64_t{1} << 63, 8) + "mask", "the highest bit");
}

TEST(MessageReader, RejectsTextThatIsNotUtf8) {
    for (auto const* bad : {"\x80", "\xC3\x28", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "12345678\xC2"})
        expect_violation(frame(0x81, bad), CloseCode::invalid_payload, bad);
    for (auto const* good : {"", "\xC2\xA2", "\xE2\x82\xAC", "\xF0\x90\x8D\x88", "a\xED\x9F\xBFz", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(read(frame(0x81, good)).kind, Kind::text) << good;
}

TEST(MessageReader, ReadsTheCodeOfAClose) {
    for (unsigned const code :
         {1000U, 1001U, 1002U, 1003U, 1007U, 1008U, 1009U, 1010U, 1011U, 1012U, 1014U, 3000U, 3999U, 4000U, 4999U}) {
        auto const result = read(close_frame(code, "bye"));
        EXPECT_EQ(result.kind, Kind::close) << code;
        EXPECT_EQ(static_cast<unsigned>(result.code), code);
    }
    EXPECT_EQ(read(frame(0x88, "")).kind, Kind::close);
    EXPECT_EQ(read(frame(0x88, "")).code, CloseCode::normal) << "without a code";
}

TEST(MessageReader, RejectsCodesThatACloseMustNotHave) {
    for (unsigned const code : {0U, 999U, 1004U, 1005U, 1006U, 1015U, 1016U, 1100U, 2000U, 2999U, 5000U, 65'535U})
        expect_protocol_error(close_frame(code), std::to_string(code));
    expect_protocol_error(frame(0x88, "x"), "one byte");
    expect_violation(close_frame(1000, "\xC3\x28"), CloseCode::invalid_payload, "a reason that is not UTF-8");
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

TEST(Pings, AreNotAnsweredByUnsolicitedPongs) {
    Pings pings{1'000'000};
    auto const sent = next_of(pings);
    auto next = Pings{pings};
    auto other = Pings{2'000'000};
    for (auto const& unsolicited :
         {std::string{}, std::string(8, '\0'), sent + "x", sent.substr(1), next_of(next), next_of(other)})
        EXPECT_FALSE(pings.take_answer(unsolicited));
    EXPECT_TRUE(pings.take_answer(sent));
}

// The frames of a random dialogue, and what they must be read as.
class Dialogue {
public:
    Dialogue(unsigned seed, int messages) : random_{seed} {
        for (int i = 0; i < messages; ++i) add_message();
    }

    std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>{0, limit - 1}(random_); }

    std::string bytes;
    std::deque<std::pair<Kind, std::string>> expected;

private:
    std::string mask() { return big_endian(below(std::size_t{1} << 32), 4); }

    std::string text() {
        static constexpr std::array<std::size_t, 9> sizes{0, 1, 124, 125, 126, 127, 65'534, 65'535, 65'536};
        static constexpr std::array<char const*, 4> characters{"x", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\xA4\x96"};
        auto const size = below(3) == 0 ? sizes.at(below(sizes.size())) : below(400);
        std::string text;
        while (text.size() < size) text += characters.at(below(20) == 0 ? below(4) : 0);
        return text;
    }

    void add_control() {
        bool const ping = below(2) == 0;
        std::string const payload(below(126), '\xFF');
        bytes += frame(ping ? 0x89 : 0x8A, payload, mask());
        expected.emplace_back(ping ? Kind::ping : Kind::pong, payload);
    }

    void add_message() {
        auto const message = text();
        std::size_t begin = 0;
        for (auto fragments = below(4); fragments > 0; --fragments) {
            auto const size = below(message.size() - begin + 1);
            bytes += frame(begin_opcode(begin == 0 && first_), message.substr(begin, size), mask());
            expected.emplace_back(Kind::fragment, "");
            first_ = false;
            begin += size;
            if (below(2) == 0) add_control();
        }
        bytes += frame(0x80 | begin_opcode(first_), message.substr(begin), mask());
        expected.emplace_back(Kind::text, message);
        first_ = true;
    }

    static unsigned begin_opcode(bool first) { return first ? 0x01 : 0x00; }

    std::mt19937 random_;
    bool first_ = true;  // the next frame begins a message
};

// Each seed gives the same dialogue again.
TEST(MessageReader, ReadsRandomDialoguesInRandomPieces) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Dialogue dialogue{seed, 20};
        MessageReader reader;
        reader.limit(1 << 20, 10);
        std::string input;
        for (std::size_t sent = 0; sent < dialogue.bytes.size();) {
            auto const size = std::min(dialogue.bytes.size() - sent, 1 + dialogue.below(3'000));
            input.append(dialogue.bytes, sent, size);
            sent += size;
            std::size_t used = 0;
            for (auto received = reader.next(input, used); received.kind != Kind::nothing; received = reader.next(input, used)) {
                ASSERT_FALSE(dialogue.expected.empty());
                ASSERT_EQ(received.kind, dialogue.expected.front().first) << "seed " << seed;
                ASSERT_TRUE(received.text == dialogue.expected.front().second) << "seed " << seed;
                dialogue.expected.pop_front();
                input.erase(0, used);
            }
        }
        EXPECT_TRUE(dialogue.expected.empty()) << "seed " << seed;
        EXPECT_TRUE(input.empty()) << "seed " << seed;
    }
}

// Changes some bytes of a dialogue at random. With ./dev test --asan, this also finds reads outside of the input.
TEST(MessageReader, SurvivesRandomChanges) {
    for (unsigned seed = 0; seed < 2'000; ++seed) {
        Dialogue dialogue{seed, 4};
        auto input = dialogue.bytes.substr(0, 1 + dialogue.below(2'000));
        for (auto changes = 1 + dialogue.below(5); changes > 0; --changes)
            input[dialogue.below(input.size())] = static_cast<char>(dialogue.below(256));
        MessageReader reader;
        reader.limit(1 << 16, 4);
        for (bool goes_on = true; goes_on;) {
            std::vector<char> exact{input.begin(), input.end()};
            std::size_t used = 0;
            auto const received = reader.next(exact, used);
            ASSERT_LE(used, input.size()) << "seed " << seed;
            if (received.kind == Kind::text) {
                EXPECT_TRUE(is_utf8(received.text)) << "seed " << seed;
                EXPECT_LE(received.text.size(), std::size_t{1} << 16) << "seed " << seed;
            }
            goes_on = used > 0 && received.kind != Kind::violation && received.kind != Kind::close;
            if (goes_on) input.erase(0, used);
        }
    }
}

}  // namespace
}  // namespace rois::net
