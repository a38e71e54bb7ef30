#include "kit/websocket_frames.hpp"

namespace rois::kit {

namespace {

constexpr std::size_t key_bytes = 4;
constexpr unsigned mask_bit = 0x80;
constexpr unsigned two_bytes = 126;
constexpr unsigned eight_bytes = 127;

unsigned byte(std::string_view bytes, std::size_t index) { return static_cast<unsigned char>(bytes[index]); }

// The number of bytes of the extended length.
std::size_t length_bytes(unsigned second_byte) {
    auto const length = second_byte & ~mask_bit;
    if (length < two_bytes) return 0;
    return length == two_bytes ? 2 : 8;
}

}  // namespace

std::string frame_bytes(unsigned first_byte, std::string_view payload, Masked masked, std::string_view key) {
    auto const length = payload.size() < two_bytes ? payload.size() : payload.size() < 65'536 ? two_bytes : eight_bytes;
    auto const second_byte = static_cast<unsigned>(length) | (masked == Masked::yes ? mask_bit : 0);
    std::string frame{static_cast<char>(first_byte), static_cast<char>(second_byte)};
    for (auto i = length_bytes(second_byte); i-- > 0;) frame.push_back(static_cast<char>(payload.size() >> (8 * i)));
    if (masked == Masked::no) return frame.append(payload);
    std::string hidden{payload};
    mask(hidden, key);
    return frame.append(key).append(hidden);
}

std::size_t frame_head_size(std::string_view first_two) {
    auto const second_byte = byte(first_two, 1);
    return 2 + length_bytes(second_byte) + ((second_byte & mask_bit) != 0 ? key_bytes : 0);
}

std::optional<FrameHead> frame_head(std::string_view bytes) {
    if (bytes.size() < 2 || bytes.size() < frame_head_size(bytes)) return {};
    auto const second_byte = byte(bytes, 1);
    FrameHead head{.first_byte = byte(bytes, 0),
                   .masked = (second_byte & mask_bit) != 0 ? Masked::yes : Masked::no,
                   .size = frame_head_size(bytes),
                   .payload_size = second_byte & ~mask_bit};
    if (auto const digits = length_bytes(second_byte); digits > 0) {
        head.payload_size = 0;
        for (std::size_t i = 0; i < digits; ++i) head.payload_size = head.payload_size << 8 | byte(bytes, 2 + i);
    }
    return head;
}

void mask(std::string& payload, std::string_view key) {
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(payload[i] ^ key[i % key.size()]);
}

}  // namespace rois::kit
