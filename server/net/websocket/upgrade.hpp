// The opening handshake of a WebSocket (RFC 6455, 4.2), with the additional rules of docs/clients.md.
#pragma once

#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"

namespace rois::net {

// Answers a GET or HEAD of /rois: with status 101 if the connection becomes a WebSocket, otherwise with a fault.
HttpAnswer upgrade(RequestHead const&);

}  // namespace rois::net
