// Boost.Asio types bound to the executor of the media thread's io_context.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/basic_datagram_socket.hpp>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>

namespace rois::media {

namespace asio = boost::asio;

using Clock = std::chrono::steady_clock;
using Executor = asio::io_context::executor_type;
using Socket = asio::basic_stream_socket<asio::ip::tcp, Executor>;
using Acceptor = asio::basic_socket_acceptor<asio::ip::tcp, Executor>;
using Datagrams = asio::basic_datagram_socket<asio::ip::udp, Executor>;
using Timer = asio::basic_waitable_timer<Clock, asio::wait_traits<Clock>, Executor>;

// A coroutine of the media thread. Do not write co_await inside the condition of a loop or an if: g++ 12 drops the code that
// follows. Give its result a name first.
template <class T = void>
using Task = asio::awaitable<T, Executor>;

// Completion token: the awaited operation stores its error in `error`.
inline auto into(boost::system::error_code& error) { return asio::redirect_error(asio::use_awaitable_t<Executor>{}, error); }

}  // namespace rois::media
