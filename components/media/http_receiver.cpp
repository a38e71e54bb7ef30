#include "media/channel.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/detect_ssl.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "media/feed.hpp"
#include "wire/credentials.hpp"

namespace rois::media {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

using Stream = beast::basic_stream<asio::ip::tcp, Executor>;
using Error = boost::system::error_code;

constexpr auto between_looks = Clock::duration{std::chrono::milliseconds{100}};  // interval of the checks for an ended channel
constexpr auto longest_parting = std::chrono::seconds{1};
constexpr auto between_cancels = std::chrono::milliseconds{1};
constexpr auto most_behind = Clock::duration{std::chrono::seconds{1}};  // a slow receiver loses the data beyond this delay

std::string head_of(std::string_view status, std::string_view content_type, std::string_view more = {}) {
    std::string head{"HTTP/1.1 "};
    head.append(status).append("\r\nContent-Type: ").append(content_type);
    head.append("\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n");
    return head.append(more).append("\r\n");
}

std::string whole(std::string_view status, std::string_view content_type, std::string_view content, bool with_content,
                  std::string more = {}) {
    more += "Content-Length: " + std::to_string(content.size()) + "\r\n";
    auto answer = head_of(status, content_type, more);
    if (with_content) answer += content;
    return answer;
}

std::string refusal(std::string_view status, std::string_view reason, bool with_content = true, std::string more = {}) {
    return whole(status, "text/plain", std::string{reason} + "\n", with_content, std::move(more));
}

// One connection, shared by the coroutine that answers and the one that watches for a disconnect.
struct Connection : std::enable_shared_from_this<Connection> {
    Connection(Socket socket, Directory const& known, Settings const& how)
        : stream{std::move(socket)}, directory{known}, settings{how} {}

    Stream stream;
    std::shared_ptr<asio::ssl::context> context{};    // null: no TLS
    std::optional<asio::ssl::stream<Stream&>> tls{};  // after the handshake
    Directory const& directory;
    Settings const& settings;
    beast::flat_buffer received;
    bool watched = false;
    bool gone = false;

