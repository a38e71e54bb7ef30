#include "net/http_head.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>

#include "types/texts.hpp"

namespace rois::net {

namespace {

// Where a byte may stand (RFC 9110, 5.5 and 5.6.2). Bytes beyond ASCII are nobody's business in targets and values.
enum Place : unsigned char { token = 1, target = 2, value = 4 };

constexpr std::array<unsigned char, 256> places = [] {
    std::array<unsigned char, 256> all{};
    for (unsigned c = 0x21; c < 256; ++c) all[c] = c == 0x7F ? 0 : target | value;
    all[' '] = all['\t'] = value;
    for (unsigned c = '0'; c <= 'z'; ++c) {
        bool const letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (letter || c <= '9') all[c] |= token;
    }
    for (unsigned char const c : std::string_view{"!#$%&'*+-.^_`|~"}) all[c] |= token;
    return all;
}();

bool all_may_stand(std::string_view text, Place place) {
    unsigned char all = place;
    for (char const c : text) all &= places[static_cast<unsigned char>(c)];
    return all != 0;
}

bool is_token(std::string_view text) { return !text.empty() && all_may_stand(text, token); }

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

// As most write it, or in other letters.
bool same_name(std::string_view a, std::string_view b) { return a.size() == b.size() && (a == b || equal_ignoring_case(a, b)); }

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

Fault broken(std::string_view reason) { return {FaultCode::not_well_formed, "broken HTTP: " + std::string{reason}, {}, {}}; }

Fault overlong_target(Settings const& settings) {
    return {
        FaultCode::uri_too_long, "the request target is longer than " + std::to_string(settings.max_target) + " bytes", {}, {}};
}

// Reads one head, line by line.
class HeadReader {
public:
    HeadReader(std::string_view text, Settings const& settings, RequestHead& head)
        : rest_{text}, settings_{settings}, head_{head} {}

    std::optional<Fault> read() {
        if (auto fault = request_line()) return fault;
        while (!rest_.starts_with("\r\n")) {
            if (auto fault = field()) return fault;
        }
        if (hosts_ > 1 || (hosts_ == 0 && !head_.http_1_0)) return broken("exactly one Host header is needed");
        if (transfer_encoded_)
            return Fault{
                FaultCode::length_required, "send the body with a Content-Length; Transfer-Encoding is not taken", {}, {}};
        return {};
    }

private:
    std::optional<Fault> request_line() {
        auto const line = take_line();
        if (!line) return unended();
        auto const method_end = std::min(line->find(' '), line->size());
        head_.method = line->substr(0, method_end);
        if (!is_token(head_.method)) return broken("the method is no token");
        auto const behind = line->substr(std::min(method_end + 1, line->size()));
        auto const target_end = std::min(behind.find(' '), behind.size());
        auto const version = behind.substr(std::min(target_end + 1, behind.size()));
        head_.http_1_0 = version == "HTTP/1.0";
        if (!head_.http_1_0 && version != "HTTP/1.1") return broken("a request line is METHOD TARGET HTTP/1.1");
        return read_target(behind.substr(0, target_end));
    }

    // Splits "http://host/path?query" or "/path?query"; both are allowed (RFC 9112, 3.2).
    std::optional<Fault> read_target(std::string_view text) {
        if (text.size() > settings_.max_target) return overlong_target(settings_);
        if (text.empty()) return broken("a request line is METHOD TARGET HTTP/1.1");
        if (!all_may_stand(text, target)) return broken("a character that no target has");
        if (!text.starts_with('/') &&
            (equal_ignoring_case(text.substr(0, 7), "http://") || equal_ignoring_case(text.substr(0, 8), "https://"))) {
            auto const path = text.find('/', text.find("//") + 2);
            text = path == std::string_view::npos ? std::string_view{"/"} : text.substr(path);
        }
        auto const question = std::min(text.find('?'), text.size());
        head_.path = text.substr(0, question);
        head_.query = text.substr(std::min(question + 1, text.size()));
        if (head_.path.starts_with('/') || head_.path == "*" || head_.method == "CONNECT") return {};
        return broken("the target does not begin with '/'");
    }

