// The network layer's limits and periods, all configurable.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gateway/addresses.hpp"
#include "xml/codec/codec.hpp"

namespace rois::net {

struct Settings {
    std::string host = "127.0.0.1";  // a name or an address; an IPv6 address without its brackets
    std::uint16_t port = 8080;       // 0: any free one
    std::size_t threads = 1;
    std::size_t max_connections = 10'000;
    std::size_t max_connections_per_address = 256;
    std::size_t max_sessions_per_address = 64;
    std::size_t max_sessions_per_connection = 16;
    std::size_t max_streams_per_session = 8;  // event streams
    std::vector<Network> proxies;             // whose connections none of the four limits holds for

    std::size_t memory_budget = std::size_t{512} << 20;  // bytes of memory that the process may use

    std::size_t max_header = 16 * 1024;  // bytes of a request line with its header fields
    std::size_t max_fields = 100;
    std::size_t max_target = 4 * 1024;  // bytes
    xml::DocumentLimits document;       // its `bytes` bound an HTTP body and a WebSocket message
    xml::Validation validation = xml::Validation::fast;
    std::size_t max_fragments = 1'024;         // of a WebSocket message
    std::size_t max_requests_in_flight = 16;   // answers that wait for one connection before it is read again
    std::vector<std::string> hosts;            // names that clients use for the gateway, from host_name (net/foreign.hpp)
    std::vector<std::string> allowed_origins;  // of web pages, beside this server's own: "https://console.example"

    std::chrono::milliseconds request_timeout = std::chrono::seconds{30};  // for a request to arrive whole
    std::chrono::milliseconds connect_timeout = std::chrono::seconds{10};  // for a WebSocket to have a session
    std::chrono::milliseconds idle_timeout = std::chrono::seconds{75};     // of an HTTP connection between two requests
    std::chrono::milliseconds write_timeout = std::chrono::seconds{30};    // for a reader to take what was sent
    std::chrono::milliseconds ping_interval = std::chrono::seconds{20};    // of WebSockets and event streams
    std::chrono::milliseconds shutdown_timeout = std::chrono::seconds{5};  // for clients to take their last notifications
    std::chrono::milliseconds tick = std::chrono::milliseconds{10};        // between two looks of the engine at the clock
};

}  // namespace rois::net
