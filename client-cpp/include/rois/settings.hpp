// The settings of a connection to an engine.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace rois {

// The transport of documents: messages of one WebSocket, or HTTP requests and an event stream.
enum class Way : std::uint8_t { websocket, http };

// Returns the environment variable ROIS_URL, or http://127.0.0.1:8080 if it is unset or empty.
std::string default_url();

struct Settings {
    // The gateway: "http://host:port" or "ws://..."; with TLS "https://..." or "wss://...". A path is put before /rois.
    std::string url = default_url();
    Way way = Way::websocket;
    std::string token{};             // sent as Authorization: Bearer; empty: none
    std::string ca_file{};           // PEM file of certificates to trust beside the system's; empty: none
    std::string certificate_file{};  // PEM file with the client's own certificate and its key; empty: none
    // The session of another program, to share it; empty: an own session. Uses HTTP, because a WebSocket would take over the
    // session. The connection first receives the notifications that the engine still keeps. It does not end the session, and
    // closes when the session ends.
    std::string session{};

    // How long a robot that this session has set in motion moves on without a sign of life (Connection::alive): at least 1 s, at
    // most the gateway's own lease. Empty: the gateway's lease, by default 2 s.
    std::optional<std::chrono::milliseconds> motion_lease{};

    // Receive each switch of a logical component (the notification Switched), not only those of components that this session has
    // bound with `switching`.
    bool switches = false;

    std::chrono::milliseconds deadline = std::chrono::seconds{10};         // of a call, retries included
    std::chrono::milliseconds connect_deadline = std::chrono::seconds{5};  // of one attempt, TLS and handshake included
    // A WebSocket is pinged after this silence. A link that is silent for twice as long is given up. Event streams have a limit
    // of their own, `stream_silence`: it must exceed the gateway's ping interval of 20 s.
    std::chrono::milliseconds ping_interval = std::chrono::seconds{5};
    std::chrono::milliseconds stream_silence = std::chrono::seconds{45};

    // Pauses between two attempts. No pause: after a link that delivered an answer or a notification, or that lasted for
    // `longest_pause`. `first_pause`: after a link that opened or resumed a session but delivered nothing. Each attempt without a
    // session doubles the pause, up to `longest_pause`. Each pause is shortened at random, by up to a half.
    std::chrono::milliseconds first_pause = std::chrono::milliseconds{100};
    std::chrono::milliseconds longest_pause = std::chrono::seconds{5};
    std::optional<unsigned> attempts{};  // failed attempts in a row after which the connection closes; empty: never

    std::size_t most_waiting = 1'024;           // events that wait in one stream; then the oldest is dropped, reported as a gap
    std::size_t longest_document = 16'000'000;  // bytes; a longer document from the gateway ends the link
};

}  // namespace rois
