// What an HTTP request is answered with, and how that looks on the wire.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::net {

struct HttpAnswer {
    int status = 200;
    std::string_view content_type = "application/xml; charset=utf-8";  // this and the next are texts of the program
    std::string_view cache_control = "no-store";
    std::string body;
    std::optional<Fault> fault;  // which the body is

    // Adds a header field. Control characters in the value are left out, so that nothing can break out of its line.
    void set(std::string_view name, std::string_view value);
    std::string const& fields() const { return fields_; }

private:
    std::string fields_;
};

HttpAnswer answer_of(Fault const&);

// Appends the answer to `out`. What the request asked for decides what is sent of it.
struct Framing {
    bool body = true;    // false for HEAD
    bool close = false;  // the connection ends after this answer
};
void append(std::string& out, HttpAnswer const&, Framing);

// The head of an answer whose body goes on until the connection ends.
void append_endless(std::string& out, HttpAnswer const&);

}  // namespace rois::net
