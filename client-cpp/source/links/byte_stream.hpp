// Connects a TCP or TLS stream. Includes much of Asio: only for the sources of links.
#pragma once

#include "links/asio.hpp"
// Asio first.
#include <boost/asio/connect.hpp>
#include <boost/asio/ssl.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "links/target.hpp"
#include "rois/settings.hpp"
#include "types/text/texts.hpp"

namespace rois::client {

using TlsSocket = asio::ssl::stream<Socket>;

template <class Stream>
inline constexpr bool is_tls = std::is_same_v<Stream, TlsSocket>;

// Makes a TCP or TLS stream, or a `Layered` stream on top of it. `context` is null without TLS.
template <class Stream, class Layered>
Layered make_stream(Executor const& executor, asio::ssl::context* context) {
    if constexpr (is_tls<Stream>) {
        return Layered{executor, *context};
    } else {
        return Layered{executor};
    }
}

// Calls `use` with a file, unless its name is empty. Throws std::runtime_error, naming the file, if it cannot be used.
void with_file(std::string const& what, std::string const& file, auto const& use) {
    if (file.empty()) return;
    std::error_code ignored;
    bool const is_pipe = std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
    error_code error = is_pipe ? asio::error::invalid_argument : error_code{};
    if (!is_pipe) use(error);
    if (error)
        throw std::runtime_error{what + " " + rois::quoted(file) + " cannot be read: " + error.message() +
                                 "; it must be a readable file in PEM format"};
}

// Returns a TLS context that trusts the system's certificates and those of the settings' file, and has the client's own one.
// Throws std::runtime_error, naming the file, if one cannot be read.
inline std::unique_ptr<asio::ssl::context> trust(Settings const& settings) {
    auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_client);
    SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
    context->set_default_verify_paths();
    with_file("the file of trusted certificates", settings.ca_file,
              [&](error_code& error) { context->load_verify_file(settings.ca_file, error); });
    with_file("the file of the certificate and its key", settings.certificate_file, [&](error_code& error) {
        context->set_password_callback([](std::size_t, asio::ssl::context::password_purpose) { return std::string{}; });
        context->use_certificate_chain_file(settings.certificate_file, error);
        if (!error) context->use_private_key_file(settings.certificate_file, asio::ssl::context::pem, error);
    });
    context->set_verify_mode(asio::ssl::verify_peer);
    return context;
}

// Returns advice about a failed TLS handshake, or nothing.
inline std::string hint_for(error_code const& error) {
    bool const is_plain = error.category() == asio::error::get_ssl_category() &&
                          ERR_GET_REASON(static_cast<unsigned long>(error.value())) == SSL_R_WRONG_VERSION_NUMBER;
    return is_plain ? "; this port speaks plain HTTP: use http: or ws: instead of https: or wss:" : "";
}

using Resolver = asio::ip::basic_resolver<asio::ip::tcp, Executor>;

// Resolves the host, connects and, with TLS, verifies its certificate. Returns an error message, empty on success. `lowest` is
// the socket of `stream`.
template <class Stream>
asio::awaitable<std::string, Executor> connect(Stream& stream, Socket& lowest, Resolver& resolver, Target const& target) {
    error_code error;
    error_code no_address;
    auto const address = asio::ip::make_address(target.host, no_address);
    Resolver::results_type found;
    if (no_address) {
        found = co_await resolver.async_resolve(target.host, target.port, into(error));
        if (error) co_return "the name " + target.host + " cannot be resolved: " + error.message();
    } else {
        auto const port = static_cast<std::uint16_t>(std::stoul(target.port));
        found = Resolver::results_type::create({address, port}, target.host, target.port);
    }
    co_await asio::async_connect(lowest, found, into(error));
    if (error) co_return "no connection to " + target.authority + ": " + error.message();
    lowest.set_option(asio::ip::tcp::no_delay{true}, error);
    if constexpr (is_tls<Stream>) {
        stream.set_verify_callback(asio::ssl::host_name_verification{target.host}, error);
        if (no_address) SSL_set_tlsext_host_name(stream.native_handle(), target.host.c_str());
        co_await stream.async_handshake(asio::ssl::stream_base::client, into(error));
        if (error) co_return "no TLS with " + target.authority + ": " + error.message() + hint_for(error);
    }
    co_return std::string{};
}

}  // namespace rois::client
