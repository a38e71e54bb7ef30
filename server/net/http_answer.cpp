#include "net/http_answer.hpp"

#include <array>
#include <ctime>

#include "xml/codec/codec.hpp"

namespace rois::net {

namespace {

std::string_view phrase_of(int status) {
    switch (status) {
        case 101:
            return "Switching Protocols";
        case 200:
            return "OK";
        case 304:
            return "Not Modified";
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 408:
            return "Request Timeout";
        case 411:
            return "Length Required";
        case 413:
            return "Content Too Large";
        case 414:
            return "URI Too Long";
        case 415:
            return "Unsupported Media Type";
        case 421:
            return "Misdirected Request";
        case 422:
            return "Unprocessable Content";
        case 426:
            return "Upgrade Required";
        case 429:
            return "Too Many Requests";
        case 431:
            return "Request Header Fields Too Large";
        case 503:
            return "Service Unavailable";
        default:
            return "";
    }
}

// "Sun, 06 Nov 1994 08:49:37 GMT" (RFC 9110, 5.6.7), made once a second on each thread.
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

void append_head(std::string& out, HttpAnswer const& answer) {
    out.append("HTTP/1.1 ").append(std::to_string(answer.status)).append(" ").append(phrase_of(answer.status));
    out.append("\r\nDate: ").append(date());
    if (!answer.content_type.empty()) out.append("\r\nContent-Type: ").append(answer.content_type);
    if (!answer.cache_control.empty()) out.append("\r\nCache-Control: ").append(answer.cache_control);
    out.append("\r\n").append(answer.fields());
}

}  // namespace

void HttpAnswer::set(std::string_view name, std::string_view value) {
    fields_.append(name).append(": ");
    for (char const c : value) {
        if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) fields_.push_back(c);
    }
    fields_.append("\r\n");
}

HttpAnswer answer_of(Fault const& fault) {
    HttpAnswer answer;
    answer.status = http_status_of(fault.code);
    answer.body = xml::encode(fault);
    answer.fault = fault;
    return answer;
}

void append(std::string& out, HttpAnswer const& answer, Framing framing) {
    append_head(out, answer);
    bool const has_body = answer.status != 304 && answer.status != 101;
    if (has_body) out.append("Content-Length: ").append(std::to_string(answer.body.size())).append("\r\n");
    if (framing.close) out.append("Connection: close\r\n");
    out.append("\r\n");
    if (framing.body && has_body) out.append(answer.body);
}

void append_endless(std::string& out, HttpAnswer const& answer) {
    append_head(out, answer);
    out.append("Connection: close\r\n\r\n");
}

}  // namespace rois::net
