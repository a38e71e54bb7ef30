// A WebSocket client that can break every rule. What a server breaks of RFC 6455 is thrown as LineEnded.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "client/http_client.hpp"

namespace rois::client {

inline constexpr auto good_key = "dGhlIHNhbXBsZSBub25jZQ==";
inline constexpr auto its_accept = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";  // RFC 6455, 1.3

// The handshake, with these header fields beside or instead of the right ones; an empty value leaves one out.
HttpReply shake_hands(HttpClient&, Headers const& other = {});

enum class Kind : unsigned { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

struct Frame {
    Kind kind;
    std::string payload;

    int close_code() const;  // 0 when it is no close frame
};

class WebSocketClient {
public:
    // Shakes hands.
    explicit WebSocketClient(Address const&);

    Line& line() { return http_.line(); }

    // A whole masked frame. `first_byte` overrides FIN, RSV and opcode.
    void send(std::string_view payload, Kind = Kind::text);
    void send_raw(unsigned first_byte, std::string_view payload);
    void ask(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});

    Frame next();
    // The next text frame's root element; pings are answered.
    pugi::xml_node next_document();
    // Asks, and gives what comes next.
    pugi::xml_node call(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
    // The code with which the server closes, and ends the connection; other frames are passed over.
    int closes();

    std::string const& session() const { return http_.session; }
    // Keeps its session when it goes: closes without a word.
    void vanish() { http_.session.clear(); }

private:
    HttpClient http_;
    pugi::xml_document document_;
};

}  // namespace rois::client
