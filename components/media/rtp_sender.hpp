// Sends by RTP.
#pragma once

#include <memory>

#include "media/asio.hpp"
#include "media/channel.hpp"
#include "media/rtp.hpp"

namespace rois::media {

// Until the channel has ended. Whether anybody is there to receive it cannot be known: it counts as received all the time.
Task<> send_by_rtp(std::shared_ptr<Channel>, Datagrams, asio::ip::udp::endpoint, RtpPackets);

}  // namespace rois::media
