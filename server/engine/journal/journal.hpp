// What the engine stores, so that nothing that it has acknowledged is lost when the process dies (docs/journal.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/notifications/notification_queue.hpp"
#include "types/codes.hpp"
#include "types/ids.hpp"
#include "types/instant.hpp"
#include "types/messages.hpp"

namespace rois {

struct StoredBinding {
    std::string ref;
    Switching switching = Switching::none;
    std::shared_ptr<QueryExpression const> preference{};  // the condition of `bind_any`, for a logical component
    ParameterList parameters{};                           // as set by the session; empty: the defaults
    bool is_asked = false;                                // not stored: the component was asked to confirm it
};

// `session` is the number of the session in all records.
struct StoredSession {
    std::uint64_t session = 0;
    SessionId id;
    std::string rights;  // Rights::id; empty: no limits
    std::chrono::milliseconds window{};
    std::chrono::milliseconds lease{};
    std::chrono::milliseconds lease_http{};
    bool links_count = true;  // MotionLease::Terms
    bool is_engine = false;
    bool receives_switches = false;
    std::uint64_t last_stop = 0;
    bool owns_stop = false;
    std::vector<StoredBinding> bindings;
};

struct StoredSubscription {
    std::uint64_t session = 0;
    SubscribeId id;
    Subscribe asked;
};

struct StoredCommand {
    std::uint64_t session = 0;
    CommandId id;
    std::string type;
    std::string ref;  // of its component
    // Of a component of a sub engine: its provider, and the handle by which that engine knows the command.
    std::string provider{};
    std::uint64_t handle = 0;
    struct End {
        CompletedStatus status = CompletedStatus::ok;
        std::string reason{};
        Results results{};
        Utc at;
        bool notified = false;  // its `completed` is stored, too
    };
    std::optional<End> end{};  // nullopt: it waits or runs
};

struct StoredNotification {
    std::uint64_t session = 0;
    Numbered numbered;
};

// The state of the engine itself. New ids continue after the last ones, so that none is given twice.
struct StoredEngine {
    std::uint64_t last_session = 0;
    std::uint64_t last_subscription = 0;
    std::uint64_t last_command = 0;
    std::uint64_t last_handle = 0;
    std::uint64_t next_event = 1;
    std::uint64_t next_error = 1;
    bool is_stopped = false;  // everything (decision 34)
    std::uint64_t last_stop = 0;
    std::vector<std::string> ended_owners{};              // of that stop, which they have not cleared
    std::map<std::string, std::string> sessions_there{};  // of this engine in its sub engines, by provider
    std::map<std::string, std::uint64_t> stops_there{};   // that it has to clear there, by provider
};

// Changes that are stored in one step: all of them or none.
struct Changes {
    struct Gone {
        std::uint64_t session = 0;
        std::string id;
    };
    struct Forgotten {
        std::uint64_t session = 0;
        std::uint64_t from = 0;  // sequences of notifications that are not needed any more
        std::uint64_t until = 0;
    };
    StoredEngine engine;
    std::vector<StoredSession> sessions{};  // new or changed, as the subscriptions and commands
    std::vector<StoredSubscription> subscriptions{};
    std::vector<StoredCommand> commands{};
    std::vector<StoredNotification> notifications{};
    std::vector<std::uint64_t> ended{};  // sessions, with all that belongs to them
    std::vector<Gone> unsubscribed{};
    std::vector<Gone> forgotten_commands{};
    std::vector<Forgotten> forgotten_notifications{};
};

// Everything that is stored. Ordered by session.
struct StoredState {
    StoredEngine engine;
    std::vector<StoredSession> sessions{};
    std::vector<StoredSubscription> subscriptions{};
    std::vector<StoredCommand> commands{};
    std::vector<StoredNotification> notifications{};  // of each session by sequence
};

class Journal {
public:
    virtual ~Journal() = default;
    // Begins to store the changes, and returns at once. Afterwards calls Engine::stored or Engine::not_stored, on another thread
    // and with the engine locked. The engine gives no more changes before that, and those that are not stored again later.
    virtual void store(std::shared_ptr<Changes const>) noexcept = 0;
    // Keeps at once whether everything is stopped: a stop that was answered must outlive the process, also if the disk takes long
    // to store the changes. Returns at once.
    virtual void keep_stop(bool is_stopped) noexcept = 0;
    // Why no command may begin, because it might not be possible to store its end; empty: commands may begin.
    virtual std::string why_no_commands() const = 0;
};

}  // namespace rois
