// A link over HTTP: sends requests one at a time over one connection, and receives notifications as an event stream over another.
// For http_link.cpp and http_link_tls.cpp.
#pragma once

#include "links/byte_stream.hpp"
// Asio first.
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/http.hpp>
#include <deque>

#include "core/loop.hpp"
#include "links/event_source.hpp"
#include "links/link.hpp"

namespace rois::client {

namespace beast = boost::beast;
namespace http = boost::beast::http;

std::shared_ptr<Link> http_link_tls(Loop&, Target const&, Settings const&, Link::Listener&);

template <class Stream>
class HttpLink final : public Link, public std::enable_shared_from_this<HttpLink<Stream>> {
public:
    // `context` is null without TLS.
    HttpLink(Loop& loop, Target target, Settings const& settings, Listener& listener, std::unique_ptr<asio::ssl::context> context)
        : Link{listener}, loop_{loop}, target_{std::move(target)}, settings_{settings}, context_{std::move(context)} {}

    void open() override {
        spawn([self = this->shared_from_this()] { return self->open_requests(); });
    }

    void send(Document document) override {
        outgoing_.push_back(std::move(document));
        if (std::exchange(sending_, true)) return;
        spawn([self = this->shared_from_this()] { return self->send_requests(); });
    }

    void attach(SessionId const& session, std::uint64_t last_sequence) override {
        session_ = session;
        spawn([self = this->shared_from_this(), last_sequence] { return self->open_events(last_sequence); });
    }

    void cut() override {
        listener_ = nullptr;
        for (auto* line : {&requests_, &notifications_})
            if (*line) (*line)->close();
        loop_.cancel(silence_);
    }

private:
    // One connection.
    struct Line {
        Line(Loop& loop, asio::ssl::context* context)
            : resolver{loop.executor()}, stream{make_stream<Stream, Stream>(loop.executor(), context)} {}

        void close() {
            resolver.cancel();
            error_code ignored;
            beast::get_lowest_layer(stream).close(ignored);
        }

        Resolver resolver;
        Stream stream;
        beast::flat_buffer incoming;
        Steady used = std::chrono::steady_clock::now();
    };

    template <class Coroutine>
    void spawn(Coroutine coroutine) {
        asio::co_spawn(loop_.executor(), std::move(coroutine), asio::detached);
    }

    // Opens the connection for requests.
    Opening open_requests() {
        auto const line = requests_ = std::make_shared<Line>(loop_, context_.get());
        auto const problem = co_await connect(line->stream, beast::get_lowest_layer(line->stream), line->resolver, target_);
        if (!problem.empty()) {
            fail(problem, Failure::passing);
        } else if (listener_ != nullptr) {
            listener_->connected();
        }
    }

    template <class Body>
    void set_common(http::request<Body>& request) const {
        request.version(11);
        request.set(http::field::host, target_.authority);
        if (!settings_.token.empty()) request.set(http::field::authorization, "Bearer " + settings_.token);
        if (!session_.text.empty()) request.set("RoIS-Session", session_.text);
    }

    // Sends the queued requests one at a time. Gateways close a connection after a minute of silence: opens another one before.
    Opening send_requests() {
        auto const self = this->shared_from_this();
        while (!outgoing_.empty() && listener_ != nullptr) {
            constexpr auto longest_idle = std::chrono::seconds{30};
            if (requests_->used + longest_idle < std::chrono::steady_clock::now()) {
                requests_->close();
                auto const fresh = requests_ = std::make_shared<Line>(loop_, context_.get());
                auto const problem =
                    co_await connect(fresh->stream, beast::get_lowest_layer(fresh->stream), fresh->resolver, target_);
                if (!problem.empty()) {
                    fail(problem, Failure::passing);
                    co_return;
                }
            }
            co_await send_request(requests_);
        }
        sending_ = false;
    }

    Opening send_request(std::shared_ptr<Line> line) {
        http::request<http::string_body> request;
        request.method(http::verb::post);
        request.target(target_.path);
        set_common(request);
        request.set(http::field::content_type, "application/xml");
        request.body() = *outgoing_.front();
        request.prepare_payload();
        http::response_parser<http::string_body> parser;
        parser.body_limit(settings_.longest_document);
        // An engine answers at once, so a gateway that does not is gone.
        auto const longest = 2 * settings_.ping_interval;
        auto const late = loop_.in(longest, [this, longest] {
            fail("no answer from the gateway within " + std::to_string(longest.count()) + " ms", Failure::passing);
        });
        error_code error;
        co_await http::async_write(line->stream, request, into(error));
        if (!error) co_await http::async_read(line->stream, line->incoming, parser, into(error));
        loop_.cancel(late);
        if (error) {
            fail("the link broke: " + error.message(), Failure::passing);
            co_return;
        }
        line->used = std::chrono::steady_clock::now();
        if (!parser.get().keep_alive()) line->used -= std::chrono::hours{1};
        outgoing_.pop_front();
        take(parser.get());
        if (stream_over_) fail("the gateway closed the event stream", Failure::passing);
    }

