// Answers to HTTP requests, and how they are written.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::net {

namespace http = boost::beast::http;

// An XML document that clients must not cache, unless the fields say something else.
struct HttpAnswer {
    http::response<http::string_body> message;
    std::optional<Fault> fault;  // set: the body is this fault

    explicit HttpAnswer(std::string body = {}, std::string_view content_type = "application/xml; charset=utf-8");
    void set(http::field name, std::string_view value) { message.set(name, value); }
    void set(std::string_view name, std::string_view value) { message.set(name, value); }
};

HttpAnswer answer_of(Fault const&);
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
