// The gateway on the network: one port, one thread for each of its loops.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/gateway.hpp"
#include "gateway/telemetry.hpp"
#include "net/documents.hpp"
#include "net/settings.hpp"

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

    // To be done after each SIGHUP, on one of the I/O threads; it throws nothing. Without it SIGHUP does what it usually does.
    // Before `run`.
    void on_hang_up(std::function<void()>);

    // What to do when too many exceptions escaped in a short time (docs/safety.md), instead of halting every component and ending
    // the process with 70. Called on any thread. Before `run`.
    void on_too_many_troubles(std::function<void()>);

    // Serves until SIGTERM or SIGINT: then clients are told, and cut when they do not go within the shutdown timeout. A second
    // signal cuts them at once. Returns whether all components have confirmed that they stand still.
    bool run();

private:
    class Running;
    std::unique_ptr<Running> running_;
};

}  // namespace rois::net
