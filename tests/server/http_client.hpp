// The HTTP client, for the gateways of these tests.
#pragma once

#include "client/http_client.hpp"
#include "server/gateway_process.hpp"

namespace rois::test {

using namespace client;

class HttpClient : public client::HttpClient {
public:
    explicit HttpClient(GatewayProcess const& gateway = shared_gateway()) : client::HttpClient{gateway.address()} {}
};

// Connects, binds a component, and lets `count` notifications be queued: a set_parameter each, which completes at once.
void bind_and_complete(HttpClient&, int count);
void complete(HttpClient&, int count);

}  // namespace rois::test
