// A server with the endpoints of an engine (HTTP, WebSocket, event streams) for the sessions of a Host. For development and
// tests.
#pragma once

#include <memory>
#include <string>

#include "command/recording/host.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::command {

class Front {
public:
    // `listen`: "HOST:PORT". Throws Trouble if it cannot listen there.
    Front(Host&, std::shared_ptr<xml::Schemas const>, std::string const& listen);
    ~Front();

    std::string const& url() const { return url_; }

    // Serves on this thread until `stop`.
    void run();
    // From any thread.
    void stop();

private:
    class Connection;

    asio::awaitable<void> accept();
    asio::awaitable<void> sweep();

    Host& host_;
    std::shared_ptr<xml::Schemas const> schemas_;
    asio::ip::tcp::acceptor acceptor_;
    asio::steady_timer sweeping_;
    std::string url_;
};

}  // namespace rois::command
