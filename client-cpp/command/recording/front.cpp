#include "command/recording/front.hpp"

#include "command/exit.hpp"
#include "command/recording/front_connection.hpp"
#include "types/text/address.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

constexpr auto between_sweeps = std::chrono::seconds{5};
constexpr auto pause_when_full = std::chrono::milliseconds{50};

HostAndPort address_of(std::string const& text) {
    if (auto read = read_host_and_port(text)) return *std::move(read);
    throw Trouble{Exit::usage, "--listen must be HOST:PORT, such as 127.0.0.1:8080, not " + rois::quoted(text)};
}

asio::ip::tcp::acceptor listening(asio::io_context& io, HostAndPort const& address) {
    try {
        asio::ip::tcp::resolver resolver{io};
        auto const found = resolver.resolve(address.host, std::to_string(address.port));
        return asio::ip::tcp::acceptor{io, found.begin()->endpoint()};
    } catch (boost::system::system_error const& error) {
        throw Trouble{Exit::error,
                      "cannot listen on " + host_and_port(address.host, address.port) + ": " + error.code().message()};
    }
}

}  // namespace

Front::Front(Host& host, std::shared_ptr<xml::Schemas const> schemas, std::string const& listen)
    : host_{host}, schemas_{std::move(schemas)}, acceptor_{listening(host.io(), address_of(listen))}, sweeping_{host.io()} {
    auto const at = acceptor_.local_endpoint();
    url_ = "http://" + host_and_port(at.address().to_string(), at.port());
}

Front::~Front() = default;

void Front::run() {
    asio::co_spawn(host_.io(), accept(), asio::detached);
    asio::co_spawn(host_.io(), sweep(), asio::detached);
    host_.io().run();
}

void Front::stop() {
    asio::post(host_.io(), [this] {
        host_.end_all();
        host_.io().stop();
    });
}

asio::awaitable<void> Front::accept() {
    while (true) {
        Failure failure;
        auto socket = co_await acceptor_.async_accept(into(failure));
        if (failure == asio::error::operation_aborted) co_return;
        if (failure) {  // for example, too many open files
            asio::steady_timer pause{host_.io(), pause_when_full};
            co_await pause.async_wait(into(failure));
            continue;
        }
        auto const connection = std::make_shared<Connection>(*this, std::move(socket));
        asio::co_spawn(
            host_.io(), [connection] { return connection->run(); }, asio::detached);
    }
}

asio::awaitable<void> Front::sweep() {
    while (true) {
        sweeping_.expires_after(between_sweeps);
        Failure failure;
        co_await sweeping_.async_wait(into(failure));
        if (failure) co_return;
        host_.end_unused();
    }
}

}  // namespace rois::command
