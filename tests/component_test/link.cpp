#include "component_test/link.hpp"

#include <openssl/evp.h>
#include <openssl/sha.h>

#include <array>

#include "conformance/check.hpp"
#include "kit/websocket_frames.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using conformance::Broken;

// Returns the value of a header field, or an empty text.
std::string field(std::string_view head, std::string_view name) {
    for (auto at = head.find("\r\n"); at + 2 < head.size(); at = head.find("\r\n", at + 2)) {
        auto const line = head.substr(at + 2, head.find("\r\n", at + 2) - at - 2);
        auto const colon = line.find(':');
        if (colon != line.npos && equal_ignoring_case(line.substr(0, colon), name))
            return std::string{trimmed(line.substr(colon + 1))};
    }
    return {};
}

// Returns the value of Sec-WebSocket-Accept (RFC 6455, 4.2.2).
std::string accept_of(std::string const& key) {
    auto const text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
    std::array<unsigned char, SHA_DIGEST_LENGTH> digest{};
    SHA1(reinterpret_cast<unsigned char const*>(text.data()), text.size(), digest.data());
    std::array<unsigned char, 32> encoded{};
    auto const length = EVP_EncodeBlock(encoded.data(), digest.data(), digest.size());
    return {reinterpret_cast<char const*>(encoded.data()), static_cast<std::size_t>(length)};
}

}  // namespace

Link::Link(int descriptor) : socket_{descriptor} {
    auto const head = socket_.take_until("\r\n\r\n").value_or("");
    auto const target = head.substr(0, head.find("\r\n"));
    auto const key = field(head, "Sec-WebSocket-Key");
    if (!target.starts_with("GET /rois/engines HTTP/1.1") || key.empty())
        throw Broken{"expected a WebSocket handshake for /rois/engines, got " + quoted(target, 100)};
    if (field(head, "Sec-WebSocket-Protocol") != "rois.xml.v1")
        throw Broken{"expected the subprotocol rois.xml.v1, got " + quoted(field(head, "Sec-WebSocket-Protocol"))};
    socket_.send("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: " +
                 accept_of(key) + "\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n");
    reader_ = std::thread{[this] { read(); }};
}

Link::~Link() {
    cut();
    reader_.join();
}

void Link::send(std::string_view document) { socket_.send(kit::whole_frame(kit::Kind::text, document, kit::Masked::no)); }

std::optional<std::string> Link::next(Clock::time_point until) {
    std::unique_lock lock{mutex_};
    news_.wait_until(lock, until, [this] { return ended_ || !messages_.empty(); });
    if (messages_.empty()) return {};
    auto message = std::move(messages_.front());
    messages_.pop_front();
    return message;
}

bool Link::ping(std::string const& payload, Clock::time_point until) {
    socket_.send(kit::whole_frame(kit::Kind::ping, payload, kit::Masked::no));
    std::unique_lock lock{mutex_};
    news_.wait_until(lock, until, [&] { return ended_ || pongs_.contains(payload); });
    return pongs_.contains(payload);
}

bool Link::has_ended() const {
    std::lock_guard const lock{mutex_};
    return ended_ && messages_.empty();
}

void Link::cut() { socket_.end(); }

void Link::read() {
    std::string message;
    while (auto start = socket_.take(2)) {
        auto const head_size = kit::frame_head_size(*start);
        auto const rest = socket_.take(head_size - 2);
        if (!rest) break;
        auto const head_bytes = *start + *rest;
        auto const head = kit::frame_head(head_bytes);
        if (!head || head->masked == kit::Masked::no) break;
        auto payload = socket_.take(head->payload_size);
        if (!payload) break;
        kit::mask(*payload, std::string_view{head_bytes}.substr(head_size - 4));
        if (head->kind() == kit::Kind::close) break;
        if (head->kind() == kit::Kind::ping) socket_.send(kit::whole_frame(kit::Kind::pong, *payload, kit::Masked::no));
        if (head->kind() == kit::Kind::pong) {
            std::lock_guard const lock{mutex_};
            pongs_.insert(*payload);
            news_.notify_all();
        }
        if (head->kind() != kit::Kind::text && head->kind() != kit::Kind::continuation) continue;
        message += *payload;
        if ((head->first_byte & kit::final_fragment) != 0) take(std::exchange(message, {}));
    }
    socket_.end();
    std::lock_guard const lock{mutex_};
    ended_ = true;
    news_.notify_all();
}

void Link::take(std::string message) {
    std::lock_guard const lock{mutex_};
    messages_.push_back(std::move(message));
    news_.notify_all();
}

}  // namespace rois::component_test
