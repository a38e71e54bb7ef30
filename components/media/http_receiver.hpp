// One who receives over HTTP: a connection, on which one request is answered.
#pragma once

#include <memory>

#include "media/asio.hpp"
#include "media/channel.hpp"
#include "media/settings.hpp"

namespace rois::media {

// Until the receiver, the channel or the answer has come to its end. What is given lives as long.
Task<> serve_receiver(Socket, Directory const&, Settings const&);

}  // namespace rois::media
