// The session in which a command acts: one of its own, that ends with it, or one that another process holds.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "command/caller.hpp"
#include "command/exit.hpp"
#include "command/inbox.hpp"
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
    // Waits until it is open. `recorded` may be null. Throws Trouble when it cannot be opened, NoSession when the one to join is
    // not there, std::invalid_argument for a URL that is none.
    // `caller` lives longer.
    Session(Options const&, std::shared_ptr<RecordingWriter> recorded, Caller const& caller);

    // Whether it goes on when the program ends.
    bool is_joined() const { return joined_; }
    SessionId id() const { return connection_.session(); }

    // Waits for the answer. Throws Trouble (no_answer) when there is none, NoSession if the joined session has ended.
    std::variant<Reply, Fault> request(Operation);

    // Any document as it stands, and its answer's. Throws Trouble like `request`.
    std::string send(std::string const& document);

    // The next one in the order of what happened; nothing at that time, after an interruption, and when the link has closed for
    // good. Who hears gives signs of life, which keep what the session moves going (docs/safety.md).
    std::optional<Heard> hear(Until until = {});

    // From any thread: ends the session if it is its own, and all that waits.
    void interrupt();
    bool interrupted() const { return interrupted_; }

private:
    Observers observers(std::shared_ptr<RecordingWriter> recorded);

    // Whose life keeps going what the session moves: that of this program; of whoever has called it, for a session that it holds
    // for others; or of somebody else, for those who only listen in another's session.
    enum class Life { own, of_caller, of_others };
    static Life whose_life(Options const&);
    bool is_alive() const;

    Life const life_;
    Caller const& caller_;
    bool const joined_;
    std::string const url_;
    bool const reports_attempts_;  // of a command that keeps trying
    std::string reported_;         // the last reason; on the client's thread
    std::atomic<bool> interrupted_ = false;
    Inbox<Heard> inbox_;  // filled on the client's thread
    Connection connection_;
};

// Settings of the client library.
Settings settings_of(Options const&);

}  // namespace rois::command
