#include "net/health_check.hpp"

#include "net/asio.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/asio/write.hpp>

namespace rois::net {

namespace {

constexpr auto longest = std::chrono::seconds{2};

// Who listens everywhere is asked on the loopback.
std::string reachable(std::string const& host) {
    if (host == "0.0.0.0") return "127.0.0.1";
    if (host == "::") return "::1";
    return host;
}

Task<> ask(std::string host, std::uint16_t port, std::string& trouble) {
    Executor const executor = co_await asio::this_coro::executor;
    boost::system::error_code error;
    asio::ip::basic_resolver<asio::ip::tcp, Executor> resolver{executor};
    auto const found = resolver.resolve(host, std::to_string(port), error);
    if (error || found.empty()) {
        trouble = "unknown host " + host;
        co_return;
    }
    Socket socket{executor};
    co_await socket.async_connect(found.begin()->endpoint(), into(error));
    std::string const request = "GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    if (!error) co_await asio::async_write(socket, asio::buffer(request), into(error));
    std::string answer;
    if (!error) co_await asio::async_read_until(socket, asio::dynamic_buffer(answer, 16 * 1024), "\r\n", into(error));
    trouble = error ? error.message() : answer.starts_with("HTTP/1.1 200 ") ? "" : "unexpected answer";
}

}  // namespace

std::string check_health(std::string const& host, std::uint16_t port) {
    std::string trouble = "no answer within two seconds";
    asio::io_context io{1};
    asio::co_spawn(io, ask(reachable(host), port, trouble), asio::detached);
    io.run_for(longest);
    return trouble;
}

}  // namespace rois::net
