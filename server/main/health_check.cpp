#include "main/health_check.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <string>

#include "types/text/address.hpp"

namespace rois {

namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using Error = boost::system::error_code;

constexpr auto longest = std::chrono::seconds{2};

auto into(Error& error) { return asio::redirect_error(asio::use_awaitable, error); }

// Returns an address to connect to. A gateway that listens on all addresses is asked on the loopback address.
std::string reachable(std::string const& host) {
    if (host == "0.0.0.0") return "127.0.0.1";
    if (host == "::") return "::1";
    return host;
}

template <class Stream>
asio::awaitable<std::string> status_of(Stream& stream, std::string const& place) {
    Error error;
    http::request<http::empty_body> request{http::verb::get, "/readyz", 11};
    request.set(http::field::host, "localhost");
    co_await http::async_write(stream, request, into(error));
    boost::beast::flat_buffer received;
    http::response_parser<http::empty_body> answer;
    answer.skip(true);
    if (!error) co_await http::async_read_header(stream, received, answer, into(error));
    if (error) co_return "no answer from " + place + ": " + error.message();
    auto const status = answer.get().result_int();
    co_return status == 200 ? "" : "expected HTTP status 200 from " + place + ", not " + std::to_string(status);
}

asio::awaitable<std::string> ask(std::string host, std::uint16_t port, tls::Files files) {
    auto const place = host_and_port(host, port);
    auto const executor = co_await asio::this_coro::executor;
    Error error;
    asio::ip::tcp::socket socket{executor};
    auto const found = co_await asio::ip::tcp::resolver{executor}.async_resolve(host, std::to_string(port), into(error));
    if (!error) co_await asio::async_connect(socket, found, into(error));
    if (error) co_return "no connection to " + place + ": " + error.message();
    if (files.certificate.empty()) {
        auto const trouble = co_await status_of(socket, place);
        co_return trouble;
    }
    asio::ssl::context context{asio::ssl::context::tls_client};
    if (files.client_must) {
        context.use_certificate_chain_file(files.certificate);
        context.use_private_key_file(files.key, asio::ssl::context::pem);
    }
    asio::ssl::stream<asio::ip::tcp::socket&> stream{socket, context};
    co_await stream.async_handshake(asio::ssl::stream_base::client, into(error));
    if (error) co_return "no TLS with " + place + ": " + error.message();
    auto const trouble = co_await status_of(stream, place);
    co_return trouble;
}

}  // namespace

std::string check_health(std::string const& host, std::uint16_t port, tls::Files const& files) {
    auto const address = reachable(host);
    auto trouble = "no answer from " + host_and_port(address, port) + " within two seconds";
    asio::io_context io{1};
    asio::co_spawn(io, ask(address, port, files), [&](std::exception_ptr const& broken, std::string const& found) {
        if (broken) std::rethrow_exception(broken);
        trouble = found;
    });
    io.run_for(longest);
    return trouble;
}

}  // namespace rois
