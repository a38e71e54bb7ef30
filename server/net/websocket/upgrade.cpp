#include "net/websocket/upgrade.hpp"

#include <algorithm>

#include "gateway/access/secrets.hpp"
#include "types/text/texts.hpp"

namespace rois::net {

namespace {

constexpr std::string_view subprotocol = "rois.xml.v1";
constexpr std::string_view suffix = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";  // of the key, before it is hashed (RFC 6455, 1.3)

HttpAnswer wants_upgrade(std::string reason) {
    auto answer = answer_of({FaultCode::upgrade_required, std::move(reason)});
    answer.fields.set(http::field::upgrade, "websocket");
    answer.fields.set(http::field::connection, "Upgrade");
    answer.fields.set(http::field::sec_websocket_version, "13");
    return answer;
}

HttpAnswer broken(std::string reason) {
    auto answer = answer_of({FaultCode::not_well_formed, "broken WebSocket handshake: " + std::move(reason)});
    answer.fields.set(http::field::sec_websocket_version, "13");
    return answer;
}

// Returns whether the text is 16 bytes in base64.
bool is_websocket_key(std::string_view text) {
    if (text.size() != 24 || !text.ends_with("==")) return false;
    return std::ranges::all_of(text.substr(0, 22), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '/';
    });
}

}  // namespace

HttpAnswer upgrade(RequestHead const& head) {
    if (head.verb() != http::verb::get || head.is_http_1_0() || !head.lists("Upgrade", "websocket") ||
        !head.lists("Connection", "upgrade")) {
        return wants_upgrade("POST a request document here, or open a WebSocket");
    }
    if (head.message.count("Sec-WebSocket-Version") != 1) return broken("expected exactly one Sec-WebSocket-Version header");
    if (auto const version = head.field("Sec-WebSocket-Version").value_or(""); version != "13")
        return wants_upgrade("unsupported Sec-WebSocket-Version " + quoted(version) + ": expected 13");
    auto const key = head.field("Sec-WebSocket-Key");
    if (!key || !is_websocket_key(*key)) return broken("expected exactly one Sec-WebSocket-Key, with 16 bytes in base64");
    if (!head.lists("Sec-WebSocket-Protocol", subprotocol, RequestHead::Case::kept))
        return broken("ask for the subprotocol rois.xml.v1");
    HttpAnswer answer{.status = http::status::switching_protocols, .content_type = {}, .cache_control = {}};
    answer.fields.set(http::field::upgrade, "websocket");
    answer.fields.set(http::field::connection, "Upgrade");
    answer.fields.set(http::field::sec_websocket_accept, sha1_base64(std::string{*key}.append(suffix)));
    answer.fields.set(http::field::sec_websocket_protocol, subprotocol);
    return answer;
}

}  // namespace rois::net
