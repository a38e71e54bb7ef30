#include "net/upgrade.hpp"

#include <algorithm>

#include "gateway/secrets.hpp"

namespace rois::net {

namespace {

constexpr std::string_view subprotocol = "rois.xml.v1";

HttpAnswer wants_upgrade(std::string reason) {
    auto answer = answer_of({FaultCode::upgrade_required, std::move(reason), {}, {}});
    answer.set("Upgrade", "websocket");
    answer.set("Connection", "Upgrade");
    answer.set("Sec-WebSocket-Version", "13");
    return answer;
}

HttpAnswer broken(std::string reason) {
    auto answer = answer_of({FaultCode::not_well_formed, "broken WebSocket handshake: " + std::move(reason), {}, {}});
    answer.set("Sec-WebSocket-Version", "13");
    return answer;
}

}  // namespace

std::string websocket_accept(std::string_view key) {
    return sha1_base64(std::string{key} + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11");
}

bool is_websocket_key(std::string_view text) {
    if (text.size() != 24 || !text.ends_with("==")) return false;
    return std::ranges::all_of(text.substr(0, 22), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '/';
    });
}

HttpAnswer upgrade(RequestHead const& head) {
    if (head.method != "GET" || head.http_1_0 || !head.lists("Upgrade", "websocket") || !head.lists("Connection", "upgrade")) {
        return wants_upgrade("POST a request document here, or open a WebSocket");
    }
    if (head.count("Sec-WebSocket-Version") != 1) return broken("exactly one Sec-WebSocket-Version is needed");
    if (head.field("Sec-WebSocket-Version") != "13") return wants_upgrade("the version of WebSocket spoken here is 13");
    auto const key = head.field("Sec-WebSocket-Key");
    if (!key || !is_websocket_key(*key)) return broken("Sec-WebSocket-Key is not one text of 16 bytes in base64");
    if (!head.lists("Sec-WebSocket-Protocol", subprotocol, RequestHead::Case::kept))
        return broken("ask for the subprotocol rois.xml.v1");
    HttpAnswer answer;
    answer.status = 101;
    answer.content_type = {};
    answer.cache_control = {};
    answer.set("Upgrade", "websocket");
    answer.set("Connection", "Upgrade");
    answer.set("Sec-WebSocket-Accept", websocket_accept(*key));
    answer.set("Sec-WebSocket-Protocol", subprotocol);
    return answer;
}

}  // namespace rois::net
