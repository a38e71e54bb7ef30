#include "net/http/http_answer.hpp"

#include <array>
#include <ctime>

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

void set_status(HttpAnswer& answer, FaultCode code) {
    answer.status = http::int_to_status(static_cast<unsigned>(http_status_of(code)));
    if (code == FaultCode::too_many) answer.fields.set(http::field::retry_after, "1");
    if (code == FaultCode::unauthorized) answer.fields.set(http::field::www_authenticate, "Bearer");
}

HttpAnswer answer_of(Fault const& fault) {
    HttpAnswer answer{.body = xml::encode(fault)};
    set_status(answer, fault.code);
    answer.fault = fault;
    return answer;
}

HttpAnswer not_modified(HttpAnswer answer) {
    answer.status = http::status::not_modified;
    answer.content_type = {};
    answer.body.clear();
    return answer;
}

// Beast's serializer would write the same, but makes a query 8 % more expensive, which is more than the goal allows
// (docs/performance.md).
void append(std::string& out, HttpAnswer const& answer, Framing framing) {
    bool const has_length = may_have_body(answer.status) && framing.body != Framing::Body::endless;
    auto const line = [&](std::string_view name, std::string_view value) {
        if (!value.empty()) out.append(name).append(": ").append(value).append("\r\n");
    };
    out.append("HTTP/1.1 ").append(std::to_string(static_cast<unsigned>(answer.status))).append(" ");
    out.append(reason_of(answer.status)).append("\r\n");
    line("Date", date());
    line("Content-Type", answer.content_type);
    line("Cache-Control", answer.cache_control);
    line("X-Content-Type-Options", "nosniff");
    for (auto const& field : answer.fields) line(field.name_string(), field.value());
    if (has_length) line("Content-Length", std::to_string(answer.body.size()));
    if (framing.close) line("Connection", "close");
    out.append("\r\n");
    if (has_length && framing.body == Framing::Body::sent) out.append(answer.body);
}

}  // namespace rois::net
