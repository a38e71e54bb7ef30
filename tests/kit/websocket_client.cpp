#include "kit/websocket_client.hpp"

#include "kit/names.hpp"

namespace rois::kit {

HttpReply shake_hands(HttpClient& http, Headers const& other, std::string const& path) {
    Headers fields{{"Upgrade", "websocket"},
                   {"Connection", "Upgrade"},
                   {"Sec-WebSocket-Version", "13"},
                   {"Sec-WebSocket-Key", good_key},
                   {"Sec-WebSocket-Protocol", "rois.xml.v1"}};
    for (auto const& [name, value] : other) {
        fields[name] = value;
        if (value.empty()) fields.erase(name);
    }
    return http.get(path, fields);
}

int Frame::close_code() const {
    if (kind != Kind::close || payload.size() < 2) return 0;
    return static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]);
}

WebSocketClient::WebSocketClient(Address const& address, std::string const& path) : http_{address} {
    auto const status = shake_hands(http_, {}, path).status;
    if (status != 101) throw LineEnded{"WebSocket handshake: expected status 101, got " + std::to_string(status)};
}

void WebSocketClient::send(std::string_view payload, Kind kind) { line().send(whole_frame(kind, payload, Masked::yes)); }

void WebSocketClient::send_raw(unsigned first_byte, std::string_view payload) {
    line().send(frame_bytes(first_byte, payload, Masked::yes));
}

void WebSocketClient::ask(std::string const& operation, Xml const& children, Attributes const& attributes) {
    send(request(operation, children, attributes));
}

Frame WebSocketClient::next() {
    auto bytes = line().take(2);
    bytes += line().take(frame_head_size(bytes) - bytes.size());
    auto const head = frame_head(bytes).value();
    if (!head.is_whole()) throw LineEnded{"a frame is fragmented or has reserved bits"};
    if (head.masked == Masked::yes) throw LineEnded{"a server must not mask frames"};
    return {head.kind(), line().take(head.payload_size)};
}

pugi::xml_node WebSocketClient::read_document() {
    auto frame = next();
    while (frame.kind == Kind::ping) {
        send(frame.payload, Kind::pong);
        frame = next();
    }
    if (frame.kind != Kind::text)
        throw LineEnded{"expected a text frame; the WebSocket closed with code " + std::to_string(frame.close_code())};
    document_.load_string(frame.payload.c_str());
    give_known_prefixes(document_);
    return document_.document_element();
}

pugi::xml_node WebSocketClient::next_document() {
    auto document = read_document();
    for (; !skipped_.empty() && document.name() == skipped_; document = read_document()) ++count_skipped_;
    return document;
}

pugi::xml_node WebSocketClient::call(std::string const& operation, Xml const& children, Attributes const& attributes) {
    ask(operation, children, attributes);
    auto const answer = next_document();
    if (operation == "connect") http_.session = answer.child("session").text().get();
    return answer;
}

int WebSocketClient::await_close() {
    auto frame = next();
    while (frame.kind != Kind::close) frame = next();
    send(frame.payload, Kind::close);
    if (!line().ends()) throw LineEnded{"received bytes after the close frame"};
    return frame.close_code();
}

}  // namespace rois::kit