    std::optional<Fault> field() {
        if (!rest_.empty() && is_blank(rest_.front())) return broken("a folded header line");
        auto const line = take_line();
        if (!line) return unended();
        auto const colon = line->find(':');
        if (colon == std::string_view::npos || !is_token(line->substr(0, colon)))
            return broken("a header line is a name, a colon and a value");
        Field const field{line->substr(0, colon), without_blanks(line->substr(colon + 1))};
        if (!all_may_stand(field.value, value)) return broken("a control character in a header field");
        if (head_.fields.size() >= settings_.max_fields) {
            return Fault{
                FaultCode::header_too_large, "more than " + std::to_string(settings_.max_fields) + " header fields", {}, {}};
        }
        head_.fields.push_back(field);
        return look_into(field);
    }

    // What the length of the message and the fate of the connection depend on is checked whoever asks for it.
    std::optional<Fault> look_into(Field const& field) {
        if (same_name(field.name, "Host")) {
            ++hosts_;
            if (field.value.find_first_of(" \t,/\\@\"<>") != std::string_view::npos)
                return broken("Host is no name or address, perhaps with a port");
        } else if (same_name(field.name, "Content-Length")) {
            if (std::exchange(has_length_, true)) return broken("two lengths in Content-Length");
            auto const* const end = field.value.data() + field.value.size();
            auto const [stopped, problem] = std::from_chars(field.value.data(), end, head_.content_length);
            if (problem != std::errc{} || stopped != end) return broken("Content-Length is no length");
        } else if (same_name(field.name, "Transfer-Encoding")) {
            transfer_encoded_ = true;
        } else if (same_name(field.name, "Connection") || same_name(field.name, "Proxy-Connection")) {
            auto const wrong = [](std::string_view member) { return !member.empty() && !is_token(member); };
            if (any_member(field.value, wrong)) return broken("Connection is a list of tokens");
        }
        return {};
    }

    // Without its end; nothing when that is not CR LF.
    std::optional<std::string_view> take_line() {
        auto const end = rest_.find('\n');
        if (end == std::string_view::npos || end == 0 || rest_[end - 1] != '\r') return {};
        auto const line = rest_.substr(0, end - 1);
        rest_.remove_prefix(end + 1);
        return line;
    }

    static Fault unended() { return broken("a line that does not end with CR LF"); }

    std::string_view rest_;
    Settings const& settings_;
    RequestHead& head_;
    std::size_t hosts_ = 0;
    bool has_length_ = false;
    bool transfer_encoded_ = false;
};

}  // namespace

std::optional<std::string_view> RequestHead::field(std::string_view name) const {
    std::optional<std::string_view> found;
    for (auto const& field : fields) {
        if (!same_name(field.name, name)) continue;
        if (found) return {};
        found = field.value;
    }
    return found;
}

std::size_t RequestHead::count(std::string_view name) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(fields, [&](Field const& field) { return same_name(field.name, name); }));
}

bool RequestHead::lists(std::string_view name, std::string_view member, Case letters) const {
    auto const is_meant = [&](std::string_view each) {
        return letters == Case::kept ? each == member : equal_ignoring_case(each, member);
    };
    return std::ranges::any_of(
        fields, [&](Field const& field) { return same_name(field.name, name) && any_member(field.value, is_meant); });
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

std::optional<Fault> read_head(std::string_view text, Settings const& settings, RequestHead& head) {
    head.fields.clear();
    head.content_length = 0;
    return HeadReader{text, settings, head}.read();
}

Fault overlong_head(std::string_view text, Settings const& settings) {
    if (text.find('\n') == std::string_view::npos) return overlong_target(settings);
    return {FaultCode::header_too_large, "the header is longer than " + std::to_string(settings.max_header) + " bytes", {}, {}};
}

}  // namespace rois::net
