// IP addresses of clients, and networks of addresses.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// An IPv6 address. An IPv4 address has the form ::ffff:192.0.2.1.
using Address = std::array<unsigned char, 16>;

// "192.0.2.1" or "2001:db8::1". Returns nothing if the text is not an address.
std::optional<Address> read_address(std::string_view);

bool is_loopback(Address const&);

// The addresses whose first `bits` bits equal those of `address`.
struct Network {
    Address address{};
    std::size_t bits = 128;

    bool contains(Address const&) const;
};

// "192.0.2.1", "192.0.2.0/24" or "2001:db8::/32". Returns nothing if the text is not a network.
std::optional<Network> read_network(std::string_view);
std::string text_of(Network const&);

// The limits that apply to a connection, by its remote address.
enum class Limits : unsigned char {
    all,
    of_connection,  // loopback: no limit per address
    none            // a proxy: its connections carry requests of many clients
};
Limits limits_of(Address const&, std::vector<Network> const& proxies);

}  // namespace rois
