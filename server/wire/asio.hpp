// The types of Boost.Asio with the executor of an io_context.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>

namespace rois::net {

namespace asio = boost::asio;

using Executor = asio::io_context::executor_type;
using Socket = asio::basic_stream_socket<asio::ip::tcp, Executor>;
using Timer = asio::basic_waitable_timer<std::chrono::steady_clock, asio::wait_traits<std::chrono::steady_clock>, Executor>;

// A coroutine of one thread. Do not write co_await in the condition of a loop or an if: g++ 12 drops the code behind it. Give the
// result a name first.
template <class T = void>
using Task = asio::awaitable<T, Executor>;

// A completion token for co_await that sets `error` instead of throwing.
inline auto into(boost::system::error_code& error) { return asio::redirect_error(asio::use_awaitable_t<Executor>{}, error); }

}  // namespace rois::net
