// For an engine that joins over TLS: its WebSocket belongs to another layer, which knows only sockets.
#pragma once

#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include "wire/wire.hpp"

namespace rois::net {

using LocalSocket = asio::basic_stream_socket<asio::local::stream_protocol, Executor>;

// Passes bytes on between the wire and the socket until both have ended. The end of one ends the other.
Task<> relay(Wire&, LocalSocket&);

}  // namespace rois::net
