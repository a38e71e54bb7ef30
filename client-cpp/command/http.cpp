#include "command/http.hpp"

#include "command/asio.hpp"

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/beast/ssl.hpp>
#include <optional>
#include <regex>

#include "command/exit.hpp"

namespace rois::command {

namespace {

struct Address {
    bool tls = false;
    std::string host;
    std::string port;
    std::string path;
};

Address address_of(std::string const& url) {
    static std::regex const form{
        R"re((http|https|ws|wss)://(\[[0-9A-Fa-f:.]+\]|[^/:?#\[\]@\s]+)(?::([0-9]{1,5}))?(/[^?#\s]*)?)re"};
    std::smatch match;
    if (!std::regex_match(url, match, form)) throw Trouble{Exit::usage, "this is no URL of an engine: " + url};
    Address address;
    address.tls = match[1] == "https" || match[1] == "wss";
    address.host = match[2];
    address.port = match[3].matched ? match[3].str() : address.tls ? "443" : "80";
    address.path = match[4];
    while (address.path.ends_with('/')) address.path.pop_back();
    return address;
}

std::string without_brackets(std::string const& host) { return host.starts_with('[') ? host.substr(1, host.size() - 2) : host; }

using Get = http::request<http::empty_body>;

Get request_of(Address const& address, HttpServer const& server, std::string const& target) {
    Get request{http::verb::get, address.path + target, 11};
    request.set(http::field::host, address.host + ":" + address.port);
    request.set(http::field::connection, "close");
    if (!server.token.empty()) request.set(http::field::authorization, "Bearer " + server.token);
    return request;
}

struct Outcome {
    std::optional<HttpAnswer> answer;
    std::string trouble = "no answer in time";
};

template <class Stream>
asio::awaitable<void> exchange(Stream& stream, Get& request, Outcome& outcome, Failure& failure) {
    co_await http::async_write(stream, request, into(failure));
    if (failure) co_return;
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(64u << 20);
    co_await http::async_read(stream, buffer, parser, into(failure));
    if (!failure) outcome.answer = HttpAnswer{parser.get().result_int(), parser.get().body()};
}

asio::awaitable<void> exchange_with_tls(beast::tcp_stream stream, Address const& address, HttpServer const& server, Get& request,
                                        Outcome& outcome, Failure& failure) {
    asio::ssl::context context{asio::ssl::context::tls_client};
    context.set_default_verify_paths();
    if (!server.ca_file.empty()) context.load_verify_file(server.ca_file, failure);
    if (failure) co_return;
    beast::ssl_stream<beast::tcp_stream> secured{std::move(stream), context};
    auto const host = without_brackets(address.host);
    SSL_set_tlsext_host_name(secured.native_handle(), host.c_str());
    secured.set_verify_mode(asio::ssl::verify_peer);
    secured.set_verify_callback(asio::ssl::host_name_verification{host});
    co_await secured.async_handshake(asio::ssl::stream_base::client, into(failure));
    if (!failure) co_await exchange(secured, request, outcome, failure);
}

asio::awaitable<void> run(Address const& address, HttpServer const& server, Get& request, Outcome& outcome) {
    auto const executor = co_await asio::this_coro::executor;
    Failure failure;
    asio::ip::tcp::resolver resolver{executor};
    auto const found = co_await resolver.async_resolve(without_brackets(address.host), address.port, into(failure));
    beast::tcp_stream stream{executor};
    if (!failure) co_await stream.async_connect(found, into(failure));
    if (!failure && address.tls) {
        co_await exchange_with_tls(std::move(stream), address, server, request, outcome, failure);
    } else if (!failure) {
        co_await exchange(stream, request, outcome, failure);
    }
    if (failure) outcome.trouble = failure.message();
}

}  // namespace

HttpAnswer http_get(HttpServer const& server, std::string const& target, std::chrono::milliseconds deadline) {
    auto const address = address_of(server.url);
    auto request = request_of(address, server, target);
    Outcome outcome;
    auto io = std::make_unique<asio::io_context>(1);
    asio::co_spawn(*io, run(address, server, request, outcome), asio::detached);
    io->run_for(deadline);
    // The end of one that looks a name up waits for it. Nothing runs on it any more, and the program ends soon.
    [[maybe_unused]] static asio::io_context* left_alone = nullptr;
    if (!io->stopped()) left_alone = io.release();
    if (!outcome.answer) throw Trouble{Exit::no_answer, server.url + ": " + outcome.trouble};
    return std::move(*outcome.answer);
}

}  // namespace rois::command
