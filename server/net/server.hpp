// Serves the gateway on one port, with one thread for each event loop.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"
#include "net/http/documents.hpp"
#include "net/settings.hpp"

namespace rois::net {

// Not thread-safe, except the URLs, `connect` and `use`: call all other functions on the thread that made the server. `run`
// blocks that thread, which is then the first I/O thread; the server owns the others.
class Server {
public:
    // Starts to listen. Throws std::runtime_error with a message for the user if the port is not free. All arguments must outlive
    // the server.
    Server(Settings, Gateway&, Telemetry&, Documents const&, std::shared_ptr<xml::Schemas const>);
    ~Server();
    Server(Server const&) = delete;
    Server& operator=(Server const&) = delete;

    // "http://127.0.0.1:8080", or with https
    std::string url() const;

    // Where programs that this process starts join, on the loopback and without TLS: "http://127.0.0.1:40123". They need one of
    // Settings::program_tokens. Call it only if there are such tokens.
    std::string url_for_programs() const;

    // Returns a socket that is connected to this server, without TLS and from within the process. Thread-safe. Throws
    // std::runtime_error if there are too many connections.
    UniqueDescriptor connect();

    // Sets the function to call after each SIGHUP, on an I/O thread. It must return at once and not throw. If none is set, SIGHUP
    // ends the process. Call this before `run`.
    void on_hang_up(std::function<void()>);

    // From now on, uses what can change while it runs (with_changes). Thread-safe, but only one thread may call it.
    void use(Settings const&);

    // Sets the function to call after too many exceptions (docs/safety.md), on any thread. By default, all components halt and
    // the process ends with 70. Call this before `run`.
    void on_too_many_troubles(std::function<void()>);

    // Serves until SIGTERM or SIGINT. Then notifies the clients, and cuts the connections that are still open after the shutdown
    // timeout, or at a second signal. Returns whether all components have confirmed that they stand still.
    bool run();

private:
    class Running;
    std::unique_ptr<Running> running_;
};

}  // namespace rois::net
