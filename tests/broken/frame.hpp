// WebSocket frames as the proxy passes them on, and the sequence in the documents that they carry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "broken/socket.hpp"

namespace rois::broken {

struct Frame {
    std::string bytes;    // all of it, as it came
    std::string payload;  // not masked
    bool is_masked = false;

    bool is_text() const { return static_cast<unsigned char>(bytes[0]) == 0x81; }
};

enum class Masked { no, yes };

std::optional<Frame> read_frame(Socket& from);
std::string frame_of(std::string const& text, Masked);  // a whole text frame

long sequence_of(std::string const& document);  // 0 for what is no notification
std::string with_sequence(std::string const& notification, long sequence);

}  // namespace rois::broken
