// One connection of a Front. Only for front*.cpp.
#pragma once

#include <memory>
#include <string>

#include "command/recording/front.hpp"
#include "xml/codec/codec.hpp"

namespace rois::command {

using HttpMessage = http::request<http::string_body>;

class Front::Connection : public std::enable_shared_from_this<Front::Connection> {
public:
    Connection(Front& front, asio::ip::tcp::socket socket)
        : host_{front.host_}, reader_{front.schemas_}, stream_{std::move(socket)} {
        Failure ignored;
        stream_.socket().set_option(asio::ip::tcp::no_delay{true}, ignored);
    }

    // Answers requests until the connection ends, or becomes a WebSocket or an event stream. A shared_ptr must own it.
    asio::awaitable<void> run();

private:
    enum class Then { next, over };

    asio::awaitable<Then> answer(HttpMessage&);
    asio::awaitable<Then> answer_document(HttpMessage&);
    asio::awaitable<Then> answer_notifications(HttpMessage&);
    asio::awaitable<Then> poll(HttpMessage&, std::shared_ptr<HostedSession>, std::uint64_t after, int wait);
    asio::awaitable<void> stream(std::shared_ptr<HostedSession>, std::uint64_t after);
    asio::awaitable<void> upgrade(HttpMessage);

    asio::awaitable<Then> write(HttpMessage const&, http::status, std::string body, std::string_view type = "application/xml",
                                std::string session = {});
    asio::awaitable<Then> write(HttpMessage const&, Fault const&);
    asio::awaitable<Then> refuse(HttpMessage const&, FaultCode, std::string reason);

    // Returns the document that answers this one. Updates `session` after `connect`, `resume` and `disconnect`.
    asio::awaitable<std::string> answer_of(std::string document, std::shared_ptr<HostedSession>& session, bool on_websocket,
                                           std::uint64_t& last_sequence);

    Host& host_;
    xml::RequestReader reader_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_;
};

// Returns the HTTP status of an answer: 200, or that of its fault.
http::status status_of(std::string const& answer);
Fault no_such_session(std::string request_id = {});

}  // namespace rois::command
