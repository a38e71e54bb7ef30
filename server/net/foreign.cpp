#include "net/foreign.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/address.hpp>
#include <charconv>
#include <cstdint>

#include "types/texts.hpp"

namespace rois::net {

namespace {

namespace ip = boost::asio::ip;

std::string_view without_last_dot(std::string_view name) {
    if (name.ends_with('.')) name.remove_suffix(1);
    return name;
}

// May be empty, as in "localhost:" (RFC 3986, 3.2.3).
bool is_port(std::string_view text) {
    if (text.empty()) return true;
    std::uint16_t port = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc{} && end == text.data() + text.size();
}

// "name:80", "192.0.2.1" or "[::1]:80" without its port; an IPv6 address keeps its brackets. Empty if there is no such thing.
std::string_view without_port(std::string_view authority) {
    auto const host_end = authority.starts_with('[') ? authority.find(']') : 0;
    if (host_end == std::string_view::npos) return {};
    auto const colon = std::min(authority.find(':', host_end), authority.size());
    auto const host = authority.substr(0, colon);
    bool const whole = colon == authority.size() || is_port(authority.substr(colon + 1));
    return whole && (!host.starts_with('[') || host.ends_with(']')) ? host : std::string_view{};
}

bool is_address(std::string_view host) {
    boost::system::error_code error;
    if (host.starts_with('[')) {
        ip::make_address_v6(std::string{host.substr(1, host.size() - 2)}, error);
    } else {
        ip::make_address_v4(std::string{without_last_dot(host)}, error);
    }
    return !error;
}

std::string_view without_default_port(std::string_view authority, std::string_view port) {
    return authority.ends_with(port) ? authority.substr(0, authority.size() - port.size()) : authority;
}

HttpAnswer misdirected(std::string_view authority) {
    auto answer = answer_of({FaultCode::not_allowed,
                             "this gateway is not known as " + quoted(authority) +
                                 ": expected localhost, an IP address or the name of its machine; the key hosts adds other names",
                             {},
                             {}});
    answer.status = 421;
    return answer;
}

HttpAnswer foreign_origin(std::string_view origin) {
    return answer_of({FaultCode::not_allowed,
                      "pages of the origin " + quoted(origin) +
                          " are not allowed here: expected a page of this gateway; the key allowed_origins adds other origins",
                      {},
                      {}});
}

}  // namespace

std::optional<std::string> host_name(std::string_view text) {
    auto name = lower_case(without_last_dot(text));
    auto const fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.'; };
    constexpr std::size_t longest = 253;  // RFC 1035, 2.3.4
    bool const is_name = !name.empty() && name.size() <= longest && std::ranges::all_of(name, fits) && name.front() != '.' &&
                         name.back() != '.' && name.find("..") == std::string::npos;
    if (!is_name) return {};
    return name;
}

std::optional<std::string> machine_name() {
    std::array<char, 256> buffer{};
    if (::gethostname(buffer.data(), buffer.size() - 1) != 0) return {};
    return host_name(buffer.data());
}

bool is_own_host(std::string_view authority, std::vector<std::string> const& names) {
    auto const host = without_port(authority);
    if (host.empty()) return false;
    if (equal_ignoring_case(host, "localhost") || is_address(host)) return true;
    auto const name = host_name(host);
    return name && (*name == "localhost" || std::ranges::find(names, *name) != names.end());
}

bool is_allowed_origin(std::string_view origin, std::string_view authority, std::vector<std::string> const& allowed) {
    if (std::ranges::any_of(allowed, [&](auto const& one) { return equal_ignoring_case(one, origin); })) return true;
    auto const scheme_end = std::min(origin.find("://"), origin.size());
    auto const scheme = lower_case(origin.substr(0, scheme_end));
    if (scheme != "http" && scheme != "https") return false;
    auto const port = scheme == "https" ? ":443" : ":80";
    auto const of_page = without_default_port(origin.substr(std::min(scheme_end + 3, origin.size())), port);
    return !of_page.empty() && equal_ignoring_case(of_page, without_default_port(authority, port));
}

std::optional<HttpAnswer> refusal_of_foreign(RequestHead const& head, Settings const& settings) {
    if (auto const host = head.field("Host"); host && !is_own_host(*host, settings.hosts)) return misdirected(*host);
    if (!head.target_authority.empty() && !is_own_host(head.target_authority, settings.hosts))
        return misdirected(head.target_authority);
    if (head.count("Origin") == 0) return {};
    auto const origin = head.field("Origin").value_or("");  // two of them: none that is allowed
    if (!is_allowed_origin(origin, head.authority(), settings.allowed_origins)) return foreign_origin(origin);
    return {};
}

}  // namespace rois::net
