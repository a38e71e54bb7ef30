// The opening handshake of a WebSocket (RFC 6455, 4.2), with what wire.md asks beyond it.
#pragma once

#include <string>
#include <string_view>

#include "net/http_answer.hpp"
#include "net/http_head.hpp"

namespace rois::net {

// Answers a GET or HEAD on /rois: status 101 when the connection becomes a WebSocket, a fault otherwise.
HttpAnswer upgrade(RequestHead const&);

// The Sec-WebSocket-Accept that answers this Sec-WebSocket-Key.
std::string websocket_accept(std::string_view key);

// Whether the text has the form of 16 bytes in base64.
bool is_websocket_key(std::string_view text);

}  // namespace rois::net
