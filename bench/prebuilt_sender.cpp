// rois-prebuilt-sender PORT MESSAGE_BYTES: the lower bound of the cost of fan-out. Each WebSocket is a subscriber. When one of
// them sends a number, the server prepares that many frames once, and sends them to every other WebSocket in one write.
#include "asio.hpp"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <string>
#include <unordered_set>

namespace rois::bench {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

class Subscriber;

struct Everyone {
    std::size_t message_bytes = 0;
    std::unordered_set<Subscriber*> subscribers;
};

// A text frame with its time stamp in the form that the load generator reads.
std::string frame(std::size_t bytes) {
    using namespace std::chrono;
    auto payload = ">t" + std::to_string(duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count()) + "<";
    payload.resize(std::max<std::size_t>(bytes, 126), '.');
    std::string const head{'\x81', 126, static_cast<char>(payload.size() >> 8), static_cast<char>(payload.size() & 0xff)};
    return head + payload;
}

class Subscriber : public std::enable_shared_from_this<Subscriber> {
public:
    Subscriber(TcpSocket socket, Everyone& everyone) : stream_{std::move(socket)}, everyone_{everyone} {
        everyone_.subscribers.insert(this);
    }
    ~Subscriber() { everyone_.subscribers.erase(this); }
    Subscriber(Subscriber const&) = delete;
    Subscriber& operator=(Subscriber const&) = delete;

    void run() {
        stream_.async_accept([self = shared_from_this()](error_code error) {
            if (!error) self->read();
        });
    }

private:
    void read() {
        stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) return;
            auto const count = std::strtoul(beast::buffers_to_string(self->buffer_.cdata()).c_str(), nullptr, 10);
            self->buffer_.consume(self->buffer_.size());
            self->fire(count);
            self->read();
        });
    }

    void fire(std::size_t count) {
        std::string frames;
        auto const one = frame(everyone_.message_bytes);
        for (std::size_t i = 0; i < count; ++i) frames += one;
        for (auto* subscriber : everyone_.subscribers) {
            if (subscriber != this) subscriber->send(frames);
        }
    }

    // Subscribers are expected to read quickly: a partial write is an error.
    void send(std::string const& frames) {
        error_code error;
        auto const sent = stream_.next_layer().write_some(asio::buffer(frames), error);
        if (error || sent < frames.size()) stream_.next_layer().close(error);
    }

    websocket::stream<TcpSocket, false> stream_;
    beast::flat_buffer buffer_;
    Everyone& everyone_;
};

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    rois::bench::Everyone everyone;
    everyone.message_bytes = std::strtoul(argv[2], nullptr, 10);
    return rois::bench::serve<rois::bench::Subscriber>(argv[1], 1, everyone);
}
