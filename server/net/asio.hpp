// The types of Boost.Asio that are used here, all with the concrete executor of one I/O thread's io_context.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/basic_stream_descriptor.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>

namespace rois::net {

namespace asio = boost::asio;

using Executor = asio::io_context::executor_type;
using Socket = asio::basic_stream_socket<asio::ip::tcp, Executor>;
using Descriptor = asio::posix::basic_stream_descriptor<Executor>;
using Timer = asio::basic_waitable_timer<std::chrono::steady_clock, asio::wait_traits<std::chrono::steady_clock>, Executor>;

// A coroutine of one thread. g++ 12 miscompiles a co_await inside the condition of a loop or an if (it drops what follows):
// give its result a name first.
template <class T = void>
using Task = asio::awaitable<T, Executor>;

// Completion token: await it, and find the error in `error`.
inline auto into(boost::system::error_code& error) { return asio::redirect_error(asio::use_awaitable_t<Executor>{}, error); }

}  // namespace rois::net
