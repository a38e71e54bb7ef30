// Random names and hashes. Thread-safe.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

// Returns 192 random bits in base64url, the id of a session. Throws std::runtime_error if the system gives no random bytes.
std::string fresh_secret();

// Returns 256 random bits in base64url: a token. Throws as `fresh_secret` does.
std::string fresh_token();

// Decodes base64url without padding. Returns an empty text for any other text.
std::string from_base64url(std::string_view);

using Sha256 = std::array<unsigned char, 32>;
Sha256 sha256(std::string_view content);
// In hexadecimal digits. `read_sha256` returns nothing if the text is not a hash.
std::string to_text(Sha256 const&);
std::optional<Sha256> read_sha256(std::string_view);

// Returns a short hash of the content: for ETags, and for log lines that must not show a secret.
std::string digest(std::string_view content);

// The SHA-256 of the content in base64, as a Content-Security-Policy expects it.
std::string sha256_base64(std::string_view content);

// The SHA-1 of the content in base64: for the opening handshake of a WebSocket.
std::string sha1_base64(std::string_view content);

}  // namespace rois
