// Includes and names of Boost.Asio and Beast. All of it runs on one thread with one io_context.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>

namespace rois::command {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

using Failure = boost::system::error_code;

// Completion token for co_await; stores the error in `failure`. g++ 12 miscompiles a co_await in the condition of a loop or an
// if: give the result a name first.
inline auto into(Failure& failure) { return asio::redirect_error(asio::use_awaitable, failure); }

}  // namespace rois::command
