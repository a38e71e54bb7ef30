// A client that speaks HTTP/1.1 over a Line, and reads the XML of the answers.
#pragma once

#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "client/line.hpp"
#include "client/xml.hpp"

namespace rois::client {

using Headers = std::map<std::string, std::string>;  // of an answer: names in lower case

struct HttpReply {
    int status = 0;
    Headers headers;
    std::string body;

    pugi::xml_node root() const;      // of the body's document, in the names of wire.md
    std::string fault() const;        // the code when the body is a fault, else empty
    std::string reason() const;       // of a fault or an answer
    std::string return_code() const;  // of an answer
    std::string text(char const* child) const;
    std::string header(std::string const& name) const;

private:
    mutable pugi::xml_document document_;

public:
    HttpReply() = default;
    HttpReply(HttpReply const& other) : status{other.status}, headers{other.headers}, body{other.body} {}
};

// A name as a part of a path has it (RFC 3986, 2.1).
std::string path_segment(std::string_view name);

// "<bind xmlns=... >children</bind>"
std::string request(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
Xml component_ref(std::string const& code);
// `<parameters>` for set_parameter: one whole number.
Xml parameters(std::string const& name, int value);

// Disconnects its session in the end, so that others find the components free.
class HttpClient {
public:
    explicit HttpClient(Address const& address) : address_{address}, line_{std::make_unique<Line>(address_)} {}
    ~HttpClient();
    HttpClient(HttpClient const&) = delete;
    HttpClient& operator=(HttpClient const&) = delete;

    Line& line() { return *line_; }

    // Any bytes, then the next answer.
    HttpReply say(std::string_view bytes, std::string_view method = "GET");
    HttpReply read(std::string_view method = "GET");  // of an event stream only the head
    std::string next_line();                          // of an event stream, with its end
    // Both come over a new connection when the last answer has closed this one.
    HttpReply get(std::string const& target, Headers const& = {}, std::string const& method = "GET");
    HttpReply post(std::string const& body, Headers const& = {{"Content-Type", "application/xml"}});

    // An operation in the session that `connect` opened here.
    HttpReply call(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
    // The notifications after this one, or none after `wait` seconds, for which its line waits longer than that.
    HttpReply notifications(unsigned after, unsigned wait = 10);

    std::string session;

private:
    std::string always() const;  // the header lines that every request has

    std::string next_chunk();  // of a body in chunks (RFC 9112, 7.1); empty at its end
    void reopen_when_closed();

    Address address_;
    std::unique_ptr<Line> line_;
    bool reopens_ = false;
    bool is_chunked_ = false;
    std::string streamed_;  // of an event stream in chunks: arrived, not read
};

}  // namespace rois::client
