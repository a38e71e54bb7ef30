// Who reads the notifications of which session.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "engine/engine.hpp"

namespace rois {

class Wakes;

// A connection that waits for the notifications of a session. Always held by a shared_ptr.
class Reader : public std::enable_shared_from_this<Reader> {
public:
    // On the thread of its loop.
    explicit Reader(Wakes&);
    virtual ~Reader();
    Reader(Reader const&) = delete;
    Reader& operator=(Reader const&) = delete;

    // Both come from any thread, with the engine locked: they only pass the word to the reader's own thread.
    // There may be something to read, or another reader of the session has left. A reader that is on its way out is not woken.
    void wake() noexcept;
    // Another WebSocket goes on with the session.
    void take_over() noexcept;

protected:
    // How far it is to what `woken` needs: what the reader itself points to, and what lies behind that.
    enum class Distance : std::uint8_t { far, near };

    Wakes& wakes() { return wakes_; }

private:
    friend class Wakes;
    void serve();

    // Prefetches that.
    virtual void approach(Distance) const {}

    // On the reader's own thread.
    virtual void woken() = 0;
    virtual void taken_over() {}

    Wakes& wakes_;
    std::atomic<bool> waiting_ = false;  // to be served
    std::atomic<bool> taken_over_ = false;
};

// The engine's outbox: wakes the readers of a session. Guarded by the gateway's mutex, as the engine is.
class Readers : public Outbox {
public:
    // Until when the reader is there: a long poll until its answer.
    enum class Until : std::uint8_t { answered, closed };
    // A WebSocket that joins takes over from one that is there. If it throws, nobody has joined.
    void join(NotificationQueue&, Link, Reader&, Until = Until::closed);
    // The same for a session that has ended: to see how the others leave.
    void join(SessionId const&, Reader&);
    void leave(SessionId const&, Reader const&);
    std::size_t count(SessionId const&) const;
    // How many event streams read this queue.
    static std::size_t streams(NotificationQueue const&);

    void notify(NotificationQueue&) override;
    void approach(NotificationQueue const&) const override;

private:
    std::shared_ptr<Audience> const& audience_with_room(SessionId const&, std::shared_ptr<Audience> const& known);

    std::unordered_map<SessionId, std::shared_ptr<Audience>, IdHash> audiences_;  // that somebody is in
};

}  // namespace rois
