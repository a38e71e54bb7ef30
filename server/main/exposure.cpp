#include "main/exposure.hpp"

#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <memory>

#include "gateway/access/addresses.hpp"
#include "remote/sub_engine.hpp"
#include "types/text/address.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// nullopt: a name that cannot be resolved.
std::optional<bool> is_only_here(std::string const& host) {
    if (auto const address = read_address(host)) return is_loopback(*address);
    addrinfo const hints{.ai_flags = 0,
                         .ai_family = AF_UNSPEC,
                         .ai_socktype = SOCK_STREAM,
                         .ai_protocol = 0,
                         .ai_addrlen = 0,
                         .ai_addr = nullptr,
                         .ai_canonname = nullptr,
                         .ai_next = nullptr};
    addrinfo* found = nullptr;
    if (::getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0) return {};
    std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> const all{found, &::freeaddrinfo};
    for (auto const* each = all.get(); each != nullptr; each = each->ai_next) {
        std::array<char, NI_MAXHOST> text{};
        if (::getnameinfo(each->ai_addr, each->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0)
            return false;
        auto const address = read_address(text.data());
        if (!address || !is_loopback(*address)) return false;
    }
    return true;
}

}  // namespace

std::vector<std::string> check_exposure(GatewaySettings const& settings) {
    auto const where = host_and_port(settings.net.host, settings.net.port);
    bool const needs_token = !settings.tokens.empty(), is_reachable = is_only_here(settings.net.host) == false;
    std::vector<std::string> warnings;
    if (is_reachable && needs_token && settings.tls.certificate.empty())
        warnings.push_back("clients send their tokens to " + where + " without TLS: others on the network can read them");
    if (is_reachable && !needs_token && settings.allow_anyone)
        warnings.push_back("everyone who reaches " + where + " may command the robot (allow_anyone)");
    bool const joins_in_the_clear = !settings.join.empty() && remote::is_in_the_clear(settings.join);
    if (joins_in_the_clear && !settings.join_token_file.empty())
        throw BadSettings{"join_token_file: others could read the token on its way to " + quoted(settings.join) +
                          ": expected a URL with https:// or wss:// in join"};
    if (joins_in_the_clear)
        warnings.push_back("any program that answers at " + settings.join +
                           " may command this robot: with wss:// it must have a certificate");
    if (needs_token || settings.allow_anyone) return warnings;
    auto const check = [](std::string const& key, std::string const& host, std::uint16_t port) {
        auto const only_here = host.empty() ? true : is_only_here(host);
        if (!only_here)
            throw BadSettings{key + ": " + quoted(host) + " cannot be resolved: expected an address, or a name that has one"};
        if (*only_here) return;
        throw BadSettings{
            key + ": other machines can reach " + host_and_port(host, port) +
            ", and no client needs a token: make one with 'rois-gateway token add NAME --role operator --tokens FILE' and "
            "set tokens = FILE, or allow everyone with --allow-anyone"};
    };
    check("listen", settings.net.host, settings.net.port);
    check("media", settings.media.host, settings.media.port);
    return warnings;
}

}  // namespace rois
