#include "wire/credentials.hpp"

#include <openssl/ssl.h>

#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace rois::tls {

namespace {

int index_of_handshake() {
    static int const index = ::SSL_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
    return index;
}

}  // namespace

// Handshakes without a PausedHandshake do not pause.
int at_client_hello(SSL* ssl, int* /*alert*/, void* /*argument*/) {
    auto* const handshake = static_cast<PausedHandshake*>(::SSL_get_ex_data(ssl, index_of_handshake()));
    bool const goes_on = handshake == nullptr || std::exchange(handshake->may_go_on_, false);
    return goes_on ? SSL_CLIENT_HELLO_SUCCESS : SSL_CLIENT_HELLO_RETRY;
}

PausedHandshake::PausedHandshake(SSL* ssl) : ssl_{ssl} { ::SSL_set_ex_data(ssl_, index_of_handshake(), this); }

PausedHandshake::~PausedHandshake() { ::SSL_set_ex_data(ssl_, index_of_handshake(), nullptr); }

bool PausedHandshake::pauses() {
    bool const pauses = SSL_want_client_hello_cb(ssl_);
    may_go_on_ = pauses;
    return pauses;
}

namespace {

namespace ssl = boost::asio::ssl;

constexpr auto groups = "X25519:P-256:P-384";  // those for which an answer is cheap

// For TLS 1.2: with forward secrecy, and authenticated. TLS 1.3 has no others.
constexpr auto ciphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

// To open a pipe would wait until somebody writes into it.
void require_file(std::string const& key, std::string const& file) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
        throw std::runtime_error{key + ": cannot use '" + file + "': this is not a regular file"};
}

void require(boost::system::error_code const& error, std::string const& key, std::string const& file,
             std::string const& expected) {
    if (error)
        throw std::runtime_error{key + ": cannot use '" + file + "': " + error.message() + "; expected " + expected +
                                 " in PEM format"};
}

void trust(ssl::context& context, std::string const& key, std::string const& file) {
    require_file(key, file);
    boost::system::error_code error;
    context.load_verify_file(file, error);
    require(error, key, file, "certificates");
}

// A key of the configuration, and the file that it names.
using Named = std::pair<std::string, std::string>;

void identify(ssl::context& context, Named const& certificate, Named const& key) {
    for (auto const& [name, file] : {certificate, key}) require_file(name, file);
    boost::system::error_code error;
    context.use_certificate_chain_file(certificate.second, error);
    require(error, certificate.first, certificate.second, "a certificate, and those between it and its root,");
    // OpenSSL would ask for the password at the terminal.
    context.set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string{}; }, error);
    context.use_private_key_file(key.second, ssl::context::pem, error);
    bool const fits = !error && ::SSL_CTX_check_private_key(context.native_handle()) == 1;  // also if it is of another type
    if (!error && !fits) error = {static_cast<int>(::ERR_get_error()), boost::asio::error::get_ssl_category()};
    require(error, key.first, key.second, "the private key of the certificate, without a password,");
}

// No session is resumed: each connection is checked with the present files.
std::shared_ptr<ssl::context> read(Files const& files) {
    auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
    auto* const native = context->native_handle();
    context->set_options(ssl::context::default_workarounds | ssl::context::no_compression);
    ::SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_NO_TICKET);
    ::SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
    ::SSL_CTX_set_cipher_list(native, ciphers);
    ::SSL_CTX_set1_groups_list(native, groups);
    ::SSL_CTX_set_client_hello_cb(native, at_client_hello, nullptr);
    ::SSL_CTX_set_num_tickets(native, 0);
    ::SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
    ::SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS);
    identify(*context, {"tls_certificate", files.certificate}, {"tls_key", files.key});
    boost::system::error_code error;
    if (files.client_ca.empty()) return context;
    trust(*context, "tls_client_ca", files.client_ca);
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

std::chrono::system_clock::time_point expiry_of(ssl::context& context) {
    std::tm time{};
    ::ASN1_TIME_to_tm(::X509_get0_notAfter(::SSL_CTX_get0_certificate(context.native_handle())), &time);
    return std::chrono::system_clock::from_time_t(::timegm(&time));
}

void require_certificates(std::string const& key, std::string const& file) {
    ssl::context context{ssl::context::tls_client};
    trust(context, key, file);
}

void require_identity(std::string const& key, std::string const& file) {
    ssl::context context{ssl::context::tls_client};
    identify(context, {key, file}, {key, file});
}

}  // namespace rois::tls
