#include "client_cpp/tls_proxy.hpp"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include <array>
#include <boost/asio.hpp>
#include <boost/asio/ssl.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

namespace rois::test {

namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using Tls = asio::ssl::stream<Tcp::socket>;

std::string text_of(BIO* memory) {
    char* data = nullptr;
    auto const size = BIO_get_mem_data(memory, &data);
    std::string text{data, static_cast<std::size_t>(size)};
    BIO_free(memory);
    return text;
}

struct Identity {
    std::string key;
    std::string certificate;
};

Identity fresh_identity() {
    auto* const key = EVP_EC_gen("P-256");
    auto* const certificate = X509_new();
    X509_set_version(certificate, X509_VERSION_3);
    ASN1_INTEGER_set(X509_get_serialNumber(certificate), 1);
    X509_gmtime_adj(X509_getm_notBefore(certificate), -60);
    X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
    X509_set_pubkey(certificate, key);
    auto* const name = X509_get_subject_name(certificate);
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<unsigned char const*>("localhost"), -1, -1, 0);
    X509_set_issuer_name(certificate, name);
    auto* const names = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "DNS:localhost,IP:127.0.0.1");
    X509_add_ext(certificate, names, -1);
    X509_EXTENSION_free(names);
    X509_sign(certificate, key, EVP_sha256());
    auto* const key_text = BIO_new(BIO_s_mem());
    PEM_write_bio_PrivateKey(key_text, key, nullptr, nullptr, 0, nullptr, nullptr);
    auto* const certificate_text = BIO_new(BIO_s_mem());
    PEM_write_bio_X509(certificate_text, certificate);
    X509_free(certificate);
    EVP_PKEY_free(key);
    return {text_of(key_text), text_of(certificate_text)};
}

template <class From, class To>
asio::awaitable<void> pump(std::shared_ptr<From> from, std::shared_ptr<To> to) {
    std::array<char, 16 * 1024> bytes;
    boost::system::error_code error;
    auto const token = [&] { return asio::redirect_error(asio::use_awaitable, error); };
    while (!error) {
        auto const size = co_await from->async_read_some(asio::buffer(bytes), token());
        if (!error) co_await asio::async_write(*to, asio::buffer(bytes, size), token());
    }
    from->lowest_layer().close(error);
    to->lowest_layer().close(error);
}

}  // namespace

class TlsProxy::Inside {
public:
    Inside(std::uint16_t gateway, Kind kind)
        : gateway_{asio::ip::address_v4::loopback(), gateway},
          file_{std::filesystem::temp_directory_path() / ("rois-" + std::to_string(getpid()) + "-certificate.pem")} {
        auto const identity = fresh_identity();
        std::ofstream{file_} << identity.certificate;
        std::ofstream{identity_file()} << identity.certificate << identity.key;
        context_.use_certificate_chain(asio::buffer(identity.certificate));
        context_.use_private_key(asio::buffer(identity.key), asio::ssl::context::pem);
        if (kind == Kind::asks) {
            context_.set_verify_mode(asio::ssl::verify_peer | asio::ssl::verify_fail_if_no_peer_cert);
            context_.add_certificate_authority(asio::buffer(identity.certificate));
        }
        if (kind == Kind::tls_1_1) {
            SSL_CTX_set_max_proto_version(context_.native_handle(), TLS1_1_VERSION);
            SSL_CTX_set_min_proto_version(context_.native_handle(), TLS1_1_VERSION);
            SSL_CTX_set_security_level(context_.native_handle(), 0);
        }
        asio::co_spawn(io_, accept(), asio::detached);
        thread_ = std::thread{[this] { io_.run(); }};
    }
    ~Inside() {
        io_.stop();
        thread_.join();
        std::filesystem::remove(file_);
        std::filesystem::remove(identity_file());
    }

    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
    std::filesystem::path const& file() const { return file_; }
    std::string identity_file() const { return file_.string() + ".identity"; }

private:
    asio::awaitable<void> accept() {
        for (;;) {
            auto socket = co_await acceptor_.async_accept(asio::use_awaitable);
            auto const client = std::make_shared<Tls>(std::move(socket), context_);
            asio::co_spawn(io_, serve(client), asio::detached);
        }
    }

    asio::awaitable<void> serve(std::shared_ptr<Tls> client) {
        boost::system::error_code error;
        auto const token = [&] { return asio::redirect_error(asio::use_awaitable, error); };
        co_await client->async_handshake(asio::ssl::stream_base::server, token());
        auto const gateway = std::make_shared<Tcp::socket>(io_);
        if (!error) co_await gateway->async_connect(gateway_, token());
        if (error) co_return;
        asio::co_spawn(io_, pump(client, gateway), asio::detached);
        asio::co_spawn(io_, pump(gateway, client), asio::detached);
    }

    Tcp::endpoint gateway_;
    std::filesystem::path file_;
    asio::io_context io_;
    asio::ssl::context context_{asio::ssl::context::tls_server};
    Tcp::acceptor acceptor_{io_, Tcp::endpoint{asio::ip::address_v4::loopback(), 0}};
    std::thread thread_;
};

TlsProxy::TlsProxy(std::uint16_t gateway, Kind kind) : inside_{std::make_unique<Inside>(gateway, kind)} {}

TlsProxy::~TlsProxy() = default;

std::uint16_t TlsProxy::port() const { return inside_->port(); }

std::string TlsProxy::certificate() const { return inside_->file(); }

std::string TlsProxy::identity() const { return inside_->identity_file(); }

}  // namespace rois::test
