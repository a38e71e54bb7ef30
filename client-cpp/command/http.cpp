#include "command/http.hpp"

#include "command/asio.hpp"
// Asio first.
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>

#include "command/output/terminal.hpp"
#include "links/byte_stream.hpp"
#include "links/target.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

client::Target target_of(HttpServer const& server) {
    try {
        return client::read_url(server.url, server.token);
    } catch (std::invalid_argument const& problem) {
        throw Trouble{Exit::usage, problem.what()};
    }
}

// The path of the URL, without that of the engine.
std::string path_of(client::Target const& at) { return at.path.substr(0, at.path.rfind("/rois")); }

// Null without TLS.
std::unique_ptr<asio::ssl::context> trust_of(client::Target const& at, HttpServer const& server) {
    if (at.security == client::Security::plain && server.ca_file.empty() && server.certificate_file.empty()) return nullptr;
    Settings settings;
    settings.ca_file = server.ca_file;
    settings.certificate_file = server.certificate_file;
    try {
        return client::trust(settings);
    } catch (std::runtime_error const& problem) {
        throw Trouble{Exit::usage, problem.what()};
    }
}

using Bare = http::request<http::empty_body>;

Bare request_of(http::verb verb, client::Target const& at, HttpServer const& server, std::string const& target,
                std::string const& session) {
    Bare request{verb, path_of(at) + target, 11};
    request.set(http::field::host, at.authority);
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

// Returns whether a port that speaks TLS may have caused this failure of plain HTTP.
bool may_be_tls(Failure const& failure) {
    return failure.category() == http::make_error_code(http::error::end_of_stream).category();
}

template <class Stream>
client::Opening exchange(Stream& stream, client::Socket& lowest, client::Target const& at, Bare& request, Outcome& outcome) {
    client::Resolver resolver{co_await asio::this_coro::executor};
    outcome.trouble = co_await client::connect(stream, lowest, resolver, at);
    if (!outcome.trouble.empty()) co_return;
    Failure failure;
    co_await http::async_write(stream, request, client::into(failure));
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(64u << 20);
    if (!failure) co_await http::async_read(stream, buffer, parser, client::into(failure));
    if (!failure) outcome.answer = HttpAnswer{parser.get().result_int(), parser.get().body()};
    if (failure) outcome.trouble = failure.message();
    if (at.security == client::Security::plain && may_be_tls(failure))
        outcome.trouble += ": this port does not answer in plain HTTP; if it speaks TLS, use https: or wss:";
}

client::Opening run(client::Target const& at, asio::ssl::context* trusted, Bare& request, Outcome& outcome) {
    auto const executor = co_await asio::this_coro::executor;
    if (at.security == client::Security::tls) {
        client::TlsSocket stream{executor, *trusted};
        co_await exchange(stream, stream.next_layer(), at, request, outcome);
    } else {
        client::Socket stream{executor};
        co_await exchange(stream, stream, at, request, outcome);
    }
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

void check(HttpServer const& server) { trust_of(target_of(server), server); }

bool is_same_gateway(std::string const& url, std::string const& other) {
    auto const one = target_of({url}), two = target_of({other});
    return lower_case(one.host) == lower_case(two.host) && one.port == two.port && one.path == two.path &&
           one.security == two.security;
}

namespace {

HttpAnswer asked(http::verb verb, HttpServer const& server, std::string const& target, std::chrono::milliseconds deadline,
                 std::string const& session) {
    auto const at = target_of(server);
    auto const trusted = trust_of(at, server);
    auto request = request_of(verb, at, server, target, session);
    Outcome outcome{.answer = {}, .trouble = "no answer within " + std::to_string(deadline.count()) + " ms"};
    auto io = std::make_unique<asio::io_context>(1);
    asio::co_spawn(*io, run(at, trusted.get(), request, outcome), rethrow);
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
