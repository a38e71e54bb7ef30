#include "main/health_check.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <string>

#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr auto longest = std::chrono::seconds{2};

// Returns an address to connect to. A gateway that listens on all addresses is asked on the loopback address.
std::string reachable(std::string const& host) {
    if (host == "0.0.0.0") return "127.0.0.1";
    if (host == "::") return "::1";
    return host;
}

}  // namespace

std::string check_health(std::string const& host, std::uint16_t port) {
    auto const address = reachable(host);
    auto const place = (address.find(':') == address.npos ? address : "[" + address + "]") + ":" + std::to_string(port);
    boost::asio::ip::tcp::iostream gateway;
    auto const is_late = [&] { return gateway.error() == boost::asio::error::operation_aborted; };
    gateway.expires_after(longest);
    gateway.connect(address, std::to_string(port));
    if (!gateway && !is_late()) return "no connection to " + place + ": " + gateway.error().message();
    gateway << "GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n" << std::flush;
    std::string status;
    std::getline(gateway, status);
    if (is_late()) return "no answer from " + place + " within two seconds";
    if (!gateway) return "no answer from " + place + ": " + gateway.error().message();
    if (status.starts_with("HTTP/1.1 200 ")) return "";
    if (status.ends_with('\r')) status.pop_back();
    return "expected HTTP status 200 from " + place + ", not " + quoted(status, 100);
}

}  // namespace rois
