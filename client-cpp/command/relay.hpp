// Passes what an application says on to an engine, and back, and writes it down.
#pragma once

#include <memory>
#include <string>

#include "command/host.hpp"
#include "command/recording.hpp"
#include "rois/connection.hpp"

namespace rois::command {

class Relay : public Guest {
public:
    // `session` is what the recording calls it.
    Relay(asio::io_context&, HostedSession&, Settings, std::shared_ptr<RecordingWriter>, std::string session);
    ~Relay() override;

    void take(std::string const& document, std::variant<Request, Fault> const& read,
              std::function<void(std::string)> reply) override;

private:
    // Where the client's thread finds the session, as long as it is there.
    struct Door;

    asio::io_context& io_;
    std::shared_ptr<Door> door_;
    Connection connection_;
};

}  // namespace rois::command
