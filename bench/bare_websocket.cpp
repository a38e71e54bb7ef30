// rois-bare-websocket PORT [THREADS]: a bare Boost.Beast echo server, the lower bound of the cost of a WebSocket: callbacks and a
// reused buffer.
#include "asio.hpp"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace rois::bench {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

class EchoSession : public std::enable_shared_from_this<EchoSession> {
public:
    explicit EchoSession(TcpSocket socket) : stream_{std::move(socket)} {
        stream_.auto_fragment(false);
        stream_.text(true);
    }

    void run() {
        stream_.async_accept([self = shared_from_this()](error_code error) {
            if (!error) self->read();
        });
    }

private:
    void read() {
        stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!error) self->write();
        });
    }

    void write() {
        stream_.async_write(buffer_.cdata(), [self = shared_from_this()](error_code error, std::size_t) {
            self->buffer_.consume(self->buffer_.size());
            if (!error) self->read();
        });
    }

    websocket::stream<TcpSocket, false> stream_;  // without deflate
    beast::flat_buffer buffer_;
};

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) return 2;
    return rois::bench::serve<rois::bench::EchoSession>(argv[1], argc == 3 ? std::strtoul(argv[2], nullptr, 10) : 1);
}
