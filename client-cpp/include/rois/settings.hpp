// What a connection to an engine is told.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace rois {

// How documents travel: as frames of one WebSocket, or as HTTP requests beside an event stream.
enum class Way : std::uint8_t { websocket, http };

// ROIS_URL of the environment; http://127.0.0.1:8080 when it is not set or empty.
std::string default_url();

struct Settings {
    // Where the gateway is: "http://host:port" or "ws://...", "https://..." or "wss://..." with TLS; a path is put before /rois.
    std::string url = default_url();
    Way way = Way::websocket;
    std::string token{};    // sent as Authorization: Bearer; empty: none
    std::string ca_file{};  // PEM, certificates that are trusted for TLS beside the system's; empty: none
    // Another program's session, to act in it beside that one: over HTTP, since a WebSocket would take it over. What it was told
    // before is told first. It does not end with the connection; the connection closes when it has ended. Empty: an own one.
    std::string session{};

    // How long a robot that this session has set in motion goes on without a sign of life of the application (Connection::alive):
    // at least 1 s, at most what the gateway has. Nothing: what the gateway has, 2 s unless it is told otherwise.
    std::optional<std::chrono::milliseconds> motion_lease{};

    std::chrono::milliseconds deadline = std::chrono::seconds{10};         // of a call, with all that happens to it on the way
    std::chrono::milliseconds connect_deadline = std::chrono::seconds{5};  // of one attempt, with TLS and handshake
    // A link is given up when nothing is heard on it for twice as long; on a WebSocket, the engine is pinged after once. An event
    // stream is silent for as long as the engine's own interval of pings, 20 s, which `stream_silence` must exceed.
    std::chrono::milliseconds ping_interval = std::chrono::seconds{5};
    std::chrono::milliseconds stream_silence = std::chrono::seconds{45};

    // Pauses between two attempts. After a link that delivered an answer or a notification, or that lasted for `longest_pause`,
    // the next attempt follows without a pause. After a link that opened or resumed a session and delivered nothing, it follows
    // after `first_pause`. Each attempt without a session doubles the pause, up to `longest_pause`. Each pause is cut by up to a
    // half, at random.
    std::chrono::milliseconds first_pause = std::chrono::milliseconds{100};
    std::chrono::milliseconds longest_pause = std::chrono::seconds{5};
    std::optional<unsigned> attempts{};  // in a row, after which the connection closes; none: never

    std::size_t most_waiting = 1'024;           // events that wait in one stream; the oldest make room, which is told as a gap
    std::size_t longest_document = 16'000'000;  // bytes that are read; a longer one ends the link
};

}  // namespace rois
