// The frames of RFC 6455, as a server reads and writes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace rois::net {

enum class Opcode : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

// Why a connection closes (RFC 6455, 7.4.1).
enum class CloseCode : std::uint16_t {
    normal = 1000,
    going_away = 1001,
    protocol_error = 1002,
    unsupported_data = 1003,
    invalid_payload = 1007,
    policy_violation = 1008,
    message_too_big = 1009
};

bool is_utf8(std::string_view);

void append_frame(std::string& out, Opcode, std::string_view payload);
// The head of a text frame whose payload follows.
void append_text_head(std::string& out, std::size_t payload_size);
void append_close(std::string& out, CloseCode, std::string_view reason);

// The pings of one connection, and which of them its peer has answered. A pong that nobody asked for, or that comes twice, proves
// nothing. Payloads are numbers: one that answers a ping answers the earlier ones, too (RFC 6455, 5.5.3).
class Pings {
public:
    using Payload = std::array<char, sizeof(std::uint64_t)>;

    // `start`: a large number that differs from connection to connection, so that no peer counts its own pongs alike.
    explicit Pings(std::uint64_t start) : sent_{start}, answered_{start} {}

    // The payload of the next ping, which counts as sent.
    Payload next();

    // Whether a pong with this payload answers a ping that no pong has answered before.
    bool take_answer(std::string_view payload);

private:
    std::uint64_t sent_;      // the last one
    std::uint64_t answered_;  // the last one that the peer has answered
};

// Puts the messages of one connection together from its frames.
class MessageReader {
public:
    MessageReader(std::size_t max_message, std::size_t max_fragments)
        : max_message_{max_message}, max_fragments_{max_fragments} {}

    struct Incomplete {};  // more bytes are needed
    struct Text {
        std::string_view text;
    };  // a whole message, valid UTF-8
    struct Ping {
        std::string_view payload;
    };
    struct Pong {
        std::string_view payload;
    };
    struct Nothing {};  // a frame that asks for nothing: part of a message
    struct Closed {
        CloseCode code;
    };  // the peer closes; answer with this code
    struct Violation {
        CloseCode code;
        std::string_view reason;
    };
    using Heard = std::variant<Incomplete, Text, Ping, Pong, Nothing, Closed, Violation>;

    // Reads the frame at the front of `bytes`, whose payload is unmasked in place. `used` becomes its size. Views are good until
    // the bytes change or the next call.
    Heard next(std::span<char> bytes, std::size_t& used);

    // Whether a message has begun whose last fragment is still to come.
    bool in_message() const { return fragments_ > 0; }
    // Bytes of it that have come.
    std::size_t gathered() const { return parts_.size(); }

private:
    struct Head;
    std::variant<Incomplete, Head, Violation> read_head(std::span<char> bytes) const;
    Heard refuse(Head const&) const;
    Heard take_control(Head const&, std::string_view payload) const;
    Heard take_part(Head const&, std::string_view payload, bool ascii);

    std::size_t max_message_;
    std::size_t max_fragments_;
    std::size_t fragments_ = 0;  // of the message that is being put together
    std::string parts_;
    std::string whole_;
};

}  // namespace rois::net
