// The kit's HTTP client for a GatewayProcess.
#pragma once

#include "kit/gateway_process.hpp"
#include "kit/http_client.hpp"

namespace rois::test {

using namespace kit;

class HttpClient : public kit::HttpClient {
public:
    explicit HttpClient(GatewayProcess const& gateway = shared_gateway()) : kit::HttpClient{gateway.address()} {}
};

// Connects, binds a component, and queues `count` notifications: each set_parameter completes at once.
void bind_and_complete(HttpClient&, int count);
void complete(HttpClient&, int count);

// Sends requests without reading answers, until the gateway reads no more.
void stuff(Line&, std::string const& request);

}  // namespace rois::test
