// The rules of docs/clients.md and RFC 6455 for WebSockets.
#include "conformance/stage.hpp"
#include "kit/line.hpp"
#include "kit/websocket_client.hpp"

namespace rois::conformance {

namespace {

using kit::HttpClient;
using kit::WebSocketClient;

std::string attribute(pugi::xml_node node, char const* name) { return node.attribute(name).value(); }

void the_handshake_agrees_on_the_subprotocol(Stage& stage) {
    HttpClient client{stage.address()};
    auto const reply = shake_hands(client);
    require(reply.status == 101, "the status should be 101, and is " + std::to_string(reply.status));
    same("Sec-WebSocket-Accept", kit::its_accept, reply.header("Sec-WebSocket-Accept"));
    same("Sec-WebSocket-Protocol", "rois.xml.v1", reply.header("Sec-WebSocket-Protocol"));
}

void without_the_subprotocol_it_is_refused(Stage& stage) {
    HttpClient client{stage.address()};
    auto const reply = shake_hands(client, {{"Sec-WebSocket-Protocol", ""}});
    require(reply.status == 400, "the status should be 400, and is " + std::to_string(reply.status));
}

void faults_leave_it_open(Stage& stage) {
    WebSocketClient client{stage.address()};
    client.send("<oops");
    same("the fault", "not_well_formed", attribute(client.next_document(), "code"));
    same("the answer of connect", "OK", attribute(client.call("connect"), "return_code"));
    same("the fault", "invalid", attribute(client.call("search", "<nonsense/>"), "code"));
    same("the answer of search", "OK", attribute(client.call("search"), "return_code"));
}

void requests_are_answered_in_order(Stage& stage) {
    WebSocketClient client{stage.address()};
    client.call("connect");
    constexpr int count = 10;
    for (int i = 0; i < count; ++i) client.ask("search", "", {{"request_id", std::to_string(i)}});
    for (int i = 0; i < count; ++i) same("request_id", std::to_string(i), attribute(client.next_document(), "request_id"));
}

void it_stays_open_after_disconnect(Stage& stage) {
    WebSocketClient client{stage.address()};
    client.call("connect");
    auto const first = client.session();
    same("the answer of disconnect", "OK", attribute(client.call("disconnect"), "return_code"));
    same("the fault", "no_session", attribute(client.call("search"), "code"));
    same("the answer of connect", "OK", attribute(client.call("connect"), "return_code"));
    require(client.session() != first, "the session is the one that has ended");
}

void its_session_can_be_used_over_http(Stage& stage) {
    auto const dial = dial_of(stage);
    auto const& component = *dial.component;
    WebSocketClient client{stage.address()};
    client.call("connect");
    HttpClient http{stage.address()};
    http.session = client.session();
    auto const bound = http.call("bind", kit::component_ref(component.ref)).return_code();
    if (bound == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses " + component.ref};
    same("the answer of bind", "OK", bound);
    http.call("set_parameter", kit::component_ref(component.ref) + kit::parameters({turned(dial, 50)}));
    same("the received documents", "completed", client.next_document().name());
}

void closes_with(WebSocketClient& client, int code) {
    auto const found = client.closes();
    require(found == code, "it should close with " + std::to_string(code) + ", and did with " + std::to_string(found));
}

void resume_closes_the_older_one(Stage& stage) {
    WebSocketClient older{stage.address()}, newer{stage.address()};
    older.call("connect");
    auto const answer = newer.call("resume", {}, {{"session", older.session()}, {"last_sequence", "0"}});
    same("the answer of resume", "OK", attribute(answer, "return_code"));
    closes_with(older, 1008);
    same("the answer of search", "OK", attribute(newer.call("search"), "return_code"));
    newer.call("disconnect");
}

void protocol_errors_close_it(Stage& stage) {
    WebSocketClient binary{stage.address()}, no_text{stage.address()}, reserved{stage.address()}, unmasked{stage.address()};
    binary.send("<connect/>", kit::Kind::binary);
    closes_with(binary, 1003);
    no_text.send("\xC3\x28");
    closes_with(no_text, 1007);
    reserved.send_raw(0xC1, "<connect/>");
    closes_with(reserved, 1002);
    unmasked.line().send("\x81\x02hi");
    closes_with(unmasked, 1002);
}

void a_ping_is_answered(Stage& stage) {
    WebSocketClient client{stage.address()};
    client.send("still there?", kit::Kind::ping);
    auto const frame = client.next();
    require(frame.kind == kit::Kind::pong && frame.payload == "still there?", "a ping should be answered with its pong");
}

}  // namespace

Clause websocket_clause() {
    auto const websocket = Way::websocket;
    return {"The wire: WebSocket",
            {{"the_handshake_agrees_on_the_subprotocol", "docs/clients.md", the_handshake_agrees_on_the_subprotocol, websocket},
             {"without_the_subprotocol_it_is_refused", "docs/clients.md", without_the_subprotocol_it_is_refused, websocket},
             {"faults_leave_it_open", "docs/clients.md", faults_leave_it_open, websocket},
             {"requests_are_answered_in_order", "docs/clients.md", requests_are_answered_in_order, websocket},
             {"it_stays_open_after_disconnect", "decision 3", it_stays_open_after_disconnect, websocket},
             {"its_session_can_be_used_over_http", "docs/clients.md", its_session_can_be_used_over_http, websocket},
             {"resume_closes_the_older_one", "docs/clients.md", resume_closes_the_older_one, websocket},
             {"protocol_errors_close_it", "docs/clients.md", protocol_errors_close_it, websocket},
             {"a_ping_is_answered", "RFC 6455", a_ping_is_answered, websocket}}};
}

}  // namespace rois::conformance
