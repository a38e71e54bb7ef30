// The addresses of those at the other end of connections, and the networks that they are in.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// An IPv6 address; one of IPv4 in its form ::ffff:192.0.2.1.
using Address = std::array<unsigned char, 16>;

// "192.0.2.1" or "2001:db8::1". Nothing if it is no address.
std::optional<Address> read_address(std::string_view);

bool is_loopback(Address const&);

// The addresses whose first bits are these.
struct Network {
    Address address{};
    std::size_t bits = 128;

    bool contains(Address const&) const;
};

// "192.0.2.1", "192.0.2.0/24" or "2001:db8::/32". Nothing if it is none.
std::optional<Network> read_network(std::string_view);
std::string text_of(Network const&);

// Which limits hold for a connection, by its remote address.
enum class Limits : unsigned char {
    all,
    of_connection,  // the loopback: its connections are limited, the address is not
    none            // a proxy, whose connections carry the requests of many clients
};
Limits limits_of(Address const&, std::vector<Network> const& proxies);

}  // namespace rois
