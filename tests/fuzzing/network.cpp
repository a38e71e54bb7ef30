#include <algorithm>
#include <stdexcept>
#include <string>

#include "fuzzing/targets.hpp"
#include "net/http/http_head.hpp"
#include "net/http/routes.hpp"
#include "net/websocket/upgrade.hpp"
#include "net/websocket/websocket_frames.hpp"

namespace rois::fuzzing {

// As a connection does: one head after the other, each with its body, until one is refused or incomplete.
void http(std::string_view input) {
    static net::Settings const settings;
    net::RequestHead head;
    while (!input.empty()) {
        std::size_t searched = 0;
        auto const size = net::find_head(input, searched);
        if (size > input.size() || searched > input.size()) throw std::logic_error{"a head is longer than the input"};
        if (size == 0 || size > settings.max_header) return static_cast<void>(net::overlong_head(input, settings));
        if (net::read_head(input.substr(0, size), settings, head)) return;
        input.remove_prefix(size);
        auto const route = net::route_of(head.path);
        static_cast<void>(head.token());
        static_cast<void>(head.keep_alive());
        static_cast<void>(head.parameter("after"));
        std::string out;
        auto answer = net::refusal_of_other_sites(head, settings);
        if (!answer) answer = net::refusal(head, route, settings);
        if (!answer) answer = net::upgrade(head);
        net::append(out, *answer, {});
        auto const end = out.find("\r\n\r\n");
        if (end == out.npos) throw std::logic_error{"an answer without the end of its head"};
        for (auto line = out.find("\r\n"); line < end; line = out.find("\r\n", line + 2)) {
            auto const begin = line + 2;
            auto const colon = out.find(": ", begin);
            if (begin < end && colon > out.find("\r\n", begin))
                throw std::logic_error{"a line of the answer is not a field: " + out};
        }
        input.remove_prefix(std::min<std::size_t>(head.content_length, input.size()));
    }
}

// The same frames in one piece and in two give the same messages.
void websocket(std::string_view input) {
    auto const read = [&](std::size_t first) {
        std::string messages;
        net::MessageReader reader;
        reader.limit(1'000, 16);
        std::string bytes{input.substr(0, first)};
        auto rest = input.substr(first);
        while (true) {
            std::size_t used = 0;
            auto const received = reader.next(bytes, used);
            if (used > bytes.size()) throw std::logic_error{"a frame is longer than the input"};
            if (received.kind == net::Received::Kind::nothing) {
                if (rest.empty()) break;
                bytes += rest;
                rest = {};
                continue;
            }
            messages += std::to_string(static_cast<int>(received.kind)) + std::string{received.text} + "\n";
            if (received.kind == net::Received::Kind::violation || received.kind == net::Received::Kind::close) break;
            bytes.erase(0, used);
        }
        return messages;
    };
    auto const whole = read(input.size());
    if (read(input.size() / 2) != whole) throw std::logic_error{"the messages depend on how the bytes arrive"};
    if (read(std::min<std::size_t>(1, input.size())) != whole)
        throw std::logic_error{"the messages depend on how the bytes arrive"};
}

}  // namespace rois::fuzzing
