// Who reads the notifications of which session.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

#include "engine/engine.hpp"

namespace rois::net {

class Wakes;

// A connection that waits for the notifications of a session. Always held by a shared_ptr.
class Reader : public std::enable_shared_from_this<Reader> {
public:
    explicit Reader(Wakes& wakes) : wakes_{wakes} {}
    virtual ~Reader() = default;
    Reader(Reader const&) = delete;
    Reader& operator=(Reader const&) = delete;

    // Both come from any thread, with the engine locked: they only pass the word to the reader's own thread.
    // There may be something to read, or another reader of the session has left.
    void wake();
    // Another WebSocket goes on with the session.
    void take_over();

protected:
    Wakes& wakes() { return wakes_; }

private:
    friend class Wakes;
    void serve();

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
    // A WebSocket that joins takes over from one that is there.
    void join(SessionId const&, Link, Reader&);
    void leave(SessionId const&, Reader const&);
    std::size_t count(SessionId const&) const;

    void notify(SessionId const&) override;

private:
    struct Joined {
        Link link;
        Reader* reader;
    };
    std::unordered_map<SessionId, std::vector<Joined>, IdHash> readers_;
};

}  // namespace rois::net
