#include "types/text/address.hpp"

#include "types/text/to_number.hpp"

namespace rois {

std::optional<HostAndPort> read_host_and_port(std::string_view text) {
    auto const colon = text.rfind(':');
    if (colon == text.npos || colon == 0) return {};
    auto host = text.substr(0, colon);
    if (host == "*") return {};
    bool const bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
    if (bracketed) host = host.substr(1, host.size() - 2);
    if (!bracketed && host.find(':') != host.npos) return {};
    auto const port = to_number<std::uint16_t>(text.substr(colon + 1));
    if (!port) return {};
    return HostAndPort{std::string{host}, *port};
}

std::string host_and_port(std::string const& host, std::uint16_t port) {
    bool const ipv6 = host.find(':') != std::string::npos;
    return (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace rois
