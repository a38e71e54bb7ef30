#include "net/websocket/websocket_frames.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "types/text/text_encoding.hpp"

namespace rois::net {

namespace {

constexpr std::size_t mask_size = 4;
constexpr std::size_t longest_control = 125;  // bytes of payload, also the longest length in the second byte of a frame
constexpr unsigned two_byte_length = 126;     // in the second byte: the length follows in two bytes
constexpr unsigned eight_byte_length = 127;

void append_head(std::string& out, Opcode opcode, std::size_t size) {
    out.push_back(static_cast<char>(0x80 | static_cast<unsigned>(opcode)));
    int length_bytes = 0;
    if (size <= longest_control) {
        out.push_back(static_cast<char>(size));
    } else if (size <= 0xFFFF) {
        out.push_back(static_cast<char>(two_byte_length));
        length_bytes = 2;
    } else {
        out.push_back(static_cast<char>(eight_byte_length));
        length_bytes = 8;
    }
    for (int i = length_bytes - 1; i >= 0; --i) out.push_back(static_cast<char>(size >> (8 * i) & 0xFF));
}

// Returns whether a close frame may have this code (RFC 6455, 7.4; 1012 to 1014 are registered at IANA).
bool may_be_sent(unsigned code) {
    return (code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1014) || (code >= 3000 && code <= 4999);
}

// Eight bytes at a time: byte by byte, a long message would cost a tenth more.
void unmask(std::span<char> payload, std::array<char, mask_size> mask) {
    std::array<char, 2 * mask_size> twice{};
    std::ranges::copy(mask, std::ranges::copy(mask, twice.begin()).out);
    std::uint64_t key = 0;
    std::memcpy(&key, twice.data(), sizeof key);
    std::size_t i = 0;
    for (std::uint64_t word = 0; i + sizeof word <= payload.size(); i += sizeof word) {
        std::memcpy(&word, payload.data() + i, sizeof word);
        word ^= key;
        std::memcpy(payload.data() + i, &word, sizeof word);
    }
    for (; i < payload.size(); ++i) payload[i] = static_cast<char>(payload[i] ^ mask[i % mask_size]);
}

Received violation(CloseCode code, std::string_view reason) { return {Received::Kind::violation, reason, code}; }
Received protocol_error(std::string_view reason) { return violation(CloseCode::protocol_error, reason); }

}  // namespace

struct MessageReader::Head {
    Opcode opcode = Opcode::continuation;
    bool last = false;
    std::size_t size = 0;       // of this head
    std::uint64_t payload = 0;  // bytes behind the head
    std::string_view error{};   // set: the head is invalid

    static Head error_of(std::string_view error) { return {.error = error}; }
    bool is_control() const { return opcode >= Opcode::close; }

    // Returns a head of size 0 if it is incomplete.
    static Head read(std::span<char const> bytes) {
        if (bytes.size() < 2) return {};
        auto const at = [&](std::size_t i) { return static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])); };
        if (at(0) & 0x70) return error_of("a reserved bit is set");
        if (!(at(1) & 0x80)) return error_of("a frame of a client must be masked");
        auto const opcode = at(0) & 0x0F;
        if ((opcode > 2 && opcode < 8) || opcode > 10) return error_of("an unknown opcode");
        auto const length = at(1) & 0x7F;
        std::size_t const length_bytes = length == two_byte_length ? 2 : length == eight_byte_length ? 8 : 0;
        Head head{static_cast<Opcode>(opcode), (at(0) & 0x80) != 0, 2 + length_bytes + mask_size, length};
        if (head.is_control() && (!head.last || length_bytes > 0))
            return error_of("a control frame must have at most 125 bytes and must not be fragmented");
        if (bytes.size() < head.size) return {};
        if (length_bytes == 0) return head;
        head.payload = 0;
        for (std::size_t i = 0; i < length_bytes; ++i) head.payload = head.payload << 8 | at(2 + i);
        bool const shortest = head.payload > (length_bytes == 2 ? longest_control : 0xFFFF);
        if (!shortest || head.payload >> 63) return error_of("the length is not in the shortest form");
        return head;
    }
};

