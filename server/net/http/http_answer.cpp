#include "net/http/http_answer.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "xml/codec/codec.hpp"

namespace rois::net {

namespace {

// The current time as "Sun, 06 Nov 1994 08:49:37 GMT" (RFC 9110, 5.6.7). Each thread formats it once a second.
std::string_view date() {
    thread_local std::time_t made_at = 0;
    thread_local std::array<char, 32> text{};
    thread_local std::size_t size = 0;
    auto const now = std::time(nullptr);
    if (now != made_at) {
        std::tm utc{};
        gmtime_r(&now, &utc);
        size = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
        made_at = now;
    }
    return {text.data(), size};
}

// The reason phrases of RFC 9110. Beast has older ones for two statuses.
std::string_view reason_of(http::status status) {
    if (status == http::status::payload_too_large) return "Content Too Large";
    if (status == http::status::unprocessable_entity) return "Unprocessable Content";
    return http::obsolete_reason(status);
}

// Returns whether an answer with this status has a body, or an empty one. The other answers have no Content-Length either.
bool may_have_body(http::status status) {
    return status != http::status::not_modified && status != http::status::switching_protocols;
}

}  // namespace

HttpAnswer::HttpAnswer(std::string body, std::string_view content_type) {
    message.insert(http::field::date, date());
    message.insert(http::field::content_type, content_type);
    message.insert(http::field::cache_control, "no-store");
    message.body() = std::move(body);
}

HttpAnswer answer_of(Fault const& fault) {
    HttpAnswer answer{xml::encode(fault)};
    answer.message.result(static_cast<unsigned>(http_status_of(fault.code)));
    answer.fault = fault;
    return answer;
}

HttpAnswer not_modified(HttpAnswer answer) {
    answer.message.result(http::status::not_modified);
    answer.message.erase(http::field::content_type);
    answer.message.body().clear();
    return answer;
}

// Beast's serializer would write the same, but makes a query 8 % more expensive and misses the goal (docs/performance.md).
void append(std::string& out, HttpAnswer const& answer, Framing framing) {
    auto const& message = answer.message;
    bool const has_length = may_have_body(message.result()) && framing.body != Framing::Body::endless;
    auto const line = [&](std::string_view name, std::string_view value) {
        out.append(name).append(": ").append(value).append("\r\n");
    };
    out.append("HTTP/1.1 ").append(std::to_string(message.result_int())).append(" ");
    out.append(reason_of(message.result())).append("\r\n");
    for (auto const& field : message) line(field.name_string(), field.value());
    if (has_length) line("Content-Length", std::to_string(message.body().size()));
    if (framing.close) line("Connection", "close");
    out.append("\r\n");
    if (has_length && framing.body == Framing::Body::sent) out.append(message.body());
}

}  // namespace rois::net
