// A proxy that terminates TLS before a gateway.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace rois::test {

// Has its own key and a self-signed certificate for "localhost" and 127.0.0.1.
class TlsProxy {
public:
    enum class Version : std::uint8_t { current, tls_1_1 };
    explicit TlsProxy(std::uint16_t gateway, Version = Version::current);
    ~TlsProxy();

    std::uint16_t port() const;
    std::string certificate() const;  // a PEM file, removed with the proxy

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace rois::test
