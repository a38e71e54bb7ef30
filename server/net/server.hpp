// The gateway on the network: one port, one thread for each of its loops.
#pragma once

#include <memory>
#include <string>

#include "net/documents.hpp"
#include "net/gateway.hpp"
#include "net/settings.hpp"
#include "net/telemetry.hpp"

namespace rois::net {

class Server {
public:
    // Begins to listen. Throws std::runtime_error with one clear line when that cannot be. All that is given outlives the server.
    Server(Settings, Gateway&, Telemetry&, Documents const&, std::shared_ptr<xml::Schemas const>);
    ~Server();
    Server(Server const&) = delete;
    Server& operator=(Server const&) = delete;

    // "http://127.0.0.1:8080"
    std::string url() const;

    // Serves until SIGTERM or SIGINT: then clients are told, and cut when they do not go within the shutdown timeout. A second
    // signal cuts them at once.
    void run();

private:
    class Running;
    std::unique_ptr<Running> running_;
};

}  // namespace rois::net
