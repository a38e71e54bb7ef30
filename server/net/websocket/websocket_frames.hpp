// The frames of a WebSocket (RFC 6455), as a server reads and writes them. docs/websocket-frames.md says why this is not Beast's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rois::net {

enum class Opcode : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

// Why a connection closes (RFC 6455, 7.4.1). A peer may send other values, from 3000 to 4999.
enum class CloseCode : std::uint16_t {
    normal = 1000,
    going_away = 1001,
    protocol_error = 1002,
    unsupported_data = 1003,
    invalid_payload = 1007,
    policy_violation = 1008,
    message_too_big = 1009
};

// Appends a whole frame.
void append_frame(std::string& out, Opcode, std::string_view payload);
// Appends the head of a text frame. The caller appends the payload.
void append_text_head(std::string& out, std::size_t payload_size);
// `reason`: ASCII, at most 123 bytes.
void append_close(std::string& out, CloseCode, std::string_view reason);

// The pings of one connection, and which of them the peer has answered. The payloads are ascending numbers. A pong that answers a
// ping also answers the earlier ones (RFC 6455, 5.5.3). Pongs that answer no ping, or come twice, prove nothing.
class Pings {
public:
    using Payload = std::array<char, sizeof(std::uint64_t)>;

    // `start`: a large number that differs between connections, so that pongs made in advance do not count. A peer can compute
    // the payloads that follow its first ping, but a pong counts only after its ping was sent.
    explicit Pings(std::uint64_t start) : sent_{start}, answered_{start} {}

    // Returns the payload of the next ping, which counts as sent.
    Payload next();

    // Returns whether a pong with this payload answers a ping that no pong has answered before.
    bool take_answer(std::string_view payload);

private:
    std::uint64_t sent_;      // the last ping
    std::uint64_t answered_;  // the last ping that the peer has answered
};

// A frame or a message from a client.
struct Received {
    enum class Kind : std::uint8_t {
        nothing,   // the frame is incomplete
        fragment,  // a frame of a message whose last frame has not arrived
        text,      // a whole message in valid UTF-8
        ping,
        pong,
        close,      // the peer closes the connection: answer with `code`
        violation,  // the peer has broken the protocol or a limit: close with `code`
    } kind = Kind::nothing;
    std::string_view text{};  // of the message, ping or pong; the reason of a violation
    CloseCode code = CloseCode::normal;
};

// Reads the messages of one connection.
class MessageReader {
public:
    // The bytes of a message, and its number of frames.
    void limit(std::size_t max_message, std::size_t max_fragments) {
        max_message_ = max_message;
        max_fragments_ = max_fragments;
    }

    // Reads the frame at the front of `bytes` and unmasks its payload in place. Sets `used` to the size of the frame; 0 if it is
    // incomplete. The result is valid until the bytes change or until the next call.
    Received next(std::span<char> bytes, std::size_t& used);

    // Whether some frames of a message have arrived, but not its last one.
    bool in_message() const { return fragments_ > 0; }
    // The number of bytes in these frames.
    std::size_t gathered() const { return parts_.size(); }

private:
    struct Head;
    std::optional<Received> rejected(Head const&) const;
    static Received take_control(Head const&, std::string_view payload);
    Received take_part(Head const&, std::string_view payload);

    std::size_t max_message_ = 0;
    std::size_t max_fragments_ = 0;
    std::size_t fragments_ = 0;  // of the unfinished message
    std::string parts_;          // its payload so far
    std::string whole_;          // the last message that arrived in fragments
};

}  // namespace rois::net
