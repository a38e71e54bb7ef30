#include "wire/credentials.hpp"

#include <openssl/ssl.h>

#include <stdexcept>
#include <utility>

namespace rois::tls {

namespace {

namespace ssl = boost::asio::ssl;

// For TLS 1.2: with forward secrecy, and authenticated. TLS 1.3 has no others.
constexpr auto ciphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

void require(boost::system::error_code const& error, std::string const& key, std::string const& file) {
    if (error) throw std::runtime_error{key + ": cannot use '" + file + "': " + error.message()};
}

// No session is resumed: each connection is checked with the present files.
std::shared_ptr<ssl::context> read(Files const& files) {
    auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
    auto* const native = context->native_handle();
    context->set_options(ssl::context::default_workarounds | ssl::context::no_compression);
    ::SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_NO_TICKET);
    ::SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
    ::SSL_CTX_set_cipher_list(native, ciphers);
    ::SSL_CTX_set_num_tickets(native, 0);
    ::SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
    ::SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS);
    boost::system::error_code error;
    context->use_certificate_chain_file(files.certificate, error);
    require(error, "tls_certificate", files.certificate);
    // OpenSSL would ask for the password at the terminal.
    context->set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string{}; }, error);
    context->use_private_key_file(files.key, ssl::context::pem, error);
    require(error, "tls_key", files.key);
    if (files.client_ca.empty()) return context;
    context->load_verify_file(files.client_ca, error);
    require(error, "tls_client_ca", files.client_ca);
    auto const mode = files.client_must ? ssl::verify_peer | ssl::verify_fail_if_no_peer_cert : ssl::verify_peer;
    context->set_verify_mode(mode, error);
    return context;
}

}  // namespace

Credentials::Credentials(Files files) : files_{std::move(files)}, context_{read(files_)} {}

std::shared_ptr<ssl::context> Credentials::read_again() const { return read(files_); }

void Credentials::use(std::shared_ptr<ssl::context> fresh) {
    std::lock_guard const lock{mutex_};
    context_ = std::move(fresh);
}

}  // namespace rois::tls
