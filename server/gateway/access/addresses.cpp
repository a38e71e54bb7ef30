#include "gateway/access/addresses.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>

#include "types/text/to_number.hpp"
namespace rois {

namespace {

namespace ip = boost::asio::ip;

constexpr std::size_t ipv4_prefix = 96;  // bits of ::ffff:0:0

}  // namespace

std::optional<Address> read_address(std::string_view text) {
    boost::system::error_code error;
    auto const address = ip::make_address(std::string{text}, error);
    if (error) return {};
    return address.is_v4() ? ip::make_address_v6(ip::v4_mapped, address.to_v4()).to_bytes() : address.to_v6().to_bytes();
}

bool is_loopback(Address const& bytes) {
    ip::address_v6 const address{bytes};
    if (address.is_v4_mapped()) return ip::make_address_v4(ip::v4_mapped, address).is_loopback();
    return address.is_loopback();
}

bool Network::contains(Address const& other) const {
    auto const whole = bits / 8, rest = bits % 8;
    if (!std::equal(address.begin(), address.begin() + static_cast<std::ptrdiff_t>(whole), other.begin())) return false;
    return rest == 0 || ((address[whole] ^ other[whole]) >> (8 - rest)) == 0;
}

std::optional<Network> read_network(std::string_view text) {
    auto const slash = std::min(text.find('/'), text.size());
    auto const address = read_address(text.substr(0, slash));
    if (!address) return {};
    Network network{*address, 128};
    if (slash == text.size()) return network;
    auto const digits = text.substr(slash + 1);
    bool const ipv4 = text.substr(0, slash).find(':') == std::string_view::npos;
    auto const bits = to_number<std::size_t>(digits);
    if (!bits || *bits > (ipv4 ? 32U : 128U)) return {};
    network.bits = ipv4 ? ipv4_prefix + *bits : *bits;
    return network;
}

std::string text_of(Network const& network) {
    ip::address_v6 const address{network.address};
    bool const ipv4 = address.is_v4_mapped() && network.bits >= ipv4_prefix;
    auto text = ipv4 ? ip::make_address_v4(ip::v4_mapped, address).to_string() : address.to_string();
    if (network.bits < 128) text += "/" + std::to_string(network.bits - (ipv4 ? ipv4_prefix : 0));
    return text;
}

Limits limits_of(Address const& address, std::vector<Network> const& proxies) {
    if (std::ranges::any_of(proxies, [&](Network const& each) { return each.contains(address); })) return Limits::none;
    return is_loopback(address) ? Limits::of_connection : Limits::all;
}

}  // namespace rois
