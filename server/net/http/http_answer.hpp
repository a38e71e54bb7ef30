// Answers to HTTP requests, and how they are written.
#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/status.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::net {

namespace http = boost::beast::http;

// By default: status 200, an XML document, not to be cached.
struct HttpAnswer {
    http::status status = http::status::ok;
    std::string body{};
    std::string_view content_type = "application/xml; charset=utf-8";  // empty: the answer has no such field
    std::string_view cache_control = "no-store";                       // likewise
    http::fields fields{};                                             // all others but Date, Connection and Content-Length
    std::optional<Fault> fault{};                                      // set: the body is this fault
};

HttpAnswer answer_of(Fault const&);
// Sets the status of an answer with this fault, and when the client may try again.
void set_status(HttpAnswer&, FaultCode);
// The client already has the document: its fields, without its body.
HttpAnswer not_modified(HttpAnswer);

// Appends an answer to `out`.
struct Framing {
    enum class Body : unsigned char {
        sent,
        omitted,  // the request was HEAD
        endless   // follows later, and ends with the connection
    } body = Body::sent;
    bool close = false;  // the connection ends after this answer
};
void append(std::string& out, HttpAnswer const&, Framing);

}  // namespace rois::net
