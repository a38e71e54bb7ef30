// rois-bare-client PORT DOCUMENT SECONDS [blocking]: a client written by hand for this one query: a prepared document, a
// WebSocket of Boost.Beast, and pugixml, which finds the return code and one value. With callbacks on one thread, or with
// blocking calls.
#include "asio.hpp"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <cstring>
#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>

#include "clients/round_trips.hpp"

namespace rois::bench {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::string_view connect = R"(<connect xmlns="urn:x-rois:psm:xml:message:1"/>)";

class BareClient {
public:
    BareClient(Setting const& setting, RoundTrips& trips) : query_{setting.document}, trips_{trips} {
        auto& socket = stream_.next_layer();
        socket.connect({asio::ip::address_v4::loopback(), setting.port});
        socket.set_option(Tcp::no_delay{true});
        stream_.set_option(websocket::stream_base::decorator(
            [](websocket::request_type& request) { request.set(beast::http::field::sec_websocket_protocol, "rois.xml.v1"); }));
        stream_.handshake("127.0.0.1", "/rois");
        stream_.auto_fragment(false);
        stream_.text(true);
        stream_.write(asio::buffer(connect));
        stream_.read(incoming_);
        incoming_.clear();
    }

    void ask_blocking() {
        do {
            stream_.write(asio::buffer(query_));
            stream_.read(incoming_);
            take_answer();
        } while (trips_.next());
    }

    void ask_with_callbacks() {
        // Pings when nothing is received, then a timeout, as the C++ client does.
        stream_.set_option(websocket::stream_base::timeout{std::chrono::seconds{5}, std::chrono::seconds{10}, true});
        write();
        io_.run();
    }

private:
    void write() {
        stream_.async_write(asio::buffer(query_), [this](error_code error, std::size_t) {
            if (error) throw boost::system::system_error{error};
            read();
        });
    }

    void read() {
        stream_.async_read(incoming_, [this](error_code error, std::size_t) {
            if (error) throw boost::system::system_error{error};
            take_answer();
            if (trips_.next()) {
                write();
            } else {
                io_.stop();
            }
        });
    }

    void take_answer() {
        auto const bytes = incoming_.data();
        auto const parsed = answer_.load_buffer_inplace(bytes.data(), bytes.size());
        auto const reply = answer_.document_element();
        if (!parsed || std::strcmp(reply.attribute("return_code").value(), "OK") != 0)
            throw std::runtime_error("the answer's return_code is not OK");
        auto const status = reply.child("results").find_child_by_attribute("result", "rois:name", "status");
        if (std::strcmp(status.child_value("rois:value"), "READY") != 0)
            throw std::runtime_error("the answer's result 'status' is not READY");
        incoming_.clear();
    }

    std::string const query_;
    RoundTrips& trips_;
    asio::io_context io_{1};
    websocket::stream<TcpSocket, false> stream_{io_.get_executor()};  // without deflate
    beast::flat_buffer incoming_;
    pugi::xml_document answer_;
};

void measure(Setting const& setting, RoundTrips& trips) {
    BareClient client{setting, trips};
    if (setting.blocking) {
        client.ask_blocking();
    } else {
        client.ask_with_callbacks();
    }
}

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) { return rois::bench::measure_round_trips(argc, argv, rois::bench::measure); }
