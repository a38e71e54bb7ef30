#include "rois/everything.hpp"

#include "links/byte_stream.hpp"
// Asio first.
#include <boost/asio/co_spawn.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/http.hpp>
#include <optional>
#include <string_view>
#include <thread>

#include "core/loop.hpp"
#include "xml/codec/codec.hpp"

namespace rois {

namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
using client::error_code;

struct Asked {
    client::Target target;
    http::request<http::empty_body> request{};
    std::optional<http::response<http::string_body>> answer{};
    std::string trouble{};
};

template <class Stream>
client::Opening ask_on(Stream& stream, Asked& asked) {
    client::Resolver resolver{stream.get_executor()};
    asked.trouble = co_await connect(stream, beast::get_lowest_layer(stream), resolver, asked.target);
    if (!asked.trouble.empty()) co_return;
    error_code error;
    beast::flat_buffer incoming;
    http::response<http::string_body> answer;
    co_await http::async_write(stream, asked.request, client::into(error));
    if (!error) co_await http::async_read(stream, incoming, answer, client::into(error));
    if (error) {
        asked.trouble = "the link broke: " + error.message();
    } else {
        asked.answer = std::move(answer);
    }
}

client::Opening ask(Settings const& settings, Asked& asked) {
    auto const executor = co_await boost::asio::this_coro::executor;
    if (asked.target.security == client::Security::plain) {
        client::Socket socket{executor};
        co_await ask_on(socket, asked);
        co_return;
    }
    std::unique_ptr<boost::asio::ssl::context> trusted;
    try {
        trusted = client::trust(settings);
    } catch (std::exception const& problem) {
        asked.trouble = problem.what();
        co_return;
    }
    client::TlsSocket socket{executor, *trusted};
    co_await ask_on(socket, asked);
}

void rethrow(std::exception_ptr const& error) {
    if (error) std::rethrow_exception(error);
}

// Posts to the path and returns the state that the gateway answers. Throws Error; its text begins with `what`.
StopState post(Settings const& settings, std::string_view path, std::string const& what) {
    Asked asked{.target = client::read_url(settings.url, settings.token)};
    asked.request = {http::verb::post, asked.target.path + std::string{path}, 11};
    asked.request.set(http::field::host, asked.target.authority);
    asked.request.set(http::field::connection, "close");
    if (!settings.token.empty()) asked.request.set(http::field::authorization, "Bearer " + settings.token);
    asked.request.prepare_payload();
    auto io = std::make_unique<boost::asio::io_context>(1);
    boost::asio::co_spawn(io->get_executor(), ask(settings, asked), rethrow);
    io->run_for(client::bounded(settings.deadline));
    if (!io->stopped()) {
        // Its end waits for a name that is still looked up.
        std::thread{[io = std::move(io)]() mutable { io.reset(); }}.detach();
        throw Error{ReturnCode::timeout, what + ": no answer of " + asked.target.authority + " within " +
                                             std::to_string(settings.deadline.count()) + " ms"};
    }
    if (!asked.answer) throw Error{ReturnCode::error, what + ": " + asked.trouble};
    auto const status = asked.answer->result_int();
    if (status != 200)
        throw Error{ReturnCode::error,
                    what + ": " + asked.target.authority + " answers with HTTP status " + std::to_string(status)};
    auto state = xml::AnswerReader{}.read_stop_state(asked.answer->body());
    if (!state)
        throw Error{ReturnCode::error, what + ": the answer of " + asked.target.authority + " is not a stop_state document"};
    return *std::move(state);
}

}  // namespace

StopState stop_everything(Settings const& settings) { return post(settings, "/stop", "stop for everything"); }

StopState clear_everything(Settings const& settings) { return post(settings, "/clear", "clear"); }

}  // namespace rois
