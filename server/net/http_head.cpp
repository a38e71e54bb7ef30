#include "net/http_head.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "types/texts.hpp"

namespace rois::net {

namespace {

bool is_token_char(char c) {
    auto const u = static_cast<unsigned char>(c);
    if ((u >= '0' && u <= '9') || ((u | 0x20) >= 'a' && (u | 0x20) <= 'z')) return true;
    return std::string_view{"!#$%&'*+-.^_`|~"}.find(c) != std::string_view::npos;
}

bool is_token(std::string_view text) { return !text.empty() && std::ranges::all_of(text, is_token_char); }

bool is_visible(char c) { return static_cast<unsigned char>(c) > 0x20 && c != 0x7f; }

bool is_field_char(char c) { return c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f); }

std::string_view without_blanks(std::string_view text) {
    auto const first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Fault broken(std::string reason) { return {FaultCode::not_well_formed, "broken HTTP: " + std::move(reason), {}, {}}; }

Fault overlong_target(Settings const& settings) {
    return {
        FaultCode::uri_too_long, "the request target is longer than " + std::to_string(settings.max_target) + " bytes", {}, {}};
}

// The next line without its end; `text` goes on behind it. Nothing when a line feed stands alone.
std::optional<std::string_view> next_line(std::string_view& text) {
    auto const end = text.find('\n');
    if (end == std::string_view::npos || end == 0 || text[end - 1] != '\r') return {};
    auto const line = text.substr(0, end - 1);
    text.remove_prefix(end + 1);
    return line;
}

// Splits "http://host/path?query" or "/path?query"; both are allowed (RFC 9112, 3.2).
bool read_target(std::string_view target, RequestHead& head) {
    if (equal_ignoring_case(target.substr(0, 7), "http://") || equal_ignoring_case(target.substr(0, 8), "https://")) {
        auto const path = target.find('/', target.find("//") + 2);
        target = path == std::string_view::npos ? std::string_view{"/"} : target.substr(path);
    }
    auto const question = target.find('?');
    head.path = target.substr(0, question);
    if (question != std::string_view::npos) head.query = target.substr(question + 1);
    return head.path.starts_with('/') || head.path == "*" || head.method == "CONNECT";
}

std::optional<Fault> read_request_line(std::string_view line, RequestHead& head, Settings const& settings) {
    auto const first = line.find(' ');
    auto const last = line.rfind(' ');
    if (first == std::string_view::npos || first == last) return broken("the request line is not 'method target version'");
    head.method = line.substr(0, first);
    auto const target = line.substr(first + 1, last - first - 1);
    auto const version = line.substr(last + 1);
    if (!is_token(head.method)) return broken("the method is not a token");
    if (target.size() > settings.max_target) return overlong_target(settings);
    if (target.empty() || !std::ranges::all_of(target, is_visible)) return broken("the target has a blank or control character");
    if (version != "HTTP/1.1" && version != "HTTP/1.0") return broken("this server speaks HTTP/1.1");
    head.http_1_0 = version == "HTTP/1.0";
    if (!read_target(target, head)) return broken("the target does not begin with '/'");
    return {};
}

std::optional<Fault> read_field(std::string_view line, RequestHead& head) {
    if (line.front() == ' ' || line.front() == '\t') return broken("a folded header line");
    auto const colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) return broken("a header line without a name");
    auto const value = without_blanks(line.substr(colon + 1));
    if (!std::ranges::all_of(value, is_field_char)) return broken("a header value with a control character");
    head.fields.push_back({line.substr(0, colon), value});
    return {};
}

// How long the body is, and whether that can be believed (RFC 9112, 6.3).
std::optional<Fault> read_framing(RequestHead& head) {
    auto const hosts = head.count("Host");
    if (hosts > 1 || (hosts == 0 && !head.http_1_0)) return broken("exactly one Host header is needed");
    if (head.count("Transfer-Encoding") > 0) {
        return Fault{FaultCode::length_required, "send the body with a Content-Length; Transfer-Encoding is not taken", {}, {}};
    }
    if (head.count("Content-Length") > 1) return broken("two Content-Length headers");
    auto const length = head.field("Content-Length");
    if (!length) return {};
    auto const [end, error] = std::from_chars(length->data(), length->data() + length->size(), head.content_length);
    bool const digits = !length->empty() && std::ranges::all_of(*length, [](char c) { return c >= '0' && c <= '9'; });
    if (!digits) return broken("Content-Length is not a number");
    if (error == std::errc::result_out_of_range) head.content_length = UINT64_MAX;
    return {};
}

}  // namespace

std::optional<std::string_view> RequestHead::field(std::string_view name) const {
    std::optional<std::string_view> found;
    for (auto const& field : fields) {
        if (!equal_ignoring_case(field.name, name)) continue;
        if (found) return {};
        found = field.value;
    }
    return found;
}

std::size_t RequestHead::count(std::string_view name) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(fields, [&](Field const& field) { return equal_ignoring_case(field.name, name); }));
}

bool RequestHead::lists(std::string_view name, std::string_view member) const {
    for (auto const& field : fields) {
        if (!equal_ignoring_case(field.name, name)) continue;
        for (auto rest = field.value; !rest.empty();) {
            auto const comma = std::min(rest.find(','), rest.size());
            if (equal_ignoring_case(without_blanks(rest.substr(0, comma)), member)) return true;
            rest.remove_prefix(std::min(comma + 1, rest.size()));
        }
    }
    return false;
}

std::optional<std::string_view> RequestHead::parameter(std::string_view name) const {
    for (auto rest = query; !rest.empty();) {
        auto const pair = rest.substr(0, rest.find('&'));
        auto const equals = std::min(pair.find('='), pair.size());
        if (pair.substr(0, equals) == name) return pair.substr(std::min(equals + 1, pair.size()));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    }
    return {};
}

std::size_t find_head(std::string_view text, std::size_t& searched) {
    while (true) {
        auto const end = text.find('\n', searched);
        if (end == std::string_view::npos) return searched = text.size(), 0;
        if (end == 0 || text[end - 1] != '\r') return end + 1;  // a line feed alone
        if (end >= 3 && text[end - 2] == '\n') return end + 1;  // an empty line
        searched = end + 1;
    }
}

std::variant<RequestHead, Fault> read_head(std::string_view text, Settings const& settings) {
    RequestHead head;
    auto const line = next_line(text);
    if (!line) return broken("a line that does not end with CR LF");
    if (auto fault = read_request_line(*line, head, settings)) return *fault;
    head.fields.reserve(16);
    while (true) {
        auto const field = next_line(text);
        if (!field) return broken("a line that does not end with CR LF");
        if (field->empty()) break;
        if (head.fields.size() == settings.max_fields) {
            return Fault{
                FaultCode::header_too_large, "more than " + std::to_string(settings.max_fields) + " header fields", {}, {}};
        }
        if (auto fault = read_field(*field, head)) return *fault;
    }
    if (auto fault = read_framing(head)) return *fault;
    return head;
}

Fault overlong_head(std::string_view text, Settings const& settings) {
    if (text.find('\n') == std::string_view::npos) return overlong_target(settings);
    return {FaultCode::header_too_large, "the header is longer than " + std::to_string(settings.max_header) + " bytes", {}, {}};
}

}  // namespace rois::net