    Executor executor() { return stream.get_executor(); }
};

using SharedConnection = std::shared_ptr<Connection>;

Task<> watch(SharedConnection connection) {
    std::array<char, 512> ignored{};
    Error error;
    while (!error) {
        connection->stream.expires_never();
        if (connection->tls)
            co_await connection->tls->async_read_some(asio::buffer(ignored), into(error));
        else
            co_await connection->stream.async_read_some(asio::buffer(ignored), into(error));
    }
    connection->gone = true;
}

void begin_to_watch(Connection& connection) {
    if (std::exchange(connection.watched, true)) return;
    asio::co_spawn(connection.executor(), watch(connection.shared_from_this()), asio::detached);
}

// Returns false if the receiver did not take the text in time.
Task<bool> write(Connection& connection, std::string_view text) {
    Error error;
    connection.stream.expires_after(connection.settings.limits.write_timeout);
    if (connection.tls)
        co_await asio::async_write(*connection.tls, asio::buffer(text), into(error));
    else
        co_await asio::async_write(connection.stream, asio::buffer(text), into(error));
    co_return !error;
}

Task<> flow(Connection& connection, Channel& channel, Feed& feed) {
    Receiver const receiver{channel};
    Timer timer{connection.executor()};
    auto const over = [&] { return connection.gone || channel.ended(); };
    for (auto due = Clock::now(); !over();) {
        auto const now = Clock::now();
        if (now < due) {
            Error error;
            timer.expires_at(std::min(due, now + between_looks));
            co_await timer.async_wait(into(error));
            continue;
        }
        due = std::max(due, now - most_behind) + feed.interval();
        auto const piece = channel.held() ? std::string{} : feed.next(now);
        if (piece.empty()) continue;
        auto const taken = co_await write(connection, piece);
        if (!taken) break;
    }
}

Task<> watch_interest(std::shared_ptr<Channel> channel, Executor executor) {
    Receiver const receiver{*channel};
    Timer timer{executor};
    while (!channel->ended()) {
        auto const now = Clock::now();
        if (now >= channel->interest_until) break;
        Error error;
        timer.expires_at(std::min(channel->interest_until, now + between_looks));
        co_await timer.async_wait(into(error));
    }
    channel->interest_watched = false;
}

// Counts the sender of a picture request as a receiver for a while.
void note_interest(std::shared_ptr<Channel> const& channel, Connection& connection) {
    channel->interest_until = Clock::now() + connection.settings.picture_interest;
    if (std::exchange(channel->interest_watched, true)) return;
    asio::co_spawn(connection.executor(), watch_interest(channel, connection.executor()), asio::detached);
}

bool is_single_picture(Content const& content) {
    auto const* film = std::get_if<Film>(&content);
    return film != nullptr && film->form == Film::Form::jpeg;
}

std::string single_picture(Channel& channel, bool with_content) {
    static std::string const soon = "Retry-After: 1\r\n";
    if (channel.held()) return refusal("503 Service Unavailable", "the stream is suspended", with_content, soon);
    auto const picture = channel.picture(Clock::now());
    if (!picture) return refusal("503 Service Unavailable", "there is no picture yet", with_content, soon);
    return whole("200 OK", "image/jpeg", *picture, with_content);
}

// Returns the response to a request beyond the limits, or without exactly one Host; else nothing.
std::optional<std::string> invalid_refusal(http::request<http::empty_body> const& request, Settings const& settings) {
    bool const with_content = request.method() != http::verb::head;
    if (static_cast<std::size_t>(std::distance(request.begin(), request.end())) > settings.limits.max_header_fields)
        return refusal("431 Request Header Fields Too Large",
                       "more than " + std::to_string(settings.limits.max_header_fields) + " header fields (max_header_fields)",
                       with_content);
    if (request.target().size() > settings.limits.max_target)
        return refusal("414 URI Too Long",
                       "the target has more than " + std::to_string(settings.limits.max_target) + " bytes (max_target)",
                       with_content);
    if (request.count(http::field::host) > 1 || (request.count(http::field::host) == 0 && request.version() > 10))
        return refusal("400 Bad Request", "expected exactly one Host header", with_content);
    return {};
}

// Rejects requests from web pages of other sites. Returns the rejecting response, or nothing.
std::optional<std::string> foreign_refusal(http::request<http::empty_body> const& request, Settings const& settings) {
    auto const view = [](beast::string_view text) { return std::string_view{text.data(), text.size()}; };
    bool const with_content = request.method() != http::verb::head;
    auto const host = view(request[http::field::host]);
    if (settings.is_own_host && request.count(http::field::host) == 1 && !settings.is_own_host(host))
        return refusal("421 Misdirected Request",
                       "this host is not one of the gateway's: expected localhost, an IP address or the name of its machine; the "
                       "key hosts adds other names",
                       with_content);
    auto const [first, last] = request.equal_range(http::field::origin);
    bool const allowed = !settings.is_allowed_origin || std::all_of(first, last, [&](auto const& field) {
        return settings.is_allowed_origin(view(field.value()), host);
    });
    if (!allowed)
        return refusal("403 Forbidden", "pages of this origin are not allowed here; the key allowed_origins adds other origins",
                       with_content);
    return {};
}

// Returns the response if it is complete at once; nothing if a feed follows.
std::optional<std::string> short_answer(http::request<http::empty_body> const& request, std::shared_ptr<Channel> const& channel,
                                        Connection& connection) {
    bool const with_content = request.method() == http::verb::get;
    if (!with_content && request.method() != http::verb::head)
        return refusal("405 Method Not Allowed", "method not allowed: use GET or HEAD", true, "Allow: GET, HEAD\r\n");
    if (!channel) return refusal("404 Not Found", "unknown stream: use the address that connect_stream returned", with_content);
    if (is_single_picture(channel->content())) {
        note_interest(channel, connection);
        return single_picture(*channel, with_content);
    }
    if (!with_content) return head_of("200 OK", feed_of(*channel)->content_type());
    return {};
}

std::shared_ptr<Channel> channel_of(http::request<http::empty_body> const& request, Directory const& directory) {
    std::string_view path{request.target().data(), request.target().size()};
    path = path.substr(0, path.find('?'));
    return path.starts_with('/') ? directory.find(path.substr(1)) : nullptr;
}

Task<> answer(SharedConnection connection, http::request<http::empty_body> request) {
    for (auto* judge : {&invalid_refusal, &foreign_refusal}) {
        if (auto const text = judge(request, connection->settings)) {
            co_await write(*connection, *text);
            co_return;
        }
    }
    auto const channel = channel_of(request, connection->directory);
    if (auto const text = short_answer(request, channel, *connection)) {
        co_await write(*connection, *text);
        co_return;
    }
    auto const feed = feed_of(*channel);
    auto const head = head_of("200 OK", feed->content_type());
    auto const begun = co_await write(*connection, head);
    if (!begun) co_return;
    begin_to_watch(*connection);
    co_await flow(*connection, *channel, *feed);
}

// Returns the response to an invalid request; empty if the connection is unusable.
std::string parse_refusal(Error const& error, std::size_t max_header) {
    if (error == http::error::header_limit)
        return refusal("431 Request Header Fields Too Large",
                       "the header has more than " + std::to_string(max_header) + " bytes (max_header)");
    bool const of_http = error.category() == http::make_error_code(http::error::bad_method).category();
    if (!of_http || error == http::error::end_of_stream || error == http::error::partial_message) return {};
    return refusal("400 Bad Request", "invalid HTTP request: " + error.message());
}

// Returns whether a request may follow. Plain HTTP on a port with TLS gets an answer in plain HTTP.
Task<bool> secure(Connection& connection) {
    auto const& settings = connection.settings;
    if (!settings.credentials) co_return true;
    Error error;
    connection.stream.expires_after(settings.limits.handshake_timeout);
    auto const is_tls = co_await beast::async_detect_ssl(connection.stream, connection.received, into(error));
    if (!error && !is_tls) co_await write(connection, refusal("400 Bad Request", tls::expects_tls));
    if (error || !is_tls) co_return false;
    connection.context = settings.credentials->context();
    connection.tls.emplace(connection.stream, *connection.context);
    auto const used =
        co_await connection.tls->async_handshake(asio::ssl::stream_base::server, connection.received.data(), into(error));
    connection.received.consume(used);
    if (error) connection.tls.reset();
    co_return !error;
}

// Gives the receiver time to read the whole response before the connection closes.
Task<> linger(Connection& connection) {
    Error error;
    Timer timer{connection.executor()};
    auto const end = Clock::now() + longest_parting;
    // Ends `watch`: the shutdown would wait for its read, which has no deadline. A read that has just succeeded is not cancelled.
    while (connection.tls && connection.watched && !connection.gone) {
        if (Clock::now() >= end) co_return;
        connection.stream.socket().cancel(error);
        timer.expires_after(between_cancels);
        co_await timer.async_wait(into(error));
    }
    connection.stream.expires_after(longest_parting);
    if (connection.tls) co_await connection.tls->async_shutdown(into(error));
    connection.stream.socket().shutdown(asio::socket_base::shutdown_send, error);
    begin_to_watch(connection);
    while (!connection.gone && Clock::now() < end) {
        timer.expires_after(between_looks / 10);
        co_await timer.async_wait(into(error));
    }
}

Task<> serve_request(SharedConnection connection) {
    Error error;
    http::request_parser<http::empty_body> parser;
    parser.header_limit(static_cast<std::uint32_t>(connection->settings.limits.max_header));
    connection->stream.expires_after(connection->settings.limits.request_timeout);
    if (connection->tls)
        co_await http::async_read_header(*connection->tls, connection->received, parser, into(error));
    else
        co_await http::async_read_header(connection->stream, connection->received, parser, into(error));
    if (!error) {
        co_await answer(connection, parser.release());
    } else if (auto const text = parse_refusal(error, connection->settings.limits.max_header); !text.empty()) {
        co_await write(*connection, text);
    }
}

}  // namespace

Task<> serve_receiver(Socket socket, Directory const& directory, Settings const& settings) {
    auto const connection = std::make_shared<Connection>(std::move(socket), directory, settings);
    Error error;
    connection->stream.socket().set_option(asio::ip::tcp::no_delay{true}, error);
    connection->stream.socket().set_option(asio::socket_base::keep_alive{true}, error);
    auto const may_ask = co_await secure(*connection);
    if (may_ask) co_await serve_request(connection);
    co_await linger(*connection);
    connection->stream.close();
}

}  // namespace rois::media
