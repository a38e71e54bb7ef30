// A WebSocket client that can send invalid frames. Throws LineEnded if the server violates RFC 6455.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "kit/http_client.hpp"
#include "kit/websocket_frames.hpp"

namespace rois::kit {

inline constexpr auto good_key = "dGhlIHNhbXBsZSBub25jZQ==";
inline constexpr auto expected_accept = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";  // RFC 6455, 1.3

// Sends the handshake; `other` adds or replaces header fields, an empty value removes one.
HttpReply shake_hands(HttpClient&, Headers const& other = {}, std::string const& path = "/rois");

struct Frame {
    Kind kind;
    std::string payload;

    int close_code() const;  // 0 if it is not a close frame
};

class WebSocketClient {
public:
    // Opens the WebSocket. Throws LineEnded if the server refuses the handshake.
    explicit WebSocketClient(Address const&, std::string const& path = "/rois");

    Line& line() { return http_.line(); }

    // Sends a masked frame. `first_byte` sets FIN, RSV and opcode.
    void send(std::string_view payload, Kind = Kind::text);
    void send_raw(unsigned first_byte, std::string_view payload);
    void ask(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});

    Frame next();
    // Returns the root element of the next text frame; answers pings.
    pugi::xml_node next_document();
    // Makes `next_document` skip documents of this name.
    void skip(std::string name) { skipped_ = std::move(name); }
    unsigned skipped() const { return count_skipped_; }  // number of documents
    // Calls `ask`, and returns the next document.
    pugi::xml_node call(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
    // Waits until the server closes the connection, and returns its close code; skips other frames.
    int await_close();

    std::string const& session() const { return http_.session; }
    // Makes the destructor close the connection without `disconnect`, so that the session stays open.
    void keep_session() { http_.session.clear(); }

private:
    pugi::xml_node read_document();

    HttpClient http_;
    pugi::xml_document document_;
    std::string skipped_;
    unsigned count_skipped_ = 0;
};

}  // namespace rois::kit
