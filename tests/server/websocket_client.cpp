#include "server/websocket_client.hpp"

#include <gtest/gtest.h>

namespace rois::test {

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

WebSocketClient::WebSocketClient(GatewayProcess const& gateway) : http_{gateway} { EXPECT_EQ(shake_hands(http_).status, 101); }

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

void WebSocketClient::ask(std::string const& operation, std::string const& children, std::string const& attributes) {
    send(request(operation, children, attributes));
}

Frame WebSocketClient::next() {
    auto const head = line().take(2);
    EXPECT_EQ(head[0] & 0xF0, 0x80) << "one whole frame without reserved bits";
    EXPECT_EQ(head[1] & 0x80, 0) << "a server does not mask";
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
    while (frame.kind == Kind::ping) frame = next();
    EXPECT_EQ(frame.kind, Kind::text) << "closed with " << frame.close_code();
    document_.load_string(frame.payload.c_str());
    return document_.document_element();
}

pugi::xml_node WebSocketClient::call(std::string const& operation, std::string const& children, std::string const& attributes) {
    ask(operation, children, attributes);
    auto const answer = next_document();
    if (operation == "connect") http_.session = answer.child("session").text().get();
    return answer;
}

int WebSocketClient::closes() {
    auto frame = next();
    while (frame.kind != Kind::close) frame = next();
    send(frame.payload, Kind::close);
    EXPECT_TRUE(line().ends());
    return frame.close_code();
}

void bind_and_complete(WebSocketClient& client, int count) {
    client.call("connect");
    client.call("bind", component_ref("navigation"));
    for (int i = 0; i < count; ++i) {
        client.call("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000 + i));
        EXPECT_STREQ(client.next_document().name(), "completed");
    }
}

}  // namespace rois::test
