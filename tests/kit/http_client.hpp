// An HTTP/1.1 client on a Line that reads the XML of the answers.
#pragma once

#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "kit/line.hpp"
#include "kit/xml.hpp"

namespace rois::kit {

using Headers = std::map<std::string, std::string>;  // of an answer: names in lower case

struct HttpReply {
    int status = 0;
    Headers headers;
    std::string body;

    pugi::xml_node root() const;      // of the body's document, with known prefixes (names.hpp)
    std::string fault() const;        // the code if the body is a fault, else empty
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

// Percent-encodes a name for a path (RFC 3986, 2.1).
std::string path_segment(std::string_view name);

// "<bind xmlns=... >children</bind>"
std::string request(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
Xml component_ref(std::string const& code);
// `<parameters>` for set_parameter: one whole number.
Xml parameters(std::string const& name, int value);

// Disconnects its session in the destructor, so that its components are free for others.
class HttpClient {
public:
    explicit HttpClient(Address const& address) : address_{address}, line_{std::make_unique<Line>(address_)} {}
    ~HttpClient();
    HttpClient(HttpClient const&) = delete;
    HttpClient& operator=(HttpClient const&) = delete;

    Line& line() { return *line_; }

    // Sends any bytes and reads the next answer.
    HttpReply say(std::string_view bytes, std::string_view method = "GET");
    HttpReply read(std::string_view method = "GET");  // of an event stream only the head
    std::string next_line();                          // of an event stream, with its line end
    // Both open a new connection if the server has closed the last one.
    HttpReply get(std::string const& target, Headers const& = {}, std::string const& method = "GET");
    HttpReply post(std::string const& body, Headers const& = {{"Content-Type", "application/xml"}});

    // Sends an operation in the session that `connect` has opened.
    HttpReply call(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});
    // Long poll: returns the notifications after this sequence, or none after `wait` seconds.
    HttpReply notifications(unsigned after, unsigned wait = 10);

    std::string session;

private:
    std::string common_headers() const;  // the header lines of every request

    std::string next_chunk();  // the next chunk of a chunked body (RFC 9112, 7.1); empty at the end
    void reopen_when_closed();

    Address address_;
    std::unique_ptr<Line> line_;
    bool reopens_ = false;
    bool is_chunked_ = false;
    std::string streamed_;  // of a chunked event stream: received bytes that were not read yet
};

}  // namespace rois::kit
