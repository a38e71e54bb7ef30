#include "net/http/http_head.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/none.hpp>
#include <utility>

#include "gateway/access/secrets.hpp"
#include "types/text/texts.hpp"

namespace rois::net {

namespace {

// Calls `matches` with each member of a comma-separated list. Returns true at the first member for which `matches` returns true.
bool any_member(std::string_view list, auto const& matches) {
    while (!list.empty()) {
        auto const comma = std::min(list.find(','), list.size());
        if (matches(trimmed(list.substr(0, comma)))) return true;
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return false;
}

// Returns whether the parameters of a list member give it a weight of 0: the client does not accept it (RFC 9110, 12.4.2).
bool is_refused(std::string_view parameters) {
    auto const weight = lower_case(parameters).find("q=");
    if (weight == std::string::npos) return false;
    auto const value = trimmed(parameters.substr(weight + 2));
    return value.starts_with('0') && value.find_first_not_of("0.") == std::string_view::npos;
}

Fault broken(std::string reason) { return {FaultCode::not_well_formed, "broken HTTP: " + std::move(reason)}; }

Fault overlong_target(Settings const& settings) {
    return {FaultCode::uri_too_long, "the target has more than " + std::to_string(settings.max_target) + " bytes (max_target)"};
}

Fault no_transfer_encoding() {
    return {FaultCode::length_required, "send the body with a Content-Length; Transfer-Encoding is not supported"};
}

// Splits the target: "http://host:80/path?query" or "/path?query". Returns false if it has neither form (RFC 9112, 3.2).
bool split_target(std::string_view target, RequestHead& head) {
    bool const absolute =
        equal_ignoring_case(target.substr(0, 7), "http://") || equal_ignoring_case(target.substr(0, 8), "https://");
    head.target_authority = {};
    if (absolute) {
        target.remove_prefix(target.find("//") + 2);
        head.target_authority = target.substr(0, target.find_first_of("/?"));
        target.remove_prefix(head.target_authority.size());
    }
    auto const question = std::min(target.find('?'), target.size());
    head.path = target.substr(0, question);
    head.query = target.substr(std::min(question + 1, target.size()));
    if (absolute && head.path.empty()) head.path = "/";
    if (absolute) return !head.target_authority.empty();
    return head.path.starts_with('/') || head.path == "*" || head.verb() == http::verb::connect;
}

// Checks the Host field, and the authority of a target: a host with an optional port.
bool may_be_authority(std::string_view text) { return text.find_first_of(" \t,/\\@\"<>?#") == std::string_view::npos; }

// Returns whether a header field goes on in another line, which Beast accepts.
bool is_folded(std::string_view head) {
    for (auto end = head.find('\n'); end < head.size() - 1; end = head.find('\n', end + 1))
        if (head[end + 1] == ' ' || head[end + 1] == '\t') return true;
    return false;
}

// Returns whether the text has visible characters of ASCII only. Random bytes, the content of a token, practically never have.
bool is_one_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c > ' ' && c < 0x7F; });
}

// Returns a fault for what Beast accepts and this gateway rejects (RFC 9112, 3.2, 5.2, 6.3).
std::optional<Fault> find_fault(std::string_view text, Settings const& settings, RequestHead const& head) {
    std::size_t hosts = 0, lengths = 0;
    std::string_view host, length;
    for (auto const& field : head.message) {
        if (field.name() == http::field::host) ++hosts, host = field.value();
        if (field.name() == http::field::content_length) ++lengths, length = field.value();
        if (field.name() == http::field::transfer_encoding) return no_transfer_encoding();
    }
    if (static_cast<std::size_t>(std::distance(head.message.begin(), head.message.end())) > settings.max_header_fields)
        return Fault{FaultCode::header_too_large,
                     "more than " + std::to_string(settings.max_header_fields) + " header fields (max_header_fields)"};
    if (is_folded(text)) return broken("a folded header line: send each header field in one line");
    if (hosts > 1 || (hosts == 0 && !head.is_http_1_0())) return broken("expected exactly one Host header");
    if (!may_be_authority(host)) return broken("Host " + quoted(host) + " is not a name or an address with an optional port");
    if (!may_be_authority(head.target_authority))
        return broken("the target's host is not a name or an address with an optional port");
    if (lengths > 1 || length.find(',') != length.npos) return broken("expected one Content-Length header, with one number");
    return {};
}

}  // namespace

