// The certificate and the key by which clients know this gateway (TLS), on all its ports.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "wire/tls_files.hpp"

namespace rois::tls {

// The answer to a request without TLS.
inline constexpr std::string_view expects_tls = "this port expects TLS: use https:// or wss://";

// Thread-safe.
class Credentials {
public:
    // Reads the files. Throws std::runtime_error that names the file and the problem.
    explicit Credentials(Files);

    // Reads the files again. Throws as the constructor. `use`: the next connections get what was read.
    std::shared_ptr<boost::asio::ssl::context> read_again() const;
    void use(std::shared_ptr<boost::asio::ssl::context>);

    std::shared_ptr<boost::asio::ssl::context> context() const {
        std::lock_guard const lock{mutex_};
        return context_;
    }

private:
    Files const files_;
    mutable std::mutex mutex_;
    std::shared_ptr<boost::asio::ssl::context> context_;
};

// Lets a handshake end with an error at each ClientHello, before the part that needs much time: then `pauses` returns true once,
// and the handshake has to be begun again. Must live until the handshake is over.
class PausedHandshake {
public:
    explicit PausedHandshake(SSL*);
    ~PausedHandshake();
    PausedHandshake(PausedHandshake const&) = delete;
    PausedHandshake& operator=(PausedHandshake const&) = delete;

    bool pauses();

private:
    friend int at_client_hello(SSL*, int*, void*);

    SSL* const ssl_;
    bool may_go_on_ = false;
};

// When the certificate that the context shows to clients expires.
std::chrono::system_clock::time_point expiry_of(boost::asio::ssl::context&);

// Throws std::runtime_error that names the key, the file and the problem, unless the file holds certificates.
void require_certificates(std::string const& key, std::string const& file);
// The same, unless the file holds a certificate and its key.
void require_identity(std::string const& key, std::string const& file);

}  // namespace rois::tls
