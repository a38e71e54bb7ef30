// The WebSocket client, for the gateways of these tests.
#pragma once

#include "client/websocket_client.hpp"
#include "server/http_client.hpp"

namespace rois::test {

class WebSocketClient : public client::WebSocketClient {
public:
    explicit WebSocketClient(GatewayProcess const& gateway = shared_gateway()) : client::WebSocketClient{gateway.address()} {}
};

void bind_and_complete(WebSocketClient&, int count);

}  // namespace rois::test
