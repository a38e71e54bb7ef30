#include "command/recording/front_connection.hpp"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>

namespace rois::command {

namespace {

namespace websocket = beast::websocket;
using Socket = websocket::stream<beast::tcp_stream>;

constexpr auto subprotocol = "rois.xml.v1";

bool asks_for_subprotocol(HttpMessage const& message) {
    auto const asked = message[http::field::sec_websocket_protocol];
    for (auto const one : http::token_list{asked})
        if (one == subprotocol) return true;
    return false;
}

// The output of a WebSocket: queued answers first, then the notifications of its session.
struct Writing {
    explicit Writing(asio::io_context& io) : timer{io, asio::steady_timer::time_point::max()} {}

    std::deque<std::string> answers;
    std::shared_ptr<HostedSession> session;  // null: none yet
    std::uint64_t last_sequence = 0;         // of the last notification that was written
    std::uint64_t number = 0;                // of this WebSocket
    bool over = false;
    asio::steady_timer timer;

    bool is_current() const { return session && session->websocket == number; }
    HostedSession::Numbered const* next() const { return is_current() ? session->after(last_sequence) : nullptr; }
};

std::uint64_t next_number() {
    static std::uint64_t number = 0;
    return ++number;
}

asio::awaitable<void> write_all(std::shared_ptr<Socket> socket, std::shared_ptr<Writing> writing, Host& host) {
    Failure failure;
    while (!failure && !writing->over) {
        std::string out;
        if (!writing->answers.empty()) {
            out = std::move(writing->answers.front());
            writing->answers.pop_front();
        } else if (auto const* const one = writing->next()) {
            out = one->document;
            writing->last_sequence = one->sequence;
        }
        if (!out.empty()) {
            co_await socket->async_write(asio::buffer(out), into(failure));
        } else if (writing->session && !writing->is_current()) {
            co_await socket->async_close(
                websocket::close_reason{websocket::close_code::policy_error, "another WebSocket has taken over the session"},
                into(failure));
            co_return;
        } else if (writing->session && !writing->session->ended()) {
            asio::steady_timer timer{host.io(), asio::steady_timer::time_point::max()};
            co_await writing->session->wait(timer);
        } else {
            Failure cancelled;
            co_await writing->timer.async_wait(into(cancelled));
        }
    }
}

}  // namespace

asio::awaitable<void> Front::Connection::upgrade(HttpMessage message) {
    auto const target = std::string_view{message.target().data(), message.target().size()};
    if (target != "/rois" || !asks_for_subprotocol(message)) {
        co_await refuse(message, FaultCode::not_well_formed, "open WebSockets on /rois, with the subprotocol rois.xml.v1");
        co_return;
    }
    auto const socket = std::make_shared<Socket>(std::move(stream_));
    socket->set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { response.set(http::field::sec_websocket_protocol, subprotocol); }));
    socket->set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket->read_message_max(16u << 20);
    socket->text(true);
    Failure failure;
    co_await socket->async_accept(message, into(failure));
    if (failure) co_return;

    auto const writing = std::make_shared<Writing>(host_.io());
    writing->number = next_number();
    asio::co_spawn(host_.io(), write_all(socket, writing, host_), asio::detached);
    auto const follow = [&](std::shared_ptr<HostedSession> const& session, std::uint64_t last) {
        if (session == writing->session) return;
        if (writing->session) --writing->session->connections;
        writing->session = session;
        writing->last_sequence = last;
        session->websocket = writing->number;
        ++session->connections;
        session->wake();  // closes the WebSocket that had the session
    };
    while (true) {
        beast::flat_buffer buffer;
        co_await socket->async_read(buffer, into(failure));
        if (failure) break;
        auto session = writing->session;
        auto last = writing->last_sequence;
        auto document = beast::buffers_to_string(buffer.data());
        auto answer = co_await answer_of(std::move(document), session, true, last);
        writing->answers.push_back(std::move(answer));
        auto const before = writing->session;
        if (session) follow(session, last);
        if (before) before->wake();
        writing->timer.cancel();
    }
    writing->over = true;
    if (writing->session) {
        --writing->session->connections;
        writing->session->used = std::chrono::steady_clock::now();
        writing->session->wake();
    }
    writing->timer.cancel();
}

}  // namespace rois::command
