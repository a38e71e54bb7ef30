// The readers of each session's notifications.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/engine.hpp"

namespace rois {

class Wakes;

// A connection that waits for the notifications of a session. Always held by a shared_ptr.
class Reader : public std::enable_shared_from_this<Reader> {
public:
    // Call it on the thread of the loop.
    explicit Reader(Wakes&);
    virtual ~Reader();
    Reader(Reader const&) = delete;
    Reader& operator=(Reader const&) = delete;

    // Thread-safe: both functions queue the reader on its own loop. They do nothing while the reader is being destroyed.
    // Call `wake` when there may be notifications, or when another reader of the session has left.
    void wake() noexcept;
    // Call `take_over` when another WebSocket has taken over the session.
    void take_over() noexcept;

protected:
    Wakes& wakes() { return wakes_; }

private:
    friend class Readers;
    friend class Wakes;
    bool line_up() noexcept;
    void serve();

    // Called on the reader's own thread.
    virtual void woken() = 0;
    virtual void taken_over() {}

    Wakes& wakes_;
    std::atomic<bool> waiting_ = false;  // in the queue
    std::atomic<bool> taken_over_ = false;
};

// Tells a connection that an answer has come. The thread that has the answer may drop the last reference to the waker, with the
// engine locked. So `answer_came` may hold only a weak reference to the connection, which must end on its own thread.
class Waker final : public Reader {
public:
    // `answer_came` is called on the loop's thread.
    Waker(Wakes& wakes, std::function<void()> answer_came) : Reader{wakes}, answer_came_{std::move(answer_came)} {}

private:
    void woken() override { answer_came_(); }

    std::function<void()> answer_came_;
};

// The engine's outbox: wakes the readers of a session. Guarded by the gateway's mutex, as the engine is.
//
// `notify` queues the readers, and `flush` then wakes each of their loops once. If `notify` woke a loop, the loop would often
// serve that one reader while the engine notifies the next one, and be woken again for each subscriber. The row of `./dev bench`
// with the events of a sub engine then had 105,000 context switches instead of 6,000.
class Readers : public Outbox {
public:
    // When the reader leaves: a long poll leaves when it is answered.
    enum class Until : std::uint8_t { answered, closed };
    // A WebSocket that joins takes over from the session's earlier one. If it throws, the reader has not joined.
    void join(NotificationQueue const&, LinkKind, Reader&, Until = Until::closed);
    // Joins an ended session, to see when the other readers leave.
    void join(SessionId const&, Reader&);
    void leave(SessionId const&, Reader const&);
    std::size_t count(SessionId const&) const;
    std::size_t streams(SessionId const&) const;  // event streams

    void notify(NotificationQueue&) override;
    void flush() noexcept override;

private:
    struct Joined {
        LinkKind link;
        Reader* reader;
        Until until;
    };
    std::vector<Joined>& with_room(SessionId const&);

    std::unordered_map<SessionId, std::vector<Joined>, IdHash> joined_;  // of sessions with a reader
    Wakes* to_wake_ = nullptr;                                           // by `flush`: the first one, which knows the next
};

}  // namespace rois
