// The kit's WebSocket client for a GatewayProcess.
#pragma once

#include "kit/websocket_client.hpp"
#include "server/http_client.hpp"

namespace rois::test {

class WebSocketClient : public kit::WebSocketClient {
public:
    explicit WebSocketClient(GatewayProcess const& gateway = shared_gateway()) : kit::WebSocketClient{gateway.address()} {}
};

void bind_and_complete(WebSocketClient&, int count);

}  // namespace rois::test
