// rois-bare-http PORT ANSWER_BYTES [THREADS]: a bare Boost.Beast server, the lower bound of the cost of HTTP with keep-alive:
// callbacks, reused buffers, the fields of a message in an arena. Reads the request's body and sends ANSWER_BYTES constant bytes.
#include "asio.hpp"

#include <array>
#include <boost/beast/core/flat_static_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <cstddef>
#include <memory_resource>
#include <optional>
#include <string>

namespace rois::bench {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

using Fields = http::basic_fields<std::pmr::polymorphic_allocator<char>>;
using Body = http::span_body<char>;
using Parser = http::request_parser<Body, Fields::allocator_type>;
using Answer = http::response<http::span_body<char const>, Fields>;

class HttpSession : public std::enable_shared_from_this<HttpSession> {
public:
    HttpSession(TcpSocket socket, std::string const& answer) : socket_{std::move(socket)}, answer_body_{answer} {}

    void run() {
        answer_.reset();
        parser_.reset();
        arena_.release();
        parser_.emplace(std::piecewise_construct, std::make_tuple(), std::make_tuple(Fields::allocator_type{&arena_}));
        parser_->get().body() = {body_.data(), body_.size()};
        http::async_read(socket_, input_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!error) self->answer();
        });
    }

private:
    void answer() {
        answer_.emplace(std::piecewise_construct, std::make_tuple(),
                        std::make_tuple(http::status::ok, 11U, Fields::allocator_type{&arena_}));
        answer_->set(http::field::content_type, "application/xml");
        answer_->set(http::field::cache_control, "no-store");
        answer_->body() = {answer_body_.data(), answer_body_.size()};
        answer_->prepare_payload();
        http::async_write(socket_, *answer_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!error) self->run();
        });
    }

    TcpSocket socket_;
    std::string const& answer_body_;
    std::array<std::byte, 4 * 1024> memory_{};
    std::pmr::monotonic_buffer_resource arena_{memory_.data(), memory_.size()};
    beast::flat_static_buffer<8 * 1024> input_;
    std::array<char, 64 * 1024> body_{};
    std::optional<Parser> parser_;
    std::optional<Answer> answer_;
};

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) return 2;
    std::string const answer(std::strtoul(argv[2], nullptr, 10), 'x');
    return rois::bench::serve<rois::bench::HttpSession>(argv[1], argc == 4 ? std::strtoul(argv[3], nullptr, 10) : 1, answer);
}
