// A proxy that terminates TLS before a gateway.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace rois::test {

// Has its own key and a self-signed certificate for "localhost" and 127.0.0.1.
class TlsProxy {
public:
    // `tls_1_1`: knows no other version. `asks`: clients must show its own certificate.
    enum class Kind : std::uint8_t { usual, tls_1_1, asks };
    explicit TlsProxy(std::uint16_t gateway, Kind = Kind::usual);
    ~TlsProxy();

    std::uint16_t port() const;
    // PEM files, removed with the proxy.
    std::string certificate() const;
    std::string identity() const;  // the certificate and its key

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace rois::test
