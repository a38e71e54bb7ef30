// The session of a command: its own, which ends with it, or one that another process holds.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "command/exit.hpp"
#include "command/inbox.hpp"
#include "command/options.hpp"
#include "command/recording/recording.hpp"
#include "command/session/caller.hpp"
#include "rois/connection.hpp"

namespace rois::command {

// A notification of the engine.
struct News {
    Notification notification;
    std::uint64_t sequence = 0;
};

// A notification, or a change of the connection.
using Update = std::variant<News, StateChange, Gap>;

using Until = std::optional<std::chrono::steady_clock::time_point>;  // empty: no limit

class Session {
public:
    // Waits until the session is open. `recorded` may be null; `caller` must outlive it. Throws Trouble if it cannot be opened,
    // NoSession if the session to join does not exist, std::invalid_argument if the URL is invalid.
    Session(Options const&, std::shared_ptr<RecordingWriter> recorded, Caller const& caller);

    // Whether another process holds the session. Then the session does not end with this program.
    bool is_joined() const { return joined_; }
    SessionId id() const { return connection_.session(); }

    // Waits for the answer. Throws Trouble (no_answer) if there is none, NoSession if the joined session has ended.
    std::variant<Reply, Fault> request(Operation);

    // Sends a document unchanged, and returns the document that answers it. Throws Trouble like `request`.
    std::string send(std::string const& document);

    // Waits for the next update. Returns nothing at the time `until`, after `interrupt`, and when the connection has closed.
    // Gives signs of life meanwhile, so that robots of the session may move on (docs/safety.md).
    std::optional<Update> next_update(Until until = {});

    // From any thread: ends all waiting calls, and the session if it is not joined.
    void interrupt();
    bool interrupted() const { return interrupted_; }

private:
    Observers observers(std::shared_ptr<RecordingWriter> recorded);

    // The process that gives the signs of life for the robots of the session. `own`: this program. `of_caller`: the caller of
    // this program, which holds the session for other commands (`bind`). `of_others`: another process; this program only listens
    // in a joined session.
    enum class Life { own, of_caller, of_others };
    static Life whose_life(Options const&);
    bool is_alive() const;

    Life const life_;
    Caller const& caller_;
    bool const joined_;
    std::string const url_;
    bool const reports_attempts_;  // if it retries without end
    std::string reported_;         // the last reason; for the client's thread
    std::atomic<bool> interrupted_ = false;
    Inbox<Update> inbox_;  // filled on the client's thread
    Connection connection_;
};

// Settings of the client library.
Settings settings_of(Options const&);

}  // namespace rois::command
