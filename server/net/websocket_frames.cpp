#include "net/websocket_frames.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "types/utf8.hpp"

namespace rois::net {

namespace {

constexpr std::uint64_t high_bits = 0x8080808080808080;  // of eight bytes

bool begins_with_eight_of_ascii(std::string_view text) {
    std::uint64_t word = 0;
    if (text.size() < sizeof word) return false;
    text.copy(reinterpret_cast<char*>(&word), sizeof word);
    return (word & high_bits) == 0;
}

void append_head(std::string& out, Opcode opcode, std::size_t size) {
    out.push_back(static_cast<char>(0x80 | static_cast<unsigned>(opcode)));
    int length_bytes = 0;
    if (size < 126) {
        out.push_back(static_cast<char>(size));
    } else if (size < 65'536) {
        out.push_back(126);
        length_bytes = 2;
    } else {
        out.push_back(127);
        length_bytes = 8;
    }
    for (int i = length_bytes - 1; i >= 0; --i) out.push_back(static_cast<char>(size >> (8 * i) & 0xFF));
}

bool may_be_sent(unsigned code) {
    return (code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1014) || (code >= 3000 && code <= 4999);
}

// Says whether what comes out is ASCII.
bool unmask(std::span<char> payload, char const* mask) {
    std::uint32_t four = 0;
    std::memcpy(&four, mask, sizeof four);
    std::uint64_t const key = std::uint64_t{four} << 32 | four;
    std::array<std::uint64_t, 4> words{}, seen{};  // so that the compiler takes sixteen bytes together
    std::size_t i = 0;
    for (; i + sizeof words <= payload.size(); i += sizeof words) {
        std::memcpy(words.data(), payload.data() + i, sizeof words);
        for (auto& word : words) word ^= key;
        for (std::size_t w = 0; w < words.size(); ++w) seen[w] |= words[w];
        std::memcpy(payload.data() + i, words.data(), sizeof words);
    }
    auto all = seen[0] | seen[1] | seen[2] | seen[3];
    for (std::uint64_t eight = 0; i + sizeof eight <= payload.size(); i += sizeof eight) {
        std::memcpy(&eight, payload.data() + i, sizeof eight);
        all |= eight ^= key;
        std::memcpy(payload.data() + i, &eight, sizeof eight);
    }
    for (; i < payload.size(); ++i) all |= static_cast<unsigned char>(payload[i] = static_cast<char>(payload[i] ^ mask[i & 3]));
    return (all & high_bits) == 0;
}

constexpr MessageReader::Violation protocol_error(std::string_view reason) { return {CloseCode::protocol_error, reason}; }

}  // namespace

struct MessageReader::Head {
    Opcode opcode;
    bool last;
    std::size_t size;     // of this head
    std::size_t payload;  // bytes behind it

    bool is_control() const { return opcode >= Opcode::close; }
};

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        if (begins_with_eight_of_ascii(text)) {
            text.remove_prefix(8);
            continue;
        }
        auto const size = first_character(text).length;
        if (size == 0) return false;
        text.remove_prefix(size);
    }
    return true;
}

void append_frame(std::string& out, Opcode opcode, std::string_view payload) {
    append_head(out, opcode, payload.size());
    out.append(payload);
}

void append_text_head(std::string& out, std::size_t payload_size) { append_head(out, Opcode::text, payload_size); }

