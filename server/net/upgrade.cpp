#include "net/upgrade.hpp"

#include <algorithm>

#include "net/secrets.hpp"
#include "types/texts.hpp"

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

std::string_view without_default_port(std::string_view authority, std::string_view port) {
    return authority.ends_with(port) ? authority.substr(0, authority.size() - port.size()) : authority;
}

// A page's origin is welcome when it is this very server, or configured.
bool is_welcome(std::string_view origin, std::string_view host, Settings const& settings) {
    auto const& allowed = settings.allowed_origins;
    if (std::ranges::any_of(allowed, [&](auto const& one) { return equal_ignoring_case(one, origin); })) return true;
    auto const scheme_end = origin.find("://");
    if (scheme_end == std::string_view::npos) return false;
    auto const port = equal_ignoring_case(origin.substr(0, scheme_end), "https") ? ":443" : ":80";
    return equal_ignoring_case(without_default_port(origin.substr(scheme_end + 3), port), without_default_port(host, port));
}

}  // namespace

HttpAnswer upgrade(RequestHead const& head, Settings const& settings) {
    if (head.method != "GET" || head.http_1_0 || !head.lists("Upgrade", "websocket") || !head.lists("Connection", "upgrade")) {
        return wants_upgrade("POST a request document here, or open a WebSocket");
    }
    if (head.count("Sec-WebSocket-Version") != 1) return broken("exactly one Sec-WebSocket-Version is needed");
    if (head.field("Sec-WebSocket-Version") != "13") return wants_upgrade("the version of WebSocket spoken here is 13");
    auto const key = head.field("Sec-WebSocket-Key");
    if (!key || !is_websocket_key(*key)) return broken("Sec-WebSocket-Key is not one text of 16 bytes in base64");
    if (!head.lists("Sec-WebSocket-Protocol", subprotocol, RequestHead::Case::kept))
        return broken("ask for the subprotocol rois.xml.v1");
    if (head.count("Origin") > 0) {
        auto const origin = head.field("Origin");
        if (!origin || !is_welcome(*origin, head.authority(), settings)) {
            return answer_of(
                {FaultCode::not_allowed,
                 "pages of the origin " + quoted(origin.value_or("")) + " are not allowed here; allowed_origins can name it",
                 {},
                 {}});
        }
    }
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
