// The head of an HTTP/1.1 request (RFC 9112), parsed by Boost.Beast.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/verb.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/access/host_names.hpp"
#include "net/settings.hpp"
#include "types/messages.hpp"

namespace rois::net {

namespace http = boost::beast::http;

// Names of fields, and members of lists unless stated otherwise, are compared without regard to case. The views point into
// `message`.
struct RequestHead {
    RequestHead() = default;
    RequestHead(RequestHead&&) = default;  // no copies: their views would point into the original
    RequestHead& operator=(RequestHead&&) = default;

    http::request_header<> message;
    std::string_view target_authority;  // of a target in absolute form (RFC 9112, 3.2.2); else empty
    std::string_view path;              // as sent, without the query
    std::string_view query;             // the text behind '?'
    std::uint64_t content_length = 0;

    http::verb verb() const { return message.method(); }
    std::string_view method() const { return message.method_string(); }
    bool is_http_1_0() const { return message.version() == 10; }

    // Returns the value of the field. Returns nothing if the field is missing or occurs twice.
    std::optional<std::string_view> field(std::string_view name) const;
    enum class Case : std::uint8_t { ignored, kept };
    // Returns whether the comma-separated lists in all fields of this name contain the member.
    bool lists(std::string_view name, std::string_view member, Case = Case::ignored) const;
    // Returns the value of the first parameter of this name in the query, without decoding it.
    std::optional<std::string_view> parameter(std::string_view name) const;
    // Returns whether the client already has this version of a document (RFC 9110, 13.1.2).
    bool knows(std::string_view etag) const;
    // Returns whether the client accepts a body that is compressed with gzip (RFC 9110, 12.5.3).
    bool takes_gzip() const;
    // Returns the token of the header Authorization (RFC 6750), or of a subprotocol "rois.bearer.TOKEN", because browsers cannot
    // send the header with a WebSocket; there TOKEN may be in base64url. Returns an empty text if there are several or it is not
    // a token, nothing if there is none.
    std::optional<std::string> token() const;
    // The host and port that the request is for: those of the target, else those of the field Host (RFC 9112, 3.2.2).
    std::string_view authority() const;
    // The authority, for use in texts.
    std::string_view host() const { return harmless_host(authority()); }
    // Returns whether another request may follow on this connection.
    bool keep_alive() const { return !is_http_1_0() && !lists("Connection", "close"); }
};

// Returns the size of the head at the front of `text`, or 0 if it is incomplete. `searched` keeps the position between calls with
// a growing text. A line feed without a carriage return ends the head, too: read_head then rejects it.
std::size_t find_head(std::string_view text, std::size_t& searched);

// Parses a complete head. Returns a fault if it is invalid: the end of the request is then unknown, and the connection must end.
// Stricter than Beast: rejects folded lines, bare line feeds, a missing or second Host, and a second Content-Length.
std::optional<Fault> read_head(std::string_view text, Settings const&, RequestHead&);

// The fault for a head that is longer than `max_header`, or still incomplete at that length.
Fault overlong_head(std::string_view text, Settings const&);

}  // namespace rois::net