void append_close(std::string& out, CloseCode code, std::string_view reason) {
    reason = reason.substr(0, 123);
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

std::variant<MessageReader::Incomplete, MessageReader::Head, MessageReader::Violation> MessageReader::read_head(
    std::span<char> bytes) const {
    if (bytes.size() < 2) return Incomplete{};
    auto const at = [&](std::size_t i) { return static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])); };
    if (at(0) & 0x70) return protocol_error("a reserved bit is set");
    if (!(at(1) & 0x80)) return protocol_error("a frame without a mask");
    auto const code = at(0) & 0x0F;
    if ((code > 2 && code < 8) || code > 10) return protocol_error("an unknown kind of frame");
    auto const short_size = at(1) & 0x7F;
    std::size_t const length_bytes = short_size == 126 ? 2 : short_size == 127 ? 8 : 0;
    Head head{static_cast<Opcode>(code), (at(0) & 0x80) != 0, 2 + length_bytes + 4, short_size};
    if (head.is_control() && (!head.last || length_bytes > 0))
        return protocol_error("a control frame in parts or over 125 bytes");
    if (bytes.size() < head.size) return Incomplete{};
    if (length_bytes == 0) return head;
    std::uint64_t size = 0;
    for (std::size_t i = 0; i < length_bytes; ++i) size = size << 8 | at(2 + i);
    if (size < 126 || (length_bytes == 8 && (size < 65'536 || size >> 63)))
        return protocol_error("a length that is not the shortest");
    head.payload = size;
    return head;
}

// What a frame is refused for by its head alone, before its payload is waited for.
MessageReader::Heard MessageReader::refuse(Head const& head) const {
    if (head.is_control()) return Nothing{};
    if (head.opcode == Opcode::binary) return Violation{CloseCode::unsupported_data, "messages are text"};
    if (head.opcode == Opcode::continuation && fragments_ == 0) return protocol_error("a continuation of nothing");
    if (head.opcode == Opcode::text && fragments_ > 0) return protocol_error("a new message inside another");
    if (head.payload > max_message_ - parts_.size()) return Violation{CloseCode::message_too_big, "the message is too large"};
    if (!head.last && fragments_ >= max_fragments_) return Violation{CloseCode::policy_violation, "too many fragments"};
    return Nothing{};
}

MessageReader::Heard MessageReader::next(std::span<char> bytes, std::size_t& used) {
    used = 0;
    if (!whole_.empty()) std::string{}.swap(whole_);
    auto const read = read_head(bytes);
    if (auto const* violation = std::get_if<Violation>(&read)) return *violation;
    if (std::holds_alternative<Incomplete>(read)) return Incomplete{};
    auto const& head = std::get<Head>(read);
    if (auto refused = refuse(head); !std::holds_alternative<Nothing>(refused)) return refused;
    if (bytes.size() - head.size < head.payload) return Incomplete{};
    used = head.size + head.payload;
    auto const payload = bytes.subspan(head.size, head.payload);
    bool const ascii = unmask(payload, bytes.data() + head.size - 4);
    std::string_view const text{payload.data(), payload.size()};
    return head.is_control() ? take_control(head, text) : take_part(head, text, ascii);
}

MessageReader::Heard MessageReader::take_control(Head const& head, std::string_view payload) const {
    if (head.opcode == Opcode::ping) return Ping{payload};
    if (head.opcode == Opcode::pong) return Pong{payload};
    if (payload.empty()) return Closed{CloseCode::normal};
    if (payload.size() == 1) return protocol_error("half a close code");
    auto const code = static_cast<unsigned>(static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]));
    if (!may_be_sent(code)) return protocol_error("a close code that must not be sent");
    if (!is_utf8(payload.substr(2))) return Violation{CloseCode::invalid_payload, "not UTF-8"};
    return Closed{static_cast<CloseCode>(code)};
}

MessageReader::Heard MessageReader::take_part(Head const& head, std::string_view payload, bool ascii) {
    if (!head.last) {
        ++fragments_;
        parts_.append(payload);
        return Nothing{};
    }
    if (fragments_ > 0) {
        fragments_ = 0;
        whole_ = std::move(parts_);
        parts_.clear();
        whole_.append(payload);
        payload = whole_;
        ascii = false;
    }
    if (!ascii && !is_utf8(payload)) return Violation{CloseCode::invalid_payload, "not UTF-8"};
    return Text{payload};
}

}  // namespace rois::net
