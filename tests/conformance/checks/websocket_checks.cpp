// The rules of docs/clients.md and RFC 6455 for WebSockets.
#include "conformance/context.hpp"
#include "kit/line.hpp"

namespace rois::conformance {

namespace {

using kit::HttpClient;

std::string attribute(pugi::xml_node node, char const* name) { return node.attribute(name).value(); }

void the_handshake_selects_the_subprotocol(Context& context) {
    HttpClient client{context.address()};
    auto const reply = shake_hands(client);
    require(reply.status == 101, "expected status 101, got " + std::to_string(reply.status));
    require_equal("Sec-WebSocket-Accept", kit::expected_accept, reply.header("Sec-WebSocket-Accept"));
    require_equal("Sec-WebSocket-Protocol", "rois.xml.v1", reply.header("Sec-WebSocket-Protocol"));
}

void a_handshake_without_the_subprotocol_is_refused(Context& context) {
    HttpClient client{context.address()};
    auto const reply = shake_hands(client, {{"Sec-WebSocket-Protocol", ""}});
    require(reply.status == 400, "expected status 400, got " + std::to_string(reply.status));
}

void a_fault_leaves_the_websocket_open(Context& context) {
    WebSocket client{context};
    client.send("<oops");
    require_equal("the fault", "not_well_formed", attribute(client.next_document(), "code"));
    require_equal("the answer of connect", "OK", attribute(client.call("connect"), "return_code"));
    require_equal("the fault", "invalid", attribute(client.call("search", "<nonsense/>"), "code"));
    require_equal("the answer of search", "OK", attribute(client.call("search"), "return_code"));
}

void requests_are_answered_in_order(Context& context) {
    WebSocket client{context};
    client.call("connect");
    constexpr int count = 10;
    for (int i = 0; i < count; ++i) client.ask("search", "", {{"request_id", std::to_string(i)}});
    for (int i = 0; i < count; ++i)
        require_equal("request_id", std::to_string(i), attribute(client.next_document(), "request_id"));
}

void the_websocket_stays_open_after_disconnect(Context& context) {
    WebSocket client{context};
    client.call("connect");
    auto const first = client.session();
    require_equal("the answer of disconnect", "OK", attribute(client.call("disconnect"), "return_code"));
    require_equal("the fault", "no_session", attribute(client.call("search"), "code"));
    require_equal("the answer of connect", "OK", attribute(client.call("connect"), "return_code"));
    require(client.session() != first, "connect after disconnect: expected a new session, got " + first + " again");
}

void a_session_of_a_websocket_can_be_used_over_http(Context& context) {
    auto const number = number_parameter_of(context);
    auto const& component = *number.component;
    WebSocket client{context};
    client.call("connect");
    HttpClient http{context.address()};
    http.session = client.session();
    auto const bound = http.call("bind", kit::component_ref(component.ref)).return_code();
    if (bound == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + component.ref};
    require_equal("the answer of bind", "OK", bound);
    http.call("set_parameter", kit::component_ref(component.ref) + kit::parameters({with_value(number, 50)}));
    require_equal("the received documents", "completed", client.next_document().name());
}

void require_close_code(WebSocket& client, int code) {
    auto const found = client.await_close();
    require(found == code, "expected the close code " + std::to_string(code) + ", got " + std::to_string(found));
}

void resume_closes_the_older_websocket(Context& context) {
    WebSocket older{context}, newer{context};
    older.call("connect");
    auto const answer = newer.call("resume", {}, {{"session", older.session()}, {"last_sequence", "0"}});
    require_equal("the answer of resume", "OK", attribute(answer, "return_code"));
    require_close_code(older, 1008);
    require_equal("the answer of search", "OK", attribute(newer.call("search"), "return_code"));
    newer.call("disconnect");
}

void protocol_errors_close_the_websocket(Context& context) {
    WebSocket binary{context}, no_text{context}, reserved{context}, unmasked{context};
    binary.send("<connect/>", kit::Kind::binary);
    require_close_code(binary, 1003);
    no_text.send("\xC3\x28");
    require_close_code(no_text, 1007);
    reserved.send_raw(0xC1, "<connect/>");
    require_close_code(reserved, 1002);
    unmasked.line().send("\x81\x02hi");
    require_close_code(unmasked, 1002);
}

void a_ping_is_answered(Context& context) {
    WebSocket client{context};
    client.send("still there?", kit::Kind::ping);
    auto const frame = client.next();
    require(frame.kind == kit::Kind::pong && frame.payload == "still there?", "expected a pong with the payload of the ping");
}

}  // namespace

Clause websocket_clause() {
    auto const websocket = Transport::websocket;
    return {"Transport: WebSocket",
            {{"the_handshake_selects_the_subprotocol", "docs/clients.md", the_handshake_selects_the_subprotocol, websocket},
             {"a_handshake_without_the_subprotocol_is_refused", "docs/clients.md", a_handshake_without_the_subprotocol_is_refused,
              websocket},
             {"a_fault_leaves_the_websocket_open", "docs/clients.md", a_fault_leaves_the_websocket_open, websocket},
             {"requests_are_answered_in_order", "docs/clients.md", requests_are_answered_in_order, websocket},
             {"the_websocket_stays_open_after_disconnect", "decision 3", the_websocket_stays_open_after_disconnect, websocket},
             {"a_session_of_a_websocket_can_be_used_over_http", "docs/clients.md", a_session_of_a_websocket_can_be_used_over_http,
              websocket},
             {"resume_closes_the_older_websocket", "docs/clients.md", resume_closes_the_older_websocket, websocket},
             {"protocol_errors_close_the_websocket", "docs/clients.md", protocol_errors_close_the_websocket, websocket},
             {"a_ping_is_answered", "RFC 6455", a_ping_is_answered, websocket}}};
}

}  // namespace rois::conformance
