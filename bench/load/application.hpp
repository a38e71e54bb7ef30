// A connection that is prepared as the options require, perhaps with its own session.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "load/options.hpp"
#include "load/socket.hpp"

namespace rois::bench {

class Application {
public:
    // Connects, opens a session if the options require one, and sends the documents of `setup`. Throws std::runtime_error if an
    // answer is not OK.
    Application(Options const&, std::size_t number, std::vector<std::string> const& setup);

    Socket& socket() { return socket_; }
    std::string const& session() const { return session_; }

    // The bytes of a request or a frame with this document.
    std::string carried(std::string_view document) const;

    // Requests an event stream on this connection.
    void open_stream();

private:
    std::string ask(std::string_view document);

    Options const& options_;
    Socket socket_;
    std::string session_;
};

// Ends the sessions of these applications, over a separate connection.
void disconnect(Options const&, std::span<Application const>);

// Prepares as many applications as the options require. The options must outlive them.
std::vector<Application> make_applications(Options const&);

// With --announce, prints a line when everything is ready.
void announce(Options const&);

// Returns whether this document is a notification (otherwise an answer).
bool is_notification(std::string_view document);

}  // namespace rois::bench
