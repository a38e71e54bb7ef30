// Certificates for tests of TLS, made by the program openssl.
#pragma once

#include <string>

#include "kit/gateway_process.hpp"
#include "kit/profile_folder.hpp"

namespace rois::test {

class Certificates {
public:
    // Makes NAME.pem and NAME.key, for localhost and 127.0.0.1. Each certificate signs itself.
    void make(std::string const& name, std::string const& more = "-nodes") const;
    // Replaces NAME.pem by a certificate that expired a day ago.
    void expire(std::string const& name) const;
    std::string folder() const { return folder_.name(); }
    void put(std::string const& file, std::string const& text) const { folder_.put(file, text); }
    std::string certificate(std::string const& name) const { return folder_.name() + "/" + name + ".pem"; }
    std::string key(std::string const& name) const { return folder_.name() + "/" + name + ".key"; }
    // The arguments of a gateway that has this certificate.
    std::vector<std::string> of_gateway(std::string const& name, std::vector<std::string> const& more = {}) const;
    // The gateway's address for a client that trusts this certificate.
    kit::Address trusting(std::string const& name, kit::GatewayProcess const&) const;

private:
    kit::ProfileFolder folder_;
};

}  // namespace rois::test
