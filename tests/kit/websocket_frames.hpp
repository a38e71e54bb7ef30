// WebSocket frames (RFC 6455, 5.2), written independently of the gateway's own codec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois::kit {

enum class Kind : unsigned { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

constexpr unsigned final_fragment = 0x80;

enum class Masked : bool { no, yes };

// Returns the bytes of a frame. `first_byte` holds FIN, the reserved bits and the opcode.
std::string frame_bytes(unsigned first_byte, std::string_view payload, Masked, std::string_view key = "\x12\x34\x56\x78");

// Returns an unfragmented frame.
inline std::string whole_frame(Kind kind, std::string_view payload, Masked masked) {
    return frame_bytes(final_fragment | static_cast<unsigned>(kind), payload, masked);
}

struct FrameHead {
    unsigned first_byte = 0;
    Masked masked = Masked::no;
    std::size_t size = 0;  // of the head, with the length and the mask
    std::uint64_t payload_size = 0;

    Kind kind() const { return static_cast<Kind>(first_byte & 0x0F); }
    bool is_whole() const { return (first_byte & 0xF0) == final_fragment; }  // not fragmented, no reserved bits
};

// Returns the head at the beginning of `bytes`, or nothing if bytes of it are missing.
std::optional<FrameHead> frame_head(std::string_view bytes);

// Returns the number of bytes of a head that begins with these two.
std::size_t frame_head_size(std::string_view first_two);

// Masks or unmasks a payload.
void mask(std::string& payload, std::string_view key);

}  // namespace rois::kit
