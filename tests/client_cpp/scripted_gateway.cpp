#include "client_cpp/scripted_gateway.hpp"

#include <boost/asio.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>

namespace rois::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;

class ScriptedGateway::Inside {
public:
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    void accept() {
        cut();
        Tcp::socket line{io_};
        await("a connection", [&](auto done) { acceptor_.async_accept(line, done); });
        socket_.emplace(std::move(line));
        await("a WebSocket", [&](auto done) { socket_->async_accept(done); });
    }

    void cut() { socket_.reset(); }

    std::string read() {
        beast::flat_buffer bytes;
        await("a document", [&](auto done) { socket_->async_read(bytes, done); });
        return beast::buffers_to_string(bytes.cdata());
    }

    void write(std::string const& document) {
        await("the end of a write", [&](auto done) { socket_->async_write(asio::buffer(document), done); });
    }

    std::string received_name;
    std::string received_id;

private:
    struct Done {
        std::optional<Error>* outcome;
        void operator()(Error error, std::size_t = 0) const { *outcome = error; }
    };

    template <class Begin>
    void await(std::string const& what, Begin begin) {
        constexpr auto patience = std::chrono::seconds{20};
        std::optional<Error> outcome;
        begin(Done{&outcome});
        io_.restart();
        io_.run_for(patience);
        if (!outcome) throw std::runtime_error{"no event within 20 s: " + what};
        if (*outcome) throw std::runtime_error{"waited for " + what + ": " + outcome->message()};
    }

    asio::io_context io_;
    Tcp::acceptor acceptor_{io_, Tcp::endpoint{asio::ip::address_v4::loopback(), 0}};
    std::optional<beast::websocket::stream<Tcp::socket>> socket_;
};

namespace {

constexpr auto message = R"( xmlns="urn:x-rois:psm:xml:message:1" )";

std::string attribute(std::string const& name, std::string const& value) { return name + "=\"" + value + "\" "; }

}  // namespace

ScriptedGateway::ScriptedGateway() : inside_{std::make_unique<Inside>()} {}

ScriptedGateway::~ScriptedGateway() = default;

std::string ScriptedGateway::url() const { return "http://127.0.0.1:" + std::to_string(inside_->port()); }

void ScriptedGateway::accept() { inside_->accept(); }

void ScriptedGateway::cut() { inside_->cut(); }

std::string ScriptedGateway::receive(std::string const& operation) {
    auto document = inside_->read();
    pugi::xml_document tree;
    tree.load_string(document.c_str());
    auto const root = tree.document_element();
    if (root.name() != operation) throw std::runtime_error{"waited for " + operation + ": " + document};
    inside_->received_name = operation;
    inside_->received_id = root.attribute("request_id").value();
    return document;
}

void ScriptedGateway::answer(std::string const& content, std::string const& return_code) {
    auto const element = inside_->received_name + "_response";
    inside_->write("<" + element + message + attribute("return_code", return_code) +
                   attribute("request_id", inside_->received_id) + ">" + content + "</" + element + ">");
}

void ScriptedGateway::fault(std::string const& code) {
    inside_->write(std::string{"<fault"} + message + attribute("code", code) + attribute("request_id", inside_->received_id) +
                   "><reason>says the script</reason></fault>");
}

void ScriptedGateway::event(int sequence, std::string const& subscribe_id) {
    inside_->write(std::string{"<receive_event"} + message + attribute("sequence", std::to_string(sequence)) +
                   "><event_id>e-1</event_id><event_type>happened</event_type><subscribe_id>" + subscribe_id +
                   "</subscribe_id><expire>2026-11-22T12:40:19.001Z</expire><component_ref "
                   R"(xmlns:rois="http://www.omg.org/spec/RoIS/20240801" rois:code="c"/></receive_event>)");
}

void ScriptedGateway::switched(int sequence) {
    inside_->write(std::string{"<switched"} + message + attribute("sequence", std::to_string(sequence)) +
                   R"(><component_ref xmlns:rois="http://www.omg.org/spec/RoIS/20240801" rois:code="navigation"/>)"
                   "<from>robot1.navigation</from><to>robot2.navigation</to><reason>says the script</reason></switched>");
}

}  // namespace rois::test