    void take(http::response<http::string_body> const& answer) {
        if (listener_ == nullptr) return;
        bool const document = answer[http::field::content_type].find("xml") != beast::string_view::npos;
        auto const status = answer.result_int();
        if (status == 401) {
            fail(target_.authority + " rejects the token (HTTP status 401)", Failure::lasting);
        } else if (document && status != 503) {
            listener_->document(answer.body());
        } else {
            fail(target_.authority + " answered with HTTP status " + std::to_string(status), Failure::passing);
        }
    }

    // Opens the event stream.
    Opening open_events(std::uint64_t last_sequence) {
        auto const self = this->shared_from_this();
        if (notifications_) notifications_->close();
        auto const line = notifications_ = std::make_shared<Line>(loop_, context_.get());
        auto const problem = co_await connect(line->stream, beast::get_lowest_layer(line->stream), line->resolver, target_);
        if (!problem.empty()) {
            fail(problem, Failure::passing);
            co_return;
        }
        http::request<http::empty_body> request;
        request.method(http::verb::get);
        request.target(target_.path + "/notifications");
        set_common(request);
        request.set(http::field::accept, "text/event-stream");
        if (last_sequence > 0) request.set("Last-Event-ID", std::to_string(last_sequence));
        http::response_parser<http::buffer_body> parser;
        parser.body_limit(boost::none);
        error_code error;
        co_await http::async_write(line->stream, request, into(error));
        if (!error) co_await http::async_read_header(line->stream, line->incoming, parser, into(error));
        if (error) {
            fail("the event stream broke: " + error.message(), Failure::passing);
            co_return;
        }
        co_await read_events(line, parser);
    }

    // Reads the events or, if the status is not 200, the document of a fault.
    Opening read_events(std::shared_ptr<Line> line, http::response_parser<http::buffer_body>& parser) {
        bool const streams = parser.get().result() == http::status::ok;
        if (streams && listener_ != nullptr) listener_->attached();
        EventSource source;
        std::string fault;
        std::array<char, 16 * 1024> bytes{};
        error_code error;
        while (!parser.is_done() && !error && listener_ != nullptr) {
            watch_silence();
            parser.get().body() = {bytes.data(), bytes.size(), true};
            co_await http::async_read_some(line->stream, line->incoming, parser, into(error));
            if (error == http::error::need_buffer) error = {};
            std::string_view const came{bytes.data(), bytes.size() - parser.get().body().size};
            bool const fits = streams ? take(source, came) : fault.append(came).size() <= settings_.longest_document;
            if (!fits)
                fail("a document is longer than " + std::to_string(settings_.longest_document) + " bytes", Failure::passing);
        }
        if (!streams && !error && listener_ != nullptr) {
            listener_->document(fault);
        } else if (!error && !outgoing_.empty()) {
            stream_over_ = true;  // the session has ended: the answer under way gives the reason
        } else {
            fail(error ? "the event stream broke: " + error.message() : "the gateway closed the event stream", Failure::passing);
        }
    }

    bool take(EventSource& source, std::string_view came) {
        return source.take(came, settings_.longest_document, [this](std::string_view data) {
            if (listener_ != nullptr) listener_->document(data);
        });
    }

    void watch_silence() {
        loop_.cancel(silence_);
        silence_ = loop_.in(settings_.stream_silence, [this] { fail("the event stream is silent", Failure::passing); });
    }

    Loop& loop_;
    Target target_;
    Settings const& settings_;
    std::unique_ptr<asio::ssl::context> context_;
    SessionId session_;
    std::shared_ptr<Line> requests_;
    std::shared_ptr<Line> notifications_;
    std::deque<Document> outgoing_;  // the first one is being sent, or awaits its answer
    bool sending_ = false;
    bool stream_over_ = false;
    Loop::Ticket silence_ = 0;
};

}  // namespace rois::client
