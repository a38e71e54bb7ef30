// Reads the head of an HTTP/1.1 request (RFC 9112): the request line and the header fields. Strict where leniency has been
// abused: no folded lines, no bare line feeds, exactly one Host, one way to say how long the body is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/settings.hpp"
#include "types/messages.hpp"

namespace rois::net {

struct Field {
    std::string_view name;
    std::string_view value;  // without white space at its ends
};

// All views point into the text that was read.
struct RequestHead {
    std::string_view method;
    std::string_view target_authority;  // of a target in absolute form (RFC 9112, 3.2.2); else empty
    std::string_view path;              // as sent, without the query
    std::string_view query;             // what follows '?'
    bool http_1_0 = false;
    std::vector<Field> fields;
    std::uint64_t content_length = 0;

    // The value of the field of that name, compared without regard to case; nothing when it is absent or there twice.
    std::optional<std::string_view> field(std::string_view name) const;
    std::size_t count(std::string_view name) const;
    // Whether the comma-separated list in the fields of that name has this member.
    enum class Case : std::uint8_t { ignored, kept };
    bool lists(std::string_view name, std::string_view member, Case = Case::ignored) const;
    // The parameter's value in the query, undecoded: the first of that name.
    std::optional<std::string_view> parameter(std::string_view name) const;
    // Whether the client has this version already (RFC 9110, 13.1.2).
    bool knows(std::string_view etag) const;
    // Whether it takes a compressed body (RFC 9110, 12.5.3).
    bool takes_gzip() const;
    // The host and port that the client asked for: those of the target, else those of the Host field (RFC 9112, 3.2.2).
    std::string_view authority() const;
    // The authority, fit to be shown; "localhost" when it is empty or has characters that are not.
    std::string_view host() const;
    // Whether another request may follow on this connection.
    bool keep_alive() const { return !http_1_0 && !lists("Connection", "close"); }
};

// The bytes until the end of the head, or 0 as long as it is not complete. `searched` carries the position between calls with
// more and more of the same text. A line feed without carriage return ends the search: what it ends is given to read_head,
// which refuses it.
std::size_t find_head(std::string_view text, std::size_t& searched);

// Reads a complete head into one whose memory is used again. A fault means that the connection cannot go on.
std::optional<Fault> read_head(std::string_view text, Settings const&, RequestHead&);

// Reads the heads of one connection's requests. Clients write them alike, but for the length of what follows: a head that differs
// from the last in the digits of its Content-Length alone is not taken apart again. Not to be moved while `last` is in use.
class HeadReader {
public:
    // A complete head, which is kept. A fault means that the connection cannot go on.
    std::optional<Fault> read(std::string_view text, Settings const&);

    RequestHead const& last() const { return head_; }
    // Whether that said what the one before had said, but for content_length.
    bool repeated() const { return repeated_; }

    // Frees the memory of a head that is longer than most are: `last` is empty then.
    void forget_if_long();

private:
    bool repeat(std::string_view text);
    void note_length();

    std::string text_;
    RequestHead head_;  // views into text_
    bool repeated_ = false;
    std::size_t length_at_ = 0;  // where in text_ the digits of Content-Length are; as many as text_ when there are none
    std::size_t length_digits_ = 0;
};

// What to answer when a head has grown over the limit without an end.
Fault overlong_head(std::string_view text, Settings const&);

}  // namespace rois::net
