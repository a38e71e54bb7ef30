// Where a loop takes its connections from.
#pragma once

#include <boost/asio/basic_socket_acceptor.hpp>

#include "net/admission.hpp"
#include "net/asio.hpp"

namespace rois::net {

class Loop;

// Each loop listens on the same port (SO_REUSEPORT); the kernel divides the connections among them. Belongs to the thread of its
// loop once that runs.
class Listener {
public:
    using Endpoint = asio::ip::tcp::endpoint;

    Listener(Loop&, Admission&);

    // The first one has the port to itself, so that another process on it is found out, and then shares it with the others. Throw
    // boost::system::system_error.
    void bind_alone(Endpoint const&);
    void share();
    void bind_too(Endpoint const&);

    void listen();
    Executor executor() { return acceptor_.get_executor(); }
    Loop& loop() { return loop_; }
    Endpoint endpoint() const { return acceptor_.local_endpoint(); }

    // Until it is closed.
    Task<> accept();
    // From any thread.
    void close();

private:
    void open(Endpoint const&);
    Task<bool> accept_one();
    Task<std::optional<Admission::Place>> place(Socket&);
    void serve(Socket, Admission::Place);

    Loop& loop_;
    Admission& admission_;
    asio::basic_socket_acceptor<asio::ip::tcp, Executor> acceptor_;
    Timer pause_;
};

}  // namespace rois::net
