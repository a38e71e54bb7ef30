// Frames that the proxy passes on, and the sequence number in their documents.
#pragma once

#include <optional>
#include <string>

#include "kit/socket.hpp"
#include "kit/websocket_frames.hpp"

namespace rois::broken {

struct Frame {
    kit::FrameHead head;
    std::string bytes;    // the whole frame, as received
    std::string payload;  // unmasked

    bool is_text() const { return head.is_whole() && head.kind() == kit::Kind::text; }
    bool is_masked() const { return head.masked == kit::Masked::yes; }
};

// Returns nothing if the peer has closed the connection.
std::optional<Frame> read_frame(kit::Socket& from);

long sequence_of(std::string const& document);  // 0 if it is not a notification
std::string with_sequence(std::string const& notification, long sequence);

}  // namespace rois::broken
