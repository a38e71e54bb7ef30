// Accepts the connections of one event loop.
#pragma once

#include <boost/asio/basic_socket_acceptor.hpp>
#include <optional>

#include "gateway/access/admission.hpp"
#include "net/loop.hpp"
#include "wire/asio.hpp"

namespace rois::net {

// All loops listen on the same port (SO_REUSEPORT), and the kernel distributes the connections. Belongs to the thread of its loop
// when the loop runs.
class Listener {
public:
    using Endpoint = asio::ip::tcp::endpoint;

    Listener(Loop&, Admission&, Loop::From);

    // The first listener binds the port alone, which fails if another process uses it. Then it shares the port, so that the other
    // listeners can bind it too. Both throw boost::system::system_error.
    enum class Port : unsigned char { alone, shared };
    void bind(Endpoint const&, Port);
    void share_port();

    void listen();
    Executor executor() { return acceptor_.get_executor(); }
    Loop& loop() { return loop_; }
    Endpoint endpoint() const { return acceptor_.local_endpoint(); }

    // Runs until `close`.
    Task<> accept();
    // Thread-safe.
    void close();

private:
    Task<bool> accept_waiting();
    Task<std::optional<Admission::Place>> place(Socket&);
    void serve(Socket, Admission::Place);
    Task<> pause(std::chrono::milliseconds);

    Loop& loop_;
    Admission& admission_;
    Loop::From const from_;
    asio::basic_socket_acceptor<asio::ip::tcp, Executor> acceptor_;
    Timer timer_;
};

}  // namespace rois::net
