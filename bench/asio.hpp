// Boost.Asio with the concrete executor of one thread's io_context, for the servers that the gateway is compared with.
#pragma once

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

namespace rois::bench {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using Executor = asio::io_context::executor_type;
using TcpSocket = asio::basic_stream_socket<Tcp, Executor>;
using Acceptor = asio::basic_socket_acceptor<Tcp, Executor>;
using boost::system::error_code;

// Accepts connections. Makes a Session of each socket and calls its `run`.
template <class Session, class... Shared>
void accept_for_ever(Acceptor& acceptor, Shared&... shared) {
    acceptor.async_accept([&](error_code error, TcpSocket socket) {
        if (!error) {
            error_code ignored;
            socket.set_option(Tcp::no_delay{true}, ignored);
            socket.non_blocking(true, ignored);
            std::make_shared<Session>(std::move(socket), shared...)->run();
        }
        accept_for_ever<Session>(acceptor, shared...);
    });
}

// Serves on 127.0.0.1 until it is killed. Each thread has an io_context of its own and an acceptor on the same port.
template <class Session, class... Shared>
int serve(char const* port, std::size_t threads, Shared&... shared) {
    Tcp::endpoint const here{asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(std::strtoul(port, nullptr, 10))};
    auto const run = [&] {
        asio::io_context io{1};
        Acceptor acceptor{io.get_executor(), here.protocol()};
        int const on = 1;
        ::setsockopt(acceptor.native_handle(), SOL_SOCKET, SO_REUSEPORT, &on, sizeof on);
        acceptor.bind(here);
        acceptor.listen(4'096);
        accept_for_ever<Session>(acceptor, shared...);
        io.run();
    };
    std::vector<std::jthread> others;
    while (others.size() + 1 < threads) others.emplace_back(run);
    run();
    return 0;
}

}  // namespace rois::bench
