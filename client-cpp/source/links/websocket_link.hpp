// A link over a WebSocket, on TCP or TLS. For websocket_link.cpp and websocket_link_tls.cpp.
#pragma once

#include "links/byte_stream.hpp"
// Asio first.
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <deque>

#include "core/loop.hpp"
#include "links/link.hpp"
#include "xml/codec/codec.hpp"

namespace rois::client {

namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;

std::shared_ptr<Link> websocket_link_tls(Loop&, Target const&, Settings const&, Link::Listener&);

template <class Stream>
class WebSocketLink final : public Link, public std::enable_shared_from_this<WebSocketLink<Stream>> {
public:
    // `context` is null without TLS.
    WebSocketLink(Loop& loop, Target target, Settings const& settings, Listener& listener,
                  std::unique_ptr<asio::ssl::context> context)
        : Link{listener},
          target_{std::move(target)},
          settings_{settings},
          context_{std::move(context)},
          resolver_{loop.executor()},
          stream_{make_stream<Stream, Full>(loop.executor(), context_.get())} {}

    void open() override {
        asio::co_spawn(
            beast::get_lowest_layer(stream_).get_executor(),
            [self = this->shared_from_this()] { return self->head_.empty() ? self->run() : self->run_accepted(); },
            asio::detached);
    }

    // Uses a connected socket. Makes this the server's side of an accepted WebSocket if there is a `head`. Returns false if the
    // socket cannot be used. Only for Socket.
    bool use(UniqueDescriptor socket, std::string head = {}) {
        error_code error;
        beast::get_lowest_layer(stream_).assign(asio::ip::tcp::v4(), socket.get(), error);
        if (error) return false;
        socket.release();
        head_ = std::move(head);
        return true;
    }

    void send(Document document) override {
        outgoing_.push_back(std::move(document));
        if (outgoing_.size() == 1) write();
    }

    void attach(SessionId const& session, std::uint64_t last_sequence) override {
        send(document_of({Resume{session, last_sequence}, "resume"}));
    }

    void pause() override { is_paused_ = true; }
    void go_on() override {
        is_paused_ = false;
        if (std::exchange(read_is_due_, false)) read();
    }

    void cut() override {
        listener_ = nullptr;
        resolver_.cancel();
        error_code ignored;
        beast::get_lowest_layer(stream_).close(ignored);
    }

private:
    using Full = websocket::stream<Stream, false>;

    // Beast sends a ping after half of the idle_timeout without traffic.
    void set_options() {
        stream_.set_option(websocket::stream_base::timeout{.handshake_timeout = settings_.connect_deadline,
                                                           .idle_timeout = 2 * settings_.ping_interval,
                                                           .keep_alive_pings = true});
        stream_.set_option(websocket::stream_base::decorator([this](websocket::request_type& request) {
            request.set(http::field::sec_websocket_protocol, subprotocol);
            if (!settings_.token.empty()) request.set(http::field::authorization, "Bearer " + settings_.token);
        }));
        stream_.control_callback([this](websocket::frame_type kind, beast::string_view) {
            if (kind == websocket::frame_type::ping && listener_ != nullptr) listener_->pinged();
        });
        stream_.read_message_max(settings_.longest_document);
        stream_.auto_fragment(false);
        stream_.text(true);
    }

    Opening run() {
        auto& lowest = beast::get_lowest_layer(stream_);
        std::string problem;
        if (!lowest.is_open()) problem = co_await connect(stream_.next_layer(), lowest, resolver_, target_);
        if (!problem.empty()) {
            fail(problem, Failure::passing);
            co_return;
        }
        set_options();
        websocket::response_type answer;
        error_code error;
        co_await stream_.async_handshake(answer, target_.authority, target_.path, into(error));
        if (error) {
            refuse(error, answer);
            co_return;
        }
        if (listener_ == nullptr) co_return;
        listener_->connected();
        read();
    }

    Opening run_accepted() {
        set_options();
        stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, subprotocol);
            response.set("X-Content-Type-Options", "nosniff");
            response.set(http::field::server, "rois-gateway");  // otherwise the name of the library
        }));
        error_code error;
        co_await stream_.async_accept(asio::buffer(head_), into(error));
        if (error) {
            fail("no WebSocket: " + error.message(), Failure::passing);
            co_return;
        }
        if (listener_ == nullptr) co_return;
        listener_->connected();
        read();
    }

    void refuse(error_code error, websocket::response_type const& answer) {
        if (error != websocket::error::upgrade_declined) {
            fail("no WebSocket with " + target_.authority + ": " + error.message(), Failure::passing);
            return;
        }
        auto const status = answer.result_int();
        auto const document = xml::AnswerReader{}.read(answer.body());
        auto const* fault = document ? std::get_if<Fault>(&*document) : nullptr;
        bool const lasting = status >= 400 && status < 500 && status != 429 && status != 408;
        fail(target_.authority + " refuses a WebSocket: " + std::to_string(status) + " " + std::string{answer.reason()} +
                 (fault == nullptr ? "" : ": " + fault->reason),
             lasting ? Failure::lasting : Failure::passing);
    }

    void read() {
        if (listener_ == nullptr) return;
        if (is_paused_) {
            read_is_due_ = true;
            return;
        }
        stream_.async_read_some(incoming_, most_at_once,
                                [self = this->shared_from_this()](error_code error, std::size_t) { self->was_read(error); });
    }

    void was_read(error_code error) {
        if (error) {
            broke(error);
            return;
        }
        if (stream_.is_message_done()) {
            auto const data = incoming_.cdata();
            if (listener_ != nullptr) listener_->document({static_cast<char const*>(data.data()), data.size()});
            incoming_.consume(incoming_.size());
        }
        read();
    }

    void write() {
        stream_.async_write(asio::buffer(*outgoing_.front()), [self = this->shared_from_this()](error_code error, std::size_t) {
            self->outgoing_.pop_front();
            if (error) {
                // The read that waits fails, too, and knows why the link broke.
                if (self->read_is_due_) self->broke(error);
            } else if (!self->outgoing_.empty() && self->listener_ != nullptr) {
                self->write();
            }
        });
    }

    // Reports the reason of the gateway's close frame, if there was one, rather than the error.
    void broke(error_code error) {
        auto const& closed = stream_.reason();
        if (!closed) {
            bool const invalid = error == websocket::error::bad_frame_payload;
            fail("the link broke: " + error.message(), invalid ? Failure::invalid : Failure::passing);
            return;
        }
        fail("the gateway closed the link: " + std::string{closed.reason.c_str()},
             closed.code == websocket::close_code::too_big ? Failure::too_large : Failure::passing);
    }

    static constexpr std::size_t most_at_once = 64 * 1024;
    static constexpr auto subprotocol = "rois.xml.v1";

    Target target_;
    Settings const& settings_;
    std::unique_ptr<asio::ssl::context> context_;
    Resolver resolver_;
    Full stream_;
    std::string head_;  // of a link that is accepted
    beast::flat_buffer incoming_;
    std::deque<Document> outgoing_;  // the first one is being sent
    bool is_paused_ = false;
    bool read_is_due_ = false;  // as soon as it goes on
};

}  // namespace rois::client
