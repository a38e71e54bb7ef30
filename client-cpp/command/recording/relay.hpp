// Passes documents between an application and an engine, and records them.
#pragma once

#include <memory>
#include <string>

#include "command/recording/host.hpp"
#include "command/recording/recording.hpp"
#include "rois/connection.hpp"

namespace rois::command {

class Relay : public Guest {
public:
    // `session`: its name in the recording.
    Relay(asio::io_context&, HostedSession&, Settings, std::shared_ptr<RecordingWriter>, std::string session);
    ~Relay() override;

    void take(std::string const& document, std::variant<Request, Fault> const& read,
              std::function<void(std::string)> reply) override;

private:
    // The session for functions posted by the client's thread; its pointer is null after the relay has ended.
    struct Door;

    asio::io_context& io_;
    std::shared_ptr<Door> door_;
    Connection connection_;
};

}  // namespace rois::command
