#include "client/websocket_client.hpp"

#include "client/names.hpp"

namespace rois::client {

HttpReply shake_hands(HttpClient& http, Headers const& other) {
    Headers fields{{"Upgrade", "websocket"},
                   {"Connection", "Upgrade"},
                   {"Sec-WebSocket-Version", "13"},
                   {"Sec-WebSocket-Key", good_key},
                   {"Sec-WebSocket-Protocol", "rois.xml.v1"}};
    for (auto const& [name, value] : other) {
        fields[name] = value;
        if (value.empty()) fields.erase(name);
    }
    return http.get("/rois", fields);
}

int Frame::close_code() const {
    if (kind != Kind::close || payload.size() < 2) return 0;
    return static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]);
}

WebSocketClient::WebSocketClient(Address const& address) : http_{address} {
    auto const status = shake_hands(http_).status;
    if (status != 101) throw LineEnded{"no WebSocket: HTTP status " + std::to_string(status) + " instead of 101"};
}

void WebSocketClient::send(std::string_view payload, Kind kind) { send_raw(0x80 | static_cast<unsigned>(kind), payload); }

void WebSocketClient::send_raw(unsigned first_byte, std::string_view payload) {
    std::string frame{static_cast<char>(first_byte)};
    int length_bytes = 0;
    if (payload.size() < 126) {
        frame.push_back(static_cast<char>(0x80 | payload.size()));
    } else {
        length_bytes = payload.size() < 65'536 ? 2 : 8;
        frame.push_back(static_cast<char>(0x80 | (length_bytes == 2 ? 126 : 127)));
    }
    for (int i = length_bytes - 1; i >= 0; --i) frame.push_back(static_cast<char>(payload.size() >> (8 * i)));
    char const mask[] = {'\x12', '\x34', '\x56', '\x78'};
    frame.append(mask, 4);
    for (std::size_t i = 0; i < payload.size(); ++i) frame.push_back(static_cast<char>(payload[i] ^ mask[i & 3]));
    line().send(frame);
}

void WebSocketClient::ask(std::string const& operation, Xml const& children, Attributes const& attributes) {
    send(request(operation, children, attributes));
}

Frame WebSocketClient::next() {
    auto const head = line().take(2);
    if ((head[0] & 0xF0) != 0x80) throw LineEnded{"a frame is fragmented or has reserved bits"};
    if (head[1] & 0x80) throw LineEnded{"a server must not mask frames"};
    std::size_t size = static_cast<unsigned char>(head[1]);
    if (size >= 126) {
        auto const length = line().take(size == 126 ? 2 : 8);
        size = 0;
        for (char const c : length) size = size << 8 | static_cast<unsigned char>(c);
    }
    return {static_cast<Kind>(head[0] & 0x0F), line().take(size)};
}

pugi::xml_node WebSocketClient::next_document() {
    auto frame = next();
    while (frame.kind == Kind::ping) {
        send(frame.payload, Kind::pong);
        frame = next();
    }
    if (frame.kind != Kind::text) throw LineEnded{"closed with " + std::to_string(frame.close_code())};
    document_.load_string(frame.payload.c_str());
    give_known_prefixes(document_);
    return document_.document_element();
}

pugi::xml_node WebSocketClient::call(std::string const& operation, Xml const& children, Attributes const& attributes) {
    ask(operation, children, attributes);
    auto const answer = next_document();
    if (operation == "connect") http_.session = answer.child("session").text().get();
    return answer;
}

int WebSocketClient::closes() {
    auto frame = next();
    while (frame.kind != Kind::close) frame = next();
    send(frame.payload, Kind::close);
    if (!line().ends()) throw LineEnded{"bytes after the close frame"};
    return frame.close_code();
}

}  // namespace rois::client
