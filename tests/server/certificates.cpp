#include "server/certificates.hpp"

#include <stdexcept>

namespace rois::test {

void Certificates::make(std::string const& name, std::string const& more) const {
    auto const made = kit::run_shell("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -days 2 -subj /CN=" + name +
                                     " -addext subjectAltName=DNS:localhost,IP:127.0.0.1 -keyout " + key(name) + " -out " +
                                     certificate(name) + " " + more);
    if (made.exit_code != 0) throw std::runtime_error{"openssl: " + made.error};
}

void Certificates::expire(std::string const& name) const {
    auto const made = kit::run_shell("openssl req -new -subj /CN=" + name + " -key " + key(name) +
                                     " | openssl x509 -req -days -1 -signkey " + key(name) + " -out " + certificate(name));
    if (made.exit_code != 0) throw std::runtime_error{"openssl: " + made.error};
}

std::vector<std::string> Certificates::of_gateway(std::string const& name, std::vector<std::string> const& more) const {
    std::vector<std::string> all{"--tls-certificate", certificate(name), "--tls-key", key(name)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

kit::Address Certificates::trusting(std::string const& name, kit::GatewayProcess const& gateway) const {
    auto address = gateway.address();
    address.tls = true;
    address.ca_file = certificate(name);
    return address;
}

}  // namespace rois::test
