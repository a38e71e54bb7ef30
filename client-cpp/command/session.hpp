// The session in which a command acts: one of its own, that ends with it, or one that another process holds.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "command/exit.hpp"
#include "command/options.hpp"
#include "command/recording.hpp"
#include "rois/connection.hpp"

namespace rois::command {

// What the engine tells on its own, and what becomes of the link.
struct News {
    Notification notification;
    std::uint64_t sequence = 0;
};
using Heard = std::variant<News, StateChange, Gap>;

using Until = std::optional<std::chrono::steady_clock::time_point>;  // none: for ever

class Session {
public:
    virtual ~Session() = default;

    // Whether it goes on when the program ends.
    virtual bool is_joined() const = 0;
    virtual SessionId id() const = 0;

    // Waits for the answer. Throws Trouble (no_answer) when there is none.
    std::variant<Reply, Fault> request(Operation);

    // Any document as it stands, and its answer's. Throws Trouble like `request`.
    virtual std::string send(std::string const& document) = 0;

    // The next one in the order of what happened; nothing at that time, after an interruption, and when the link has closed for
    // good.
    virtual std::optional<Heard> hear(Until = {}) = 0;

    // From any thread: ends the session if it is its own, and all that waits.
    void interrupt();
    bool interrupted() const { return interrupted_; }

protected:
    virtual Answer answer(Request) = 0;
    virtual void end_waiting() = 0;

private:
    std::atomic<bool> interrupted_ = false;
};

// Waits until it is open. `recorded` may be null. Throws Trouble.
std::unique_ptr<Session> open_session(Options const&, std::shared_ptr<RecordingWriter> recorded);

// Settings of the client library.
Settings settings_of(Options const&);

// Both are made by open_session.
std::unique_ptr<Session> own_session(Options const&, std::shared_ptr<RecordingWriter> recorded);
std::unique_ptr<Session> joined_session(Options const&);

}  // namespace rois::command
