// One HTTP connection of a receiver. It answers a single request.
#pragma once

#include <memory>

#include "media/asio.hpp"
#include "media/channel.hpp"
#include "media/settings.hpp"

namespace rois::media {

// Completes when the receiver leaves, the channel ends or the response is complete. The directory and the settings must live
// that long.
Task<> serve_receiver(Socket, Directory const&, Settings const&);

}  // namespace rois::media
