// Ends TLS before a gateway, as a web server would.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace rois::test {

// A key of its own, and a certificate for "localhost" and 127.0.0.1 that it has signed itself.
class TlsProxy {
public:
    explicit TlsProxy(std::uint16_t gateway);
    ~TlsProxy();

    std::uint16_t port() const;
    std::string certificate() const;  // a PEM file, which lives as long as the proxy

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace rois::test
