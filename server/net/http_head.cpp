#include "net/http_head.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/basic_parser.hpp>
#include <boost/none.hpp>
#include <charconv>
#include <string>
#include <utility>

#include "types/texts.hpp"

namespace rois::net {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

// Calls `what` with each member of a comma-separated list until one makes it true.
template <class What>
bool any_member(std::string_view list, What what) {
    while (!list.empty()) {
        auto const comma = std::min(list.find(','), list.size());
        if (what(without_blanks(list.substr(0, comma)))) return true;
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return false;
}

// Whether a member's parameters give it a weight of 0: it is not wanted at all (RFC 9110, 12.4.2).
bool is_refused(std::string_view parameters) {
    auto const weight = lower_case(parameters).find("q=");
    if (weight == std::string::npos) return false;
    auto const value = without_blanks(parameters.substr(weight + 2));
    return value.starts_with('0') && value.find_first_not_of("0.") == std::string_view::npos;
}

Fault broken(std::string reason) { return {FaultCode::not_well_formed, "broken HTTP: " + std::move(reason), {}, {}}; }

Fault overlong_target(Settings const& settings) {
    return {
        FaultCode::uri_too_long, "the request target is longer than " + std::to_string(settings.max_target) + " bytes", {}, {}};
}

Fault no_transfer_encoding() {
    return {FaultCode::length_required, "send the body with a Content-Length; Transfer-Encoding is not taken", {}, {}};
}

// Splits "http://host:80/path?query" or "/path?query"; both are allowed (RFC 9112, 3.2).
bool read_target(std::string_view target, RequestHead& head) {
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
    return head.path.starts_with('/') || head.path == "*" || head.method == "CONNECT";
}

// Whether the text may be a host with or without a port. The same check for the Host field and for the authority of a target.
bool may_be_authority(std::string_view text) { return text.find_first_of(" \t,/\\@\"<>?#") == std::string_view::npos; }

namespace http = boost::beast::http;
using boost::beast::error_code;
using boost::beast::string_view;

std::string_view view(string_view text) { return {text.data(), text.size()}; }

// Beast's parser, which gives the parts of a head as it finds them.
class HeadParser : public http::basic_parser<true> {
public:
    HeadParser(Settings const& settings, RequestHead& head) : settings_{settings}, head_{head} {
        body_limit(boost::none);  // the routes know how much they take
        head_.fields.clear();
    }

    std::optional<Fault> read(std::string_view text) {
        header_limit(static_cast<std::uint32_t>(text.size()) + 1);
        error_code problem;
        put(boost::asio::buffer(text), problem);
        if (fault_) return std::move(fault_);
        if (problem) return problem == http::error::bad_transfer_encoding ? no_transfer_encoding() : broken(problem.message());
        if (!is_header_done()) return broken("a line that does not end with CR LF");
        head_.content_length = content_length().value_or(0);
        return too_lenient(text);
    }

private:
    void on_request_impl(http::verb, string_view method, string_view target, int version, error_code& problem) override {
        head_.method = view(method);
        head_.http_1_0 = version == 10;
        if (target.size() > settings_.max_target) return refuse(overlong_target(settings_), problem);
        if (!read_target(view(target), head_))
            refuse(broken("the target is neither a path nor an http URL with a host"), problem);
    }

    void on_field_impl(http::field field, string_view name, string_view value, error_code& problem) override {
        if (head_.fields.size() >= settings_.max_fields) {
            return refuse(
                {FaultCode::header_too_large, "more than " + std::to_string(settings_.max_fields) + " header fields", {}, {}},
                problem);
        }
        head_.fields.push_back({view(name), view(value)});
        if (field == http::field::host) ++hosts_;
        if (field == http::field::content_length) ++lengths_;
        if (field == http::field::transfer_encoding) transfer_encoded_ = true;
    }

    void on_header_impl(error_code&) override {}
    void on_response_impl(int, string_view, int, error_code&) override {}
    void on_body_init_impl(boost::optional<std::uint64_t> const&, error_code&) override {}
    std::size_t on_body_impl(string_view body, error_code&) override { return body.size(); }
    void on_chunk_header_impl(std::uint64_t, string_view, error_code&) override {}
    std::size_t on_chunk_body_impl(std::uint64_t, string_view body, error_code&) override { return body.size(); }
    void on_finish_impl(error_code&) override {}

    // What Beast lets pass: lines folded into the next, and no Host, or two, or two lengths that agree (RFC 9112, 3.2, 5.2, 6.3).
    std::optional<Fault> too_lenient(std::string_view text) const {
        if (text.find("\r\n ") != std::string_view::npos || text.find("\r\n\t") != std::string_view::npos)
            return broken("a folded header line");
        if (hosts_ > 1 || (hosts_ == 0 && !head_.http_1_0)) return broken("exactly one Host header is needed");
        if (!may_be_authority(head_.field("Host").value_or("")))
            return broken("Host is not a name or an address with an optional port");
        if (!may_be_authority(head_.target_authority))
            return broken("the target's host is not a name or an address with an optional port");
        if (transfer_encoded_) return no_transfer_encoding();
        bool const two_in_one = lengths_ == 1 && head_.field("Content-Length").value_or("").find(',') != std::string_view::npos;
        if (lengths_ > 1 || two_in_one) return broken("two lengths in Content-Length");
        return {};
    }

    void refuse(Fault fault, error_code& problem) {
        fault_ = std::move(fault);
        problem = http::error::bad_value;
    }

    Settings const& settings_;
    RequestHead& head_;
    std::optional<Fault> fault_;
    std::size_t hosts_ = 0;
    std::size_t lengths_ = 0;
    bool transfer_encoded_ = false;
};

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
    return std::ranges::any_of(
        fields, [&](Field const& field) { return equal_ignoring_case(field.name, name) && any_member(field.value, is_meant); });
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

// What is said of gzip itself counts more than what is said of any encoding ("*").
bool RequestHead::takes_gzip() const {
    auto taken = std::pair{0, false};  // how closely it was said, and what
    for (auto const& field : fields) {
        if (!equal_ignoring_case(field.name, "Accept-Encoding")) continue;
        any_member(field.value, [&](std::string_view each) {
            auto const semicolon = std::min(each.find(';'), each.size());
            auto const name = without_blanks(each.substr(0, semicolon));
            int const closely = name == "*" ? 1 : equal_ignoring_case(name, "gzip") ? 2 : 0;
            if (closely > taken.first) taken = {closely, !is_refused(each.substr(semicolon))};
            return false;
        });
    }
    return taken.second;
}

std::string_view RequestHead::authority() const {
    return target_authority.empty() ? field("Host").value_or("") : target_authority;
}

std::string_view RequestHead::host() const {
    auto const said = authority();
    bool const harmless = std::ranges::all_of(said, [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               std::string_view{".:-_[]"}.find(c) != std::string_view::npos;
    });
    return harmless && !said.empty() ? said : "localhost";
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
    return HeadParser{settings, head}.read(text);
}

std::optional<Fault> HeadReader::read(std::string_view text, Settings const& settings) {
    repeated_ = repeat(text);
    if (repeated_) return {};
    text_.assign(text);
    auto fault = read_head(text_, settings, head_);
    if (fault) text_.clear();
    note_length();
    return fault;
}

// The digits are as many as before: so no view into the text changes.
bool HeadReader::repeat(std::string_view text) {
    auto const end = length_at_ + length_digits_;
    auto const last = std::string_view{text_};
    if (text.empty() || text.size() != last.size() || text.substr(end) != last.substr(end) ||
        text.substr(0, length_at_) != last.substr(0, length_at_))
        return false;
    if (length_digits_ == 0) return true;
    auto const digits = text.substr(length_at_, length_digits_);
    std::uint64_t length = 0;
    auto const [stop, error] = std::from_chars(digits.begin(), digits.end(), length);
    if (error != std::errc{} || stop != digits.end()) return false;
    digits.copy(text_.data() + length_at_, digits.size());
    head_.content_length = length;
    return true;
}

void HeadReader::forget_if_long() {
    constexpr std::size_t longest_kept = 4 * 1024;
    if (text_.size() <= longest_kept) return;
    std::string{}.swap(text_);
    head_ = {};
    length_at_ = length_digits_ = 0;
}

void HeadReader::note_length() {
    auto const length = text_.empty() ? std::nullopt : head_.field("Content-Length");
    length_digits_ = length ? length->size() : 0;
    length_at_ = length ? static_cast<std::size_t>(length->data() - text_.data()) : text_.size();
}

Fault overlong_head(std::string_view text, Settings const& settings) {
    if (text.find('\n') == std::string_view::npos) return overlong_target(settings);
    return {FaultCode::header_too_large, "the header is longer than " + std::to_string(settings.max_header) + " bytes", {}, {}};
}

}  // namespace rois::net
