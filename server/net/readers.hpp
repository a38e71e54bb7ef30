// Who reads the notifications of which session.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "engine/engine.hpp"

namespace rois::net {

// A connection that waits for the notifications of a session. Both calls come from any thread, with the engine locked: they
// only pass the word to the reader's own thread.
class Reader {
public:
    virtual ~Reader() = default;
    // There may be something to read, or another reader of the session has left.
    virtual void wake() = 0;
    // Another WebSocket goes on with the session.
    virtual void taken_over() = 0;
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
