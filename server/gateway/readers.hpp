// The readers of each session's notifications.
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

    // Both are called on any thread, with the engine locked. They only queue the reader for its own thread.
    // Something may have arrived, or another reader of the session has left. Does nothing while the reader is being destroyed.
    void wake() noexcept;
    // Another WebSocket has taken over the session.
    void take_over() noexcept;

protected:
    // The memory that `woken` needs: `far` is what the reader points to, `near` what lies behind that.
    enum class Distance : std::uint8_t { far, near };

    Wakes& wakes() { return wakes_; }

private:
    friend class Wakes;
    void serve();

    // Prefetches that memory.
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
    // When the reader leaves: a long poll leaves when it is answered.
    enum class Until : std::uint8_t { answered, closed };
    // A WebSocket that joins takes over from the session's earlier one. If it throws, the reader has not joined.
    void join(NotificationQueue&, Link, Reader&, Until = Until::closed);
    // Joins an ended session, to see when the other readers leave.
    void join(SessionId const&, Reader&);
    void leave(SessionId const&, Reader const&);
    std::size_t count(SessionId const&) const;
    // The number of event streams that read this queue.
    static std::size_t streams(NotificationQueue const&);

    void notify(NotificationQueue&) override;
    void approach(NotificationQueue const&) const override;

private:
    std::shared_ptr<Audience> const& audience_with_room(SessionId const&, std::shared_ptr<Audience> const& known);

    std::unordered_map<SessionId, std::shared_ptr<Audience>, IdHash> audiences_;  // only sessions with a reader
};

}  // namespace rois
