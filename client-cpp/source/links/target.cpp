#include "links/target.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cstdlib>
#include <stdexcept>

#include "types/text/texts.hpp"

namespace rois {

std::string default_url() {
    auto const* const set = std::getenv("ROIS_URL");
    return set != nullptr && *set != '\0' ? set : "http://127.0.0.1:8080";
}

namespace client {

namespace {

[[noreturn]] void complain(std::string_view url) {
    throw std::invalid_argument{
        quoted(url) + " is not a URL of a gateway: expected http://HOST:PORT (or https, ws, wss), with a port from 1 to 65535"};
}

bool is_port(std::string_view text) {
    auto const number = to_int(text);
    return number && *number > 0 && *number < 65'536 && text.find_first_not_of("0123456789") == text.npos;
}

bool is_this_machine(std::string const& host) {
    boost::system::error_code is_a_name;
    auto const address = boost::asio::ip::make_address(host, is_a_name);
    return is_a_name ? equal_ignoring_case(host, "localhost") : address.is_loopback();
}

}  // namespace

bool is_in_the_clear(Target const& target) { return target.security == Security::plain && !is_this_machine(target.host); }

Target read_url(std::string_view url, std::string_view token) {
    auto const mark = url.find("://");
    auto const scheme = lower_case(url.substr(0, mark));
    bool const tls = scheme == "https" || scheme == "wss";
    if (mark == url.npos || (!tls && scheme != "http" && scheme != "ws")) complain(url);
    auto const rest = url.substr(mark + 3);
    auto const authority = rest.substr(0, rest.find_first_of("/?#"));
    auto path = rest.substr(authority.size());
    if (authority.empty() || authority.find_first_of("@ \t\r\n") != authority.npos ||
        path.find_first_of("?# \t\r\n") != path.npos)
        complain(url);
    while (path.ends_with('/')) path.remove_suffix(1);

    Target target{.host = {},
                  .port = tls ? "443" : "80",
                  .authority = std::string{authority},
                  .path = std::string{path} + "/rois",
                  .security = tls ? Security::tls : Security::plain};
    auto const bracket = authority.find(']');
    bool const literal = authority.starts_with('[');
    if (literal != (bracket != authority.npos)) complain(url);
    auto const colon = authority.find(':', literal ? bracket : 0);
    target.host = authority.substr(literal ? 1 : 0, literal ? bracket - 1 : colon);
    if (colon != authority.npos) target.port = authority.substr(colon + 1);
    if (target.host.empty() || !is_port(target.port)) complain(url);
    if (!std::ranges::all_of(token, [](char c) { return c > ' ' && c <= '~'; }))
        throw std::invalid_argument{"a token has only letters, digits and signs: no space, and no end of a line"};
    if (!token.empty() && is_in_the_clear(target))
        throw std::invalid_argument{"a token is not sent to " + quoted(target.host) +
                                    " without TLS, because others could read it: expected https:// or wss://"};
    return target;
}

}  // namespace client

}  // namespace rois
