// What a front serves: sessions, whoever answers in them (rois replay: a recording; rois record --listen: an engine).
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

// Who answers in one session. All on the front's thread.
class Guest {
public:
    virtual ~Guest() = default;

    // A request, as it stands and as it was read; `reply` takes the document that answers it, now or later, once.
    virtual void take(std::string const& document, std::variant<Request, Fault> const& read,
                      std::function<void(std::string)> reply) = 0;
};

// One session of an application: its guest, and what it was told.
class HostedSession {
public:
    explicit HostedSession(SessionId id) : id_{std::move(id)} {}

    SessionId const& id() const { return id_; }
    std::unique_ptr<Guest> guest;

    void tell(Notification const&);

    struct Numbered {
        std::uint64_t sequence;
        std::string document;
    };
    // The first one after this sequence; null when there is none.
    Numbered const* after(std::uint64_t sequence) const;
    std::uint64_t last() const { return last_; }

    // Goes on when something was told, the session has ended, somebody woke it, or the timer's time has come.
    asio::awaitable<void> told(asio::steady_timer& timer);
    void wake();

    void end();
    bool ended() const { return ended_; }

    // Links that hear; the last one to come is the one that counts for a WebSocket.
    int links = 0;
    std::uint64_t websocket = 0;
    std::chrono::steady_clock::time_point used = std::chrono::steady_clock::now();

private:
    SessionId id_;
    std::deque<Numbered> log_;
    std::uint64_t last_ = 0;
    bool ended_ = false;
    std::list<asio::steady_timer*> waiting_;
};

using MakeGuest = std::function<std::unique_ptr<Guest>(HostedSession&)>;

// All sessions. Those that nobody has used for some time end.
class Host {
public:
    Host(asio::io_context& io, MakeGuest make) : io_{io}, make_{std::move(make)} {}

    asio::io_context& io() { return io_; }
    std::shared_ptr<HostedSession> open();
    std::shared_ptr<HostedSession> find(std::string const& id) const;  // null when there is none
    void end(HostedSession&);
    void end_unused();
    void end_all();

private:
    asio::io_context& io_;
    MakeGuest make_;
    std::map<std::string, std::shared_ptr<HostedSession>> sessions_;
};

}  // namespace rois::command
