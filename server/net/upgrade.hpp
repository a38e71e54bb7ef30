// The opening handshake of a WebSocket (RFC 6455, 4.2), with what wire.md asks beyond it.
#pragma once

#include "net/http_answer.hpp"
#include "net/http_head.hpp"

namespace rois::net {

// Answers a GET or HEAD on /rois: status 101 when the connection becomes a WebSocket, a fault otherwise.
HttpAnswer upgrade(RequestHead const&);

}  // namespace rois::net
