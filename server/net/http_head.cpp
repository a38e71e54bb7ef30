#include "net/http_head.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/basic_parser.hpp>
#include <boost/none.hpp>
#include <string>

#include "types/texts.hpp"

namespace rois::net {

namespace {

std::string_view without_blanks(std::string_view text) {
    auto const first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Fault broken(std::string reason) { return {FaultCode::not_well_formed, "broken HTTP: " + std::move(reason), {}, {}}; }

Fault overlong_target(Settings const& settings) {
    return {
        FaultCode::uri_too_long, "the request target is longer than " + std::to_string(settings.max_target) + " bytes", {}, {}};
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

namespace http = boost::beast::http;
using boost::beast::error_code;
using boost::beast::string_view;

std::string_view view(string_view text) { return {text.data(), text.size()}; }

// Beast's parser, which gives the parts of a head as it finds them.
class HeadParser : public http::basic_parser<true> {
public:
    explicit HeadParser(Settings const& settings) : settings_{settings} {
        body_limit(boost::none);  // the routes know how much they take
        head_.fields.reserve(16);
    }

    RequestHead& head() { return head_; }
    std::optional<Fault>& fault() { return fault_; }

private:
    void on_request_impl(http::verb, string_view method, string_view target, int version, error_code& problem) override {
        head_.method = view(method);
        head_.http_1_0 = version == 10;
        if (target.size() > settings_.max_target) return refuse(overlong_target(settings_), problem);
        if (!read_target(view(target), head_)) refuse(broken("the target does not begin with '/'"), problem);
    }

    void on_field_impl(http::field, string_view name, string_view value, error_code& problem) override {
        if (head_.fields.size() < settings_.max_fields) {
            head_.fields.push_back({view(name), view(value)});
            return;
        }
        refuse({FaultCode::header_too_large, "more than " + std::to_string(settings_.max_fields) + " header fields", {}, {}},
               problem);
    }

    void on_header_impl(error_code&) override {}
    void on_response_impl(int, string_view, int, error_code&) override {}
    void on_body_init_impl(boost::optional<std::uint64_t> const&, error_code&) override {}
    std::size_t on_body_impl(string_view body, error_code&) override { return body.size(); }
    void on_chunk_header_impl(std::uint64_t, string_view, error_code&) override {}
    std::size_t on_chunk_body_impl(std::uint64_t, string_view body, error_code&) override { return body.size(); }
    void on_finish_impl(error_code&) override {}

    void refuse(Fault fault, error_code& problem) {
        fault_ = std::move(fault);
        problem = http::error::bad_value;
    }

    Settings const& settings_;
    RequestHead head_;
    std::optional<Fault> fault_;
};

Fault no_transfer_encoding() {
    return {FaultCode::length_required, "send the body with a Content-Length; Transfer-Encoding is not taken", {}, {}};
}

Fault fault_of(error_code const& problem) {
    if (problem == http::error::bad_transfer_encoding) return no_transfer_encoding();
    return broken(problem.message());
}

// What Beast lets pass: lines folded into the next, and no Host, or two, or two lengths that agree (RFC 9112, 3.2, 5.2, 6.3).
std::optional<Fault> too_lenient(std::string_view text, RequestHead const& head) {
    if (text.find("\r\n ") != std::string_view::npos || text.find("\r\n\t") != std::string_view::npos)
        return broken("a folded header line");
    auto const hosts = head.count("Host");
    if (hosts > 1 || (hosts == 0 && !head.http_1_0)) return broken("exactly one Host header is needed");
    if (head.field("Host").value_or("").find_first_of(" \t,/\\@\"<>") != std::string_view::npos)
        return broken("Host is no name or address, perhaps with a port");
    if (head.count("Transfer-Encoding") > 0) return no_transfer_encoding();
    bool const two_in_one = head.field("Content-Length").value_or("").find(',') != std::string_view::npos;
    if (head.count("Content-Length") > 1 || two_in_one) return broken("two lengths in Content-Length");
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

bool RequestHead::lists(std::string_view name, std::string_view member, Case letters) const {
    auto const is_meant = [&](std::string_view each) {
        return letters == Case::kept ? each == member : equal_ignoring_case(each, member);
    };
    for (auto const& field : fields) {
        if (!equal_ignoring_case(field.name, name)) continue;
        for (auto rest = field.value; !rest.empty();) {
            auto const comma = std::min(rest.find(','), rest.size());
            if (is_meant(without_blanks(rest.substr(0, comma)))) return true;
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
    HeadParser parser{settings};
    parser.header_limit(static_cast<std::uint32_t>(text.size()) + 1);
    error_code problem;
    parser.put(boost::asio::buffer(text), problem);
    if (parser.fault()) return std::move(*parser.fault());
    if (problem) return fault_of(problem);
    if (!parser.is_header_done()) return broken("a line that does not end with CR LF");
    auto& head = parser.head();
    if (auto fault = too_lenient(text, head)) return std::move(*fault);
    head.content_length = parser.content_length().value_or(0);
    return std::move(head);
}

Fault overlong_head(std::string_view text, Settings const& settings) {
    if (text.find('\n') == std::string_view::npos) return overlong_target(settings);
    return {FaultCode::header_too_large, "the header is longer than " + std::to_string(settings.max_header) + " bytes", {}, {}};
}

}  // namespace rois::net
