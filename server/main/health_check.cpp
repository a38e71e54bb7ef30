#include "main/health_check.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <string>

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
    boost::asio::ip::tcp::iostream gateway;
    gateway.expires_after(longest);
    gateway.connect(reachable(host), std::to_string(port));
    gateway << "GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n" << std::flush;
    std::string status;
    std::getline(gateway, status);
    if (gateway.error() == boost::asio::error::operation_aborted) return "no answer within two seconds";
    if (!gateway) return gateway.error().message();
    return status.starts_with("HTTP/1.1 200 ") ? "" : "unexpected answer";
}

}  // namespace rois
