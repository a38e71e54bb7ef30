#include "command/http.hpp"

#include "command/asio.hpp"

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/beast/ssl.hpp>
#include <exception>
#include <optional>
#include <regex>

#include "command/output/terminal.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

struct Address {
    bool tls = false;
    std::string host;
    std::string port;
    std::string path;

    bool operator==(Address const&) const = default;
};

Address address_of(std::string const& url) {
    static std::regex const form{R"re((https?|wss?)://(\[[0-9A-Fa-f:.]+\]|[^/:?#\[\]@\s]+)(?::([0-9]{1,5}))?(/[^?#\s]*)?)re",
                                 std::regex::icase};
    std::smatch match;
    bool const is_url = std::regex_match(url, match, form);
    auto const port = is_url && match[3].matched ? to_int(match[3].str()) : 1;
    if (!is_url || port < 1 || port > 65'535)
        throw Trouble{Exit::usage, rois::quoted(url) +
                                       " is not a URL of a gateway: expected http://HOST:PORT (or https, ws, wss), "
                                       "with a port from 1 to 65535"};
    Address address;
    auto const scheme = lower_case(match[1].str());
    address.tls = scheme == "https" || scheme == "wss";
    address.host = match[2];
    address.port = match[3].matched ? match[3].str() : address.tls ? "443" : "80";
    address.path = match[4];
    while (address.path.ends_with('/')) address.path.pop_back();
    return address;
}

std::string without_brackets(std::string const& host) { return host.starts_with('[') ? host.substr(1, host.size() - 2) : host; }

using Bare = http::request<http::empty_body>;

Bare request_of(http::verb verb, Address const& address, HttpServer const& server, std::string const& target,
                std::string const& session) {
    Bare request{verb, address.path + target, 11};
    request.set(http::field::host, address.host + ":" + address.port);
    request.set(http::field::connection, "close");
    if (!server.token.empty()) request.set(http::field::authorization, "Bearer " + server.token);
    if (!session.empty()) request.set("RoIS-Session", session);
    request.prepare_payload();
    return request;
}

struct Outcome {
    std::optional<HttpAnswer> answer;
    std::string trouble{};
};

template <class Stream>
asio::awaitable<void> exchange(Stream& stream, Bare& request, Outcome& outcome, Failure& failure) {
    co_await http::async_write(stream, request, into(failure));
    if (failure) co_return;
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(64u << 20);
    co_await http::async_read(stream, buffer, parser, into(failure));
    if (!failure) outcome.answer = HttpAnswer{parser.get().result_int(), parser.get().body()};
}

void load_trusted(asio::ssl::context& context, std::string const& ca_file) {
    Failure failure;
    context.set_default_verify_paths();
    if (!ca_file.empty()) context.load_verify_file(ca_file, failure);
    if (failure)
        throw Trouble{Exit::usage, "the file of trusted certificates " + rois::quoted(ca_file) +
                                       " cannot be read: " + failure.message() + "; it must be a readable file in PEM format"};
}

asio::awaitable<void> exchange_with_tls(beast::tcp_stream stream, Address const& address, HttpServer const& server, Bare& request,
                                        Outcome& outcome, Failure& failure) {
    asio::ssl::context context{asio::ssl::context::tls_client};
    load_trusted(context, server.ca_file);
    beast::ssl_stream<beast::tcp_stream> secured{std::move(stream), context};
    auto const host = without_brackets(address.host);
    SSL_set_tlsext_host_name(secured.native_handle(), host.c_str());
    secured.set_verify_mode(asio::ssl::verify_peer);
    secured.set_verify_callback(asio::ssl::host_name_verification{host});
    co_await secured.async_handshake(asio::ssl::stream_base::client, into(failure));
    if (failure.category() == asio::error::get_ssl_category() &&
        ERR_GET_REASON(static_cast<unsigned long>(failure.value())) == SSL_R_WRONG_VERSION_NUMBER)
        throw Trouble{Exit::no_answer, "this port speaks plain HTTP: use http: or ws: instead of https: or wss:"};
    if (!failure) co_await exchange(secured, request, outcome, failure);
}

// Returns whether a port that speaks TLS may have caused this failure of plain HTTP.
bool may_be_tls(Failure const& failure) {
    return failure.category() == http::make_error_code(http::error::end_of_stream).category();
}

asio::awaitable<void> run(Address const& address, HttpServer const& server, Bare& request, Outcome& outcome) {
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
    if (!address.tls && may_be_tls(failure))
        outcome.trouble += ": this port does not answer in plain HTTP; if it speaks TLS, use https: or wss:";
}

void rethrow(std::exception_ptr const& error) {
    if (error) std::rethrow_exception(error);
}

}  // namespace

Trouble unexpected(std::string const& command, HttpServer const& server, HttpAnswer const& answer) {
    auto const body = harmless(trimmed(answer.body.substr(0, 200)));
    return {Exit::fault, command + ": " + server.url + " answers " + std::to_string(answer.status) +
                             (body.empty() ? "" : ": " + body) + hint_for_url(server.url)};
}

std::string hint_for_url(std::string const& url) {
    auto const last = url.find_last_not_of('/');
    bool const names_rois = std::string_view{url}.substr(0, last + 1).ends_with("/rois");
    return names_rois ? "; leave /rois out of the URL" : "";
}

void check(HttpServer const& server) {
    address_of(server.url);
    if (server.ca_file.empty()) return;
    asio::ssl::context context{asio::ssl::context::tls_client};
    load_trusted(context, server.ca_file);
}

bool is_same_gateway(std::string const& url, std::string const& other) {
    auto one = address_of(url);
    auto two = address_of(other);
    for (auto* const address : {&one, &two}) address->host = lower_case(address->host);
    return one == two;
}

namespace {

HttpAnswer asked(http::verb verb, HttpServer const& server, std::string const& target, std::chrono::milliseconds deadline,
                 std::string const& session) {
    auto const address = address_of(server.url);
    auto request = request_of(verb, address, server, target, session);
    Outcome outcome{.answer = {}, .trouble = "no answer within " + std::to_string(deadline.count()) + " ms"};
    auto io = std::make_unique<asio::io_context>(1);
    asio::co_spawn(*io, run(address, server, request, outcome), rethrow);
    io->run_for(deadline);
    // The destructor would wait for a host name that is still looked up. Leaks the context instead: the program ends soon.
    [[maybe_unused]] static asio::io_context* left_alone = nullptr;
    if (!io->stopped()) left_alone = io.release();
    if (!outcome.answer) throw Trouble{Exit::no_answer, server.url + ": " + outcome.trouble};
    return std::move(*outcome.answer);
}

}  // namespace

HttpAnswer http_get(HttpServer const& server, std::string const& target, std::chrono::milliseconds deadline,
                    std::string const& session) {
    return asked(http::verb::get, server, target, deadline, session);
}

HttpAnswer http_post(HttpServer const& server, std::string const& target, std::chrono::milliseconds deadline) {
    return asked(http::verb::post, server, target, deadline, {});
}

}  // namespace rois::command
