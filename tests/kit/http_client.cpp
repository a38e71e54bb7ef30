#include "kit/http_client.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "kit/names.hpp"

namespace rois::kit {

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string trimmed(std::string const& text) {
    auto const begin = text.find_first_not_of(" \t");
    return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

Headers read_headers(std::string const& head) {
    Headers headers;
    for (auto begin = head.find("\r\n") + 2; begin < head.size() - 2;) {
        auto const end = head.find("\r\n", begin);
        auto const colon = head.find(':', begin);
        if (end == std::string::npos || colon > end) break;
        headers[lower(head.substr(begin, colon - begin))] = trimmed(head.substr(colon + 1, end - colon - 1));
        begin = end + 2;
    }
    return headers;
}

std::string lines_of(Headers const& headers) {
    std::string lines;
    for (auto const& [name, value] : headers) lines += name + ": " + value + "\r\n";
    return lines;
}

}  // namespace

pugi::xml_node HttpReply::root() const {
    if (!document_.document_element()) {
        document_.load_buffer(body.data(), body.size());
        give_known_prefixes(document_);
    }
    return document_.document_element();
}

std::string HttpReply::fault() const {
    return std::string_view{root().name()} == "fault" ? root().attribute("code").value() : "";
}

std::string HttpReply::reason() const { return text("reason"); }

std::string HttpReply::return_code() const { return root().attribute("return_code").value(); }

std::string HttpReply::text(char const* child) const { return root().child(child).text().get(); }

std::string HttpReply::header(std::string const& name) const {
    auto const found = headers.find(lower(name));
    return found == headers.end() ? "" : found->second;
}

std::string path_segment(std::string_view name) {
    constexpr std::string_view digits = "0123456789ABCDEF", unreserved = "-._~";
    std::string segment;
    for (char const c : name) {
        auto const byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && (std::isalnum(byte) || unreserved.find(c) != unreserved.npos)) {
            segment += c;
        } else {
            ((segment += '%') += digits[byte >> 4]) += digits[byte & 15];
        }
    }
    return segment;
}

std::string request(std::string const& operation, Xml const& children, Attributes const& attributes) {
    Attributes all{{"xmlns", "urn:x-rois:psm:xml:message:1"}, {"xmlns:rois", "http://www.omg.org/spec/RoIS/20240801"}};
    all.insert(all.end(), attributes.begin(), attributes.end());
    return element(operation, all, children).text();
}

Xml component_ref(std::string const& code) { return element("component_ref", {{"rois:code", code}}); }

Xml parameters(std::string const& name, int value) {
    return element("parameters", element("parameter", {{"rois:name", name}},
                                         element("rois:data_type_ref", {{"rois:code", "int"}}) +
                                             text_element("rois:value", std::to_string(value))));
}

HttpClient::~HttpClient() {
    if (session.empty()) return;
    try {
        Line line{address_};
        auto const body = request("disconnect");
        line.send("POST /rois HTTP/1.1\r\nConnection: close\r\nContent-Type: text/xml\r\n" + common_headers() +
                  "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
        line.rest();
    } catch (std::exception const&) {
        // The gateway has ended, and the session with it.
    }
}

std::string HttpClient::common_headers() const {
    return "Host: " + address_.authority + "\r\n" + (session.empty() ? "" : "RoIS-Session: " + session + "\r\n") +
           (address_.token.empty() ? "" : "Authorization: Bearer " + address_.token + "\r\n");
}

HttpReply HttpClient::say(std::string_view bytes, std::string_view method) {
    line_->send(bytes);
    return read(method);
}

HttpReply HttpClient::read(std::string_view method) {
    HttpReply reply;
    auto const head = line_->take_until("\r\n\r\n");
    if (!head.starts_with("HTTP/1.1 ") || head.size() < 12) throw LineEnded{"expected an HTTP/1.1 answer, got " + head};
    reply.status = std::atoi(head.substr(9, 3).c_str());
    reply.headers = read_headers(head);
    reopens_ = lower(reply.header("connection")).find("close") != std::string::npos;
    is_chunked_ = lower(reply.header("transfer-encoding")).ends_with("chunked");
    if (method == "HEAD" || reply.status < 200 || reply.status == 204 || reply.status == 304 ||
        reply.header("content-type").starts_with("text/event-stream"))
        return reply;
    auto const length = reply.header("content-length");
    if (is_chunked_) {
        for (auto chunk = next_chunk(); !chunk.empty(); chunk = next_chunk()) reply.body += chunk;
    } else if (!length.empty()) {
        reply.body = line_->take(std::strtoul(length.c_str(), nullptr, 10));
    } else {
        reply.body = line_->rest();
        reopens_ = true;
    }
    return reply;
}

std::string HttpClient::next_chunk() {
    auto const size = line_->take_until("\r\n");
    char* end = nullptr;
    auto const length = std::strtoul(size.c_str(), &end, 16);
    if (end == size.c_str()) throw LineEnded{"chunked body: expected the size of a chunk, got " + size};
    if (length == 0) {
        while (line_->take_until("\r\n") != "\r\n") {  // trailers
        }
        return {};
    }
    auto chunk = line_->take(length);
    if (line_->take(2) != "\r\n") throw LineEnded{"a chunk is longer than its size: " + size};
    return chunk;
}

std::string HttpClient::next_line() {
    if (!is_chunked_) return line_->take_until("\n");
    for (auto end = streamed_.find('\n'); end == std::string::npos; end = streamed_.find('\n')) {
        auto const chunk = next_chunk();
        if (chunk.empty()) throw LineEnded{"the event stream ended within a line: " + streamed_};
        streamed_ += chunk;
    }
    auto const end = streamed_.find('\n') + 1;
    auto line = streamed_.substr(0, end);
    streamed_.erase(0, end);
    return line;
}

void HttpClient::reopen_when_closed() {
    if (std::exchange(reopens_, false)) line_ = std::make_unique<Line>(address_);
}

HttpReply HttpClient::get(std::string const& target, Headers const& headers, std::string const& method) {
    reopen_when_closed();
    return say(method + " " + target + " HTTP/1.1\r\n" + common_headers() + lines_of(headers) + "\r\n", method);
}

HttpReply HttpClient::post(std::string const& body, Headers const& headers) {
    reopen_when_closed();
    return say("POST /rois HTTP/1.1\r\n" + common_headers() + lines_of(headers) +
               "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
}

HttpReply HttpClient::call(std::string const& operation, Xml const& children, Attributes const& attributes) {
    auto const reply = post(request(operation, children, attributes));
    if (operation == "connect" && reply.return_code() == "OK") session = reply.text("session");
    return reply;
}

HttpReply HttpClient::notifications(unsigned after, unsigned wait) {
    constexpr std::chrono::seconds on_its_way{5};  // longest delay of an answer
    reopen_when_closed();
    line_->set_patience(std::max<std::chrono::milliseconds>(address_.patience, std::chrono::seconds{wait} + on_its_way));
    auto reply = get("/rois/notifications?after=" + std::to_string(after) + "&wait=" + std::to_string(wait));
    line_->set_patience(address_.patience);
    return reply;
}

}  // namespace rois::kit
