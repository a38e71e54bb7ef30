#include "gateway/access/host_names.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/address.hpp>
#include <cstdint>

#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois {

namespace {

namespace ip = boost::asio::ip;

std::string_view without_last_dot(std::string_view name) {
    if (name.ends_with('.')) name.remove_suffix(1);
    return name;
}

// A port may be empty, as in "localhost:" (RFC 3986, 3.2.3).
bool is_port(std::string_view text) { return text.empty() || to_number<std::uint16_t>(text); }

// Removes the port from "name:80", "192.0.2.1:80" or "[::1]:80"; an IPv6 address keeps its brackets. Returns an empty text if the
// authority has another form.
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

std::string_view harmless_host(std::string_view authority) {
    bool const harmless = std::ranges::all_of(authority, [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               std::string_view{".:-_[]"}.find(c) != std::string_view::npos;
    });
    return harmless && !authority.empty() ? authority : "localhost";
}

bool is_allowed_origin(std::string_view origin, std::string_view authority, std::vector<std::string> const& allowed,
                       Scheme served) {
    if (std::ranges::any_of(allowed, [&](auto const& one) { return equal_ignoring_case(one, origin); })) return true;
    auto const scheme_end = std::min(origin.find("://"), origin.size());
    auto const scheme = lower_case(origin.substr(0, scheme_end));
    if (scheme != "https" && (scheme != "http" || served == Scheme::https)) return false;
    auto const port = scheme == "https" ? ":443" : ":80";
    auto const of_page = without_default_port(origin.substr(std::min(scheme_end + 3, origin.size())), port);
    return !of_page.empty() && equal_ignoring_case(of_page, without_default_port(authority, port));
}

std::optional<Fault> refusal_of_host(std::string_view authority, std::vector<std::string> const& names) {
    if (is_own_host(authority, names)) return {};
    return Fault{FaultCode::not_allowed,
                 "this gateway is not known as " + quoted(authority) +
                     ": expected localhost, an IP address or the name of its machine; the key hosts adds other names"};
}

std::optional<Fault> refusal_of_origin(std::string_view origin, std::string_view authority,
                                       std::vector<std::string> const& allowed, Scheme served) {
    if (is_allowed_origin(origin, authority, allowed, served)) return {};
    return Fault{FaultCode::not_allowed,
                 "pages of the origin " + quoted(origin) +
                     " are not allowed here: expected a page of this gateway; the key allowed_origins adds other origins"};
}

}  // namespace rois