void append_frame(std::string& out, Opcode opcode, std::string_view payload) {
    append_head(out, opcode, payload.size());
    out.append(payload);
}

void append_text_head(std::string& out, std::size_t payload_size) { append_head(out, Opcode::text, payload_size); }

void append_close(std::string& out, CloseCode code, std::string_view reason) {
    reason = reason.substr(0, longest_control - 2);
    append_head(out, Opcode::close, reason.size() + 2);
    out.push_back(static_cast<char>(static_cast<unsigned>(code) >> 8));
    out.push_back(static_cast<char>(static_cast<unsigned>(code) & 0xFF));
    out.append(reason);
}

Pings::Payload Pings::next() {
    Payload payload{};
    ++sent_;
    std::memcpy(payload.data(), &sent_, payload.size());
    return payload;
}

bool Pings::take_answer(std::string_view payload) {
    std::uint64_t number = 0;
    if (payload.size() != sizeof number) return false;
    std::memcpy(&number, payload.data(), sizeof number);
    if (number <= answered_ || number > sent_) return false;
    answered_ = number;
    return true;
}

Received MessageReader::next(std::span<char> bytes, std::size_t& used) {
    used = 0;
    if (!whole_.empty()) std::string{}.swap(whole_);
    auto const head = Head::read(bytes);
    if (!head.error.empty()) return protocol_error(head.error);
    if (head.size == 0) return {};
    if (auto const violation = rejected(head)) return *violation;
    if (bytes.size() - head.size < head.payload) return {};
    used = head.size + head.payload;
    auto const payload = bytes.subspan(head.size, head.payload);
    std::array<char, mask_size> mask{};
    std::ranges::copy(bytes.subspan(head.size - mask_size, mask_size), mask.begin());
    unmask(payload, mask);
    std::string_view const text{payload.data(), payload.size()};
    return head.is_control() ? take_control(head, text) : take_part(head, text);
}

// Checks the head alone, before its payload has arrived.
std::optional<Received> MessageReader::rejected(Head const& head) const {
    if (head.is_control()) return {};
    if (head.opcode == Opcode::binary) return violation(CloseCode::unsupported_data, "a binary message: expected text");
    if (head.opcode == Opcode::continuation && fragments_ == 0)
        return protocol_error("a continuation frame without a message to continue");
    if (head.opcode == Opcode::text && fragments_ > 0)
        return protocol_error("a new message before the last fragment of another one");
    if (head.payload > max_message_ - parts_.size())
        return violation(CloseCode::message_too_big, "the message is longer than max_body allows");
    if (fragments_ >= max_fragments_)
        return violation(CloseCode::policy_violation, "the message has more frames than max_fragments allows");
    return {};
}

Received MessageReader::take_control(Head const& head, std::string_view payload) {
    if (head.opcode == Opcode::ping) return {Received::Kind::ping, payload};
    if (head.opcode == Opcode::pong) return {Received::Kind::pong, payload};
    if (payload.empty()) return {Received::Kind::close, {}, CloseCode::normal};
    if (payload.size() == 1) return protocol_error("a close frame with one byte: expected none, or a code of two bytes");
    auto const code = static_cast<unsigned>(static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]));
    if (!may_be_sent(code)) return protocol_error("this close code must not be sent");
    if (!is_utf8(payload.substr(2))) return violation(CloseCode::invalid_payload, "the reason of the close frame is not UTF-8");
    return {Received::Kind::close, {}, static_cast<CloseCode>(code)};
}

Received MessageReader::take_part(Head const& head, std::string_view payload) {
    if (!head.last) {
        ++fragments_;
        parts_.append(payload);
        return {Received::Kind::fragment};
    }
    if (fragments_ > 0) {
        fragments_ = 0;
        whole_ = std::exchange(parts_, {});
        whole_.append(payload);
        payload = whole_;
    }
    if (!is_utf8(payload)) return violation(CloseCode::invalid_payload, "the message is not UTF-8");
    return {Received::Kind::text, payload};
}

}  // namespace rois::net
