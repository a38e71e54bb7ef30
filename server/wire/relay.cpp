#include "wire/relay.hpp"

#include <array>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/write.hpp>
#include <memory>
#include <string_view>

namespace rois::net {

namespace {

constexpr std::size_t most_at_once = 16 * 1024;  // bytes, as in a record of TLS

Task<> pass_in(Wire& wire, LocalSocket& inside) {
    boost::system::error_code error;
    auto outcome = Wire::Outcome::done;
    while (!error && outcome == Wire::Outcome::done) {
        outcome = co_await wire.receive(Steady::max());
        co_await asio::async_write(inside, asio::buffer(wire.text()), into(error));
        wire.use(wire.text().size());
    }
    inside.close(error);
}

Task<> pass_out(Wire& wire, LocalSocket& inside) {
    boost::system::error_code error;
    auto outcome = Wire::Outcome::done;
    auto const buffer = std::make_unique<std::array<char, most_at_once>>();
    while (outcome == Wire::Outcome::done) {
        auto const size = co_await inside.async_read_some(asio::buffer(*buffer), into(error));
        if (error) break;
        std::string_view const piece{buffer->data(), size};
        outcome = co_await wire.send(piece);
    }
    wire.cut();
}

}  // namespace

Task<> relay(Wire& wire, LocalSocket& inside) {
    using asio::experimental::awaitable_operators::operator&&;
    co_await (pass_in(wire, inside) && pass_out(wire, inside));
}

}  // namespace rois::net
