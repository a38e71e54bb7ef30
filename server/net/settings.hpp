// The limits and periods of the network layer. Each has a configuration key (main/keys.cpp), except `tick` and `echo`.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gateway/access/addresses.hpp"
#include "types/unique_descriptor.hpp"
#include "xml/codec/codec.hpp"

namespace rois {
class Rights;
class Tokens;
}  // namespace rois

namespace rois::tls {
class Credentials;
}

namespace rois::net {

struct Settings {
    std::string host = "127.0.0.1";  // a name or an address, IPv6 without brackets; empty: no port, only Server::connect
    std::uint16_t port = 8080;       // 0: any free port
    std::size_t threads = 1;
    std::size_t max_connections = 10'000;
    std::size_t max_connections_per_address = 256;
    std::size_t max_sessions_per_address = 64;
    std::size_t max_sessions_per_connection = 16;
    std::size_t max_streams_per_session = 8;  // event streams
    std::vector<Network> proxies;             // their connections are exempt from the four limits above

    std::size_t memory_budget = std::size_t{512} << 20;  // bytes; physical memory of the process

    std::size_t max_header = 16 * 1024;  // bytes of a request line and its header fields
    std::size_t max_header_fields = 100;
    std::size_t max_target = 4 * 1024;  // bytes
    xml::DocumentLimits document;       // `bytes` also limits HTTP bodies and WebSocket messages
    xml::Validation validation = xml::Validation::fast;
    std::size_t max_fragments = 1'024;         // frames of a WebSocket message
    unsigned max_control_frames = 50;          // that a WebSocket may send in a second
    std::size_t max_requests_in_flight = 16;   // of one connection; with more unsent answers, nothing is read
    std::vector<std::string> hosts;            // names of the gateway, in the form of host_name (gateway/access/host_names.hpp)
    std::vector<std::string> allowed_origins;  // of web pages, besides those of the gateway: "https://console.example"

    // Takes the socket of an engine that joins, the bytes received on it, and the rights of its client (null: no limits). Called
    // on an I/O thread. Empty: none may join.
    std::function<void(UniqueDescriptor socket, std::string head, std::shared_ptr<Rights const>)> join;

    // The tokens of the programs that this process starts, which may join; null: it starts none. Must outlive the server.
    Tokens* program_tokens = nullptr;

    std::shared_ptr<tls::Credentials> credentials;  // null: no TLS

    std::chrono::milliseconds handshake_timeout = std::chrono::seconds{5};  // of TLS
    std::chrono::milliseconds request_timeout = std::chrono::seconds{30};   // for a request to arrive completely
    std::chrono::milliseconds connect_timeout = std::chrono::seconds{10};   // for a WebSocket to open a session
    std::chrono::milliseconds idle_timeout = std::chrono::seconds{75};      // of an HTTP connection between two requests
    std::chrono::milliseconds write_timeout = std::chrono::seconds{30};     // for a peer to read the sent data
    std::chrono::milliseconds ping_interval = std::chrono::seconds{20};     // of WebSockets and event streams
    std::chrono::milliseconds max_poll_wait = std::chrono::seconds{30};     // that a long poll may ask for
    std::chrono::milliseconds shutdown_timeout =
        std::chrono::seconds{5};                                     // for clients to read the last notifications, and halts
    std::chrono::milliseconds tick = std::chrono::milliseconds{10};  // of the engine

    // WebSockets return each message instead of answering it. For suites that test WebSockets (tests/transport): the gateway has
    // no key for it.
    bool echo = false;
};

// The present settings with the hosts, origins, limits and periods of others, as far as they can change while the server runs.
inline Settings with_changes(Settings present, Settings const& wanted) {
    auto next = wanted;
    next.host = std::move(present.host);
    next.port = present.port;
    next.threads = present.threads;
    next.join = std::move(present.join);
    next.program_tokens = present.program_tokens;
    next.credentials = std::move(present.credentials);
    next.tick = present.tick;
    return next;
}

}  // namespace rois::net