std::optional<std::string_view> RequestHead::field(std::string_view name) const {
    std::optional<std::string_view> value;
    for (auto const& each : message) {
        if (!equal_ignoring_case(each.name_string(), name)) continue;
        if (value) return {};
        value = each.value();
    }
    return value;
}

bool RequestHead::lists(std::string_view name, std::string_view member, Case letters) const {
    auto const is_meant = [&](std::string_view each) {
        return letters == Case::kept ? each == member : equal_ignoring_case(each, member);
    };
    auto const [first, last] = message.equal_range(name);
    return std::any_of(first, last, [&](auto const& field) { return any_member(field.value(), is_meant); });
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

bool RequestHead::knows(std::string_view etag) const {
    return lists("If-None-Match", "*") || lists("If-None-Match", etag) || lists("If-None-Match", "W/" + std::string{etag});
}

// A weight for gzip itself takes precedence over a weight for all encodings ("*").
bool RequestHead::takes_gzip() const {
    bool named = false;
    bool taken = false;
    auto const [first, last] = message.equal_range(http::field::accept_encoding);
    for (auto field = first; field != last; ++field)
        any_member(field->value(), [&](std::string_view each) {
            auto const semicolon = std::min(each.find(';'), each.size());
            auto const encoding = trimmed(each.substr(0, semicolon));
            bool const is_gzip = equal_ignoring_case(encoding, "gzip");
            if (!named && (is_gzip || encoding == "*")) taken = !is_refused(each.substr(semicolon));
            named = named || is_gzip;
            return false;
        });
    return taken;
}

std::optional<std::string> RequestHead::token() const {
    constexpr std::string_view scheme = "Bearer ", subprotocol = "rois.bearer.";
    std::optional<std::string> found;
    auto const note = [&](std::string_view token) { found = found ? "" : token; };
    for (auto const& each : message) {
        std::string_view const value = each.value();
        if (each.name() == http::field::authorization)
            note(equal_ignoring_case(value.substr(0, scheme.size()), scheme) ? trimmed(value.substr(scheme.size())) : "");
        if (each.name() == http::field::sec_websocket_protocol && lists("Upgrade", "websocket"))
            any_member(value, [&](std::string_view member) {
                if (!member.starts_with(subprotocol)) return false;
                auto const token = member.substr(subprotocol.size());
                auto const decoded = from_base64url(token);
                note(is_one_word(decoded) ? decoded : token);
                return false;
            });
    }
    return found;
}

std::string_view RequestHead::authority() const {
    return target_authority.empty() ? field("Host").value_or("") : target_authority;
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

std::optional<Fault> read_head(std::string_view text, Settings const& settings, RequestHead& head) {
    http::request_parser<http::empty_body> parser;
    parser.header_limit(static_cast<std::uint32_t>(text.size()) + 1);
    parser.body_limit(boost::none);  // the routes check the length
    boost::system::error_code error;
    parser.put(boost::asio::buffer(text), error);
    if (error == http::error::bad_transfer_encoding) return no_transfer_encoding();
    if (error && error != http::error::need_more) return broken(error.message());
    if (!parser.is_header_done()) return broken("a line that does not end with CR LF");
    head.content_length = parser.content_length().value_or(0);
    head.message = std::move(parser.get().base());
    std::string_view const target = head.message.target();
    if (target.size() > settings.max_target) return overlong_target(settings);
    if (!split_target(target, head)) return broken("the target is neither a path nor an http URL with a host");
    return find_fault(text, settings, head);
}

Fault overlong_head(std::string_view text, Settings const& settings) {
    if (text.find('\n') == std::string_view::npos) return overlong_target(settings);
    return {FaultCode::header_too_large, "the head has more than " + std::to_string(settings.max_header) + " bytes (max_header)"};
}

}  // namespace rois::net
