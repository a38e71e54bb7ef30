#include "types/text/address.hpp"

#include <charconv>

namespace rois {

std::optional<HostAndPort> read_host_and_port(std::string_view text) {
    auto const colon = text.rfind(':');
    if (colon == text.npos || colon == 0) return {};
    auto host = text.substr(0, colon);
    if (host == "*") return {};
    bool const bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
    if (bracketed) host = host.substr(1, host.size() - 2);
    if (!bracketed && host.find(':') != host.npos) return {};
    HostAndPort read{.host = std::string{host}};
    auto const [end, error] = std::from_chars(text.data() + colon + 1, text.data() + text.size(), read.port);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return read;
}

}  // namespace rois
