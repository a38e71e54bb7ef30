// A connection that has been prepared as the options say: perhaps with a session of its own.
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
    // Connects, opens a session when the options want one, and sends the documents of `setup`. Throws when an answer says that
    // something went wrong.
    Application(Options const&, std::size_t number, std::vector<std::string> const& setup);

    Socket& socket() { return socket_; }
    std::string const& session() const { return session_; }

    // The bytes that carry a document to the server.
    std::string carried(std::string_view document) const;

    // Becomes an event stream.
    void open_stream();

private:
    std::string ask(std::string_view document);

    Options const& options_;
    Socket socket_;
    std::string session_;
};

// Ends their sessions, on a connection of its own.
void disconnect(Options const&, std::span<Application const>);

// Prepares as many as the options say. The options must outlive them.
std::vector<Application> make_applications(Options const&);

// When that is wanted, says on a line of its own that all is ready.
void announce(Options const&);

// Whether this is no answer but something the engine tells on its own.
bool is_notification(std::string_view document);

}  // namespace rois::bench
