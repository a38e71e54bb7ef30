// The sessions that a Front serves. Each has a Guest that answers its requests: a recording (rois replay) or an engine (rois
// record --listen).
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <variant>

#include "command/asio.hpp"
#include "types/messages.hpp"

namespace rois::command {

// Answers the requests of one session. For the front's thread.
class Guest {
public:
    virtual ~Guest() = default;

    // Takes a request, as text and decoded. Calls `reply` once with the document that answers it, now or later.
    virtual void take(std::string const& document, std::variant<Request, Fault> const& read,
                      std::function<void(std::string)> reply) = 0;
};

// One session of an application: its guest and its notifications.
class HostedSession {
public:
    explicit HostedSession(SessionId id) : id_{std::move(id)} {}

    SessionId const& id() const { return id_; }
    std::unique_ptr<Guest> guest;

    void notify(Notification const&);

    struct Numbered {
        std::uint64_t sequence;
        std::string document;
    };
    // Returns the first notification after this sequence, or null.
    Numbered const* after(std::uint64_t sequence) const;
    std::uint64_t last() const { return last_; }

    // Waits for a notification, the end of the session, a call of `wake`, or the timer.
    asio::awaitable<void> wait(asio::steady_timer& timer);
    void wake();

    void end();
    bool ended() const { return ended_; }

    int connections = 0;          // connections that receive the notifications
    std::uint64_t websocket = 0;  // number of the WebSocket that has the session; the latest one takes it over
    std::chrono::steady_clock::time_point used = std::chrono::steady_clock::now();

private:
    SessionId id_;
    std::deque<Numbered> log_;
    std::uint64_t last_ = 0;
    bool ended_ = false;
    std::list<asio::steady_timer*> waiting_;
};

using MakeGuest = std::function<std::unique_ptr<Guest>(HostedSession&, Connect const&)>;

// All sessions. Ends those that were not used for some time.
class Host {
public:
    Host(asio::io_context& io, MakeGuest make) : io_{io}, make_{std::move(make)} {}

    asio::io_context& io() { return io_; }
    std::shared_ptr<HostedSession> open(Connect const&);
    std::shared_ptr<HostedSession> find(std::string const& id) const;  // null if there is none
    void end(HostedSession&);
    void end_unused();
    void end_all();

private:
    asio::io_context& io_;
    MakeGuest make_;
    std::map<std::string, std::shared_ptr<HostedSession>> sessions_;
};

}  // namespace rois::command
