// Sends a channel by RTP.
#pragma once

#include <memory>

#include "media/asio.hpp"
#include "media/channel.hpp"
#include "media/rtp.hpp"

namespace rois::media {

// Completes when the channel ends. RTP does not report receivers, so the channel always counts as received.
Task<> send_by_rtp(std::shared_ptr<Channel>, Datagrams, asio::ip::udp::endpoint, RtpPackets);

}  // namespace rois::media
