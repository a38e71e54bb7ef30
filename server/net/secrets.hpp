// The few cryptographic functions that the gateway needs.
#pragma once

#include <string>
#include <string_view>

namespace rois::net {

// An unguessable text of 192 bits in base64url: the name of a session. Throws std::runtime_error when there is no randomness.
std::string fresh_secret();

// A short text that changes with the content: for ETags, and for log lines that must tell secrets apart without showing them.
std::string digest(std::string_view content);

// The SHA-256 of the content as a Content-Security-Policy names it.
std::string sha256_base64(std::string_view content);

// What a server answers to Sec-WebSocket-Key (RFC 6455, 4.2.2).
std::string websocket_accept(std::string_view key);

// Whether the text is base64 of exactly 16 bytes.
bool is_websocket_key(std::string_view text);

}  // namespace rois::net
