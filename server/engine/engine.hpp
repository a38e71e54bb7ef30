// The HRI engine (section 7.2): sessions, components, commands, queries and events behind one interface.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/commands/motion_lease.hpp"
#include "engine/component.hpp"
#include "engine/frames/places.hpp"
#include "engine/journal/journal.hpp"
#include "engine/memory_budget.hpp"
#include "engine/notifications/notification_queue.hpp"
#include "engine/providers/provider.hpp"
#include "engine/rights.hpp"
#include "engine/settings.hpp"
#include "engine/trace.hpp"
#include "types/messages.hpp"

namespace rois {

// Notifies the network layer that a session has notifications to read. Called from within calls to the engine.
class Outbox {
public:
    virtual ~Outbox() = default;
    // Called when the session's queue has new entries, or was closed. Must not throw.
    virtual void notify(NotificationQueue&) = 0;
    // Called after calls of `notify`, before the engine releases the lock in `work`.
    virtual void flush() noexcept {}
};

// Why an operation was not performed at all. The network layer answers with a fault.
enum class Refusal : std::uint8_t { no_session, too_many_sessions, no_memory, shutting_down, not_allowed };

// An operation that waits for its answer. The engine shares it until then.
class Asked {
public:
    // `from`: the notifications of the session that asks; null: the client has none. Notifications that the operation causes wait
    // until the hold is released (decision 22). 0: there is no hold. A session can only be used with the rights with which it was
    // opened, which are compared by address. Null: no limits. `over_http`: the client may have no link to its session.
    Asked(std::shared_ptr<NotificationQueue> from, NotificationQueue::Hold until_answered,
          std::shared_ptr<Rights const> of_client = nullptr, bool over_http = false)
        : notifications{std::move(from)}, hold{until_answered}, rights{std::move(of_client)}, is_over_http{over_http} {}
    virtual ~Asked() = default;
    Asked(Asked const&) = delete;
    Asked& operator=(Asked const&) = delete;

    virtual Operation const& operation() const = 0;
    // One of these is called once, within a call to the engine. They must not call the engine.
    virtual void answer(Reply&&) = 0;
    virtual void refuse(Refusal) = 0;

    std::shared_ptr<NotificationQueue> const notifications;
    NotificationQueue::Hold const hold;
    std::shared_ptr<Rights const> const rights;
    bool const is_over_http;
};

// The profiles, frames and places of a provider of components. The engine knows them while the provider has components.
struct Belongings {
    std::vector<ComponentProfile> profiles;  // in which the engine looks up sub components
    std::vector<Frame> frames;               // placed in frames of the engine, or in one another
    std::vector<NamedPlace> places;
    std::map<std::string, std::vector<ParameterProfile>> engines{};  // by name: the parameters of the profiles of its sub engines
    Space space{};  // of a sub engine: frames and places that are left out if they are invalid or known already
};

// Components to remove and to add in one step (profile_changed).
struct ComponentChange {
    std::vector<std::string> going;  // refs of the components to remove
    std::vector<std::unique_ptr<Component>> coming;
    Belongings belongings;      // replaces the earlier ones of the provider
    std::string provider = {};  // empty: the gateway itself
};

// Statistics for /metrics, counted since the start.
struct SessionStatistics {
    std::uint64_t number = 0;  // in the order of connecting, from 1; unlike the session id not a secret
    Steady connected;
    std::vector<std::string> bound;  // refs
    std::size_t commands = 0;        // waiting or running
    std::size_t subscriptions = 0;
    std::size_t waiting_notifications = 0;
};

struct LimitStatistics {
    std::string_view of;
    std::size_t most = 0;
    std::uint64_t reached = 0;  // how often the gateway rejected, dropped or ended something because of it
};

struct EngineStatistics {
    std::size_t sessions = 0;                  // open now
    std::uint64_t sessions_replaced = 0;       // idle sessions that were ended to make room for a new one
    std::size_t components = 0;                // present now
    std::size_t subscriptions = 0;             // present now: distinct pairs of event type and condition
    std::uint64_t commands_completed[5] = {};  // by CompletedStatus
    std::uint64_t events = 0;
    std::uint64_t notifications = 0;
    std::uint64_t notifications_lost = 0;
    std::uint64_t errors = 0;
    std::uint64_t stray_answers = 0;              // answers of components that came late, twice, or for an unknown command
    bool everything_is_stopped = false;           // decision 34
    std::size_t not_halted = 0;                   // components that have not confirmed a halt
    std::vector<SessionStatistics> each_session;  // ordered by number
    std::vector<LimitStatistics> limits;
    std::size_t memory_budget = 0;  // bytes; 0: no limit
    std::size_t memory_used = 0;    // bytes
};

// Not thread-safe: the caller serializes all calls (Gateway holds a mutex). Exceptions: any thread may read from a
// NotificationQueue, which has a lock of its own, and components may report from any thread. The engine never reads a clock or
// opens a file: the caller passes the time, and `steady` must not go back.
//
// Only `work` calls components, with the caller's lock released. Call `work` after `handle`, `begin`, `tick`, `change`, `end`,
// `stop_everything` and `shut_down`: each of them may command a component.
class Engine {
public:
    // Returns an unguessable text of at least 128 bits that is valid in an XML attribute.
    using FreshSecret = std::function<std::string()>;

    // `profile` names the engine. The engine adds components and sub profiles as components are added.
    Engine(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings, Outbox&, FreshSecret);
    ~Engine();
    Engine(Engine const&) = delete;
    Engine& operator=(Engine const&) = delete;

    // Sets the trace, which must outlive the last call to the engine.
    void report_to(Trace&);

    // Stores in the journal what the engine acknowledges. Without a journal, nothing is stored. It must outlive the last call to
    // the engine. Call it before the first session.
    void keep_in(Journal&);
    // Continues with what was stored, after `add` and before `begin`. The commands that waited or ran have ended with ABORT.
    // `rights_of` returns the rights with this id; null: they have been withdrawn, and the session does not return.
    using RightsOf = std::function<std::shared_ptr<Rights const>(std::string const& id)>;
    void restore(StoredState, RightsOf const& rights_of, Instant now);
    // The session of this engine in a sub engine, whose components have this provider, is stored, too. After a restart,
    // `earlier_session` returns it, with the handles of the commands that may have run there. `ended_there` tells how those have
    // ended that the sub engine knows; the others end with ABORT, as all of them do after 10 s.
    struct EarlierSession {
        SessionId id;  // empty: there is none
        std::vector<CommandHandle> commands{};
        std::optional<std::uint64_t> stop{};  // as in `stopped_there`
    };
    EarlierSession earlier_session(std::string const& provider) const;
    void session_opened_there(std::string const& provider, SessionId const&);
    // A stop of everything that this engine has asked for there, and has to clear there (decision 34): its number, or
    // ClearStop::own while the number is not known; nullopt: it is cleared.
    void stopped_there(std::string const& provider, std::optional<std::uint64_t> stop);
    void ended_there(std::string const& provider, std::vector<CommandEnded>, Instant now);
    // Called by the journal, with the engine locked; call `work` afterwards.
    void stored(Instant now);
    void not_stored(Instant now);
    // Calls `then` when all changes until now are stored, or cannot be stored now: at once without a journal, otherwise with the
    // engine locked.
    void when_stored(std::function<void()> then);
    // Call it before the lock is released: gives changes to the journal, and flushes the outbox.
    void flush() noexcept;
    // The queue has notifications that readers were not notified of.
    void published(NotificationQueue&);

    // Sets the memory budget, which the engine checks before it stores data. Without a budget there is no limit. The owner of the
    // budget measures the memory. The budget must outlive the last call to the engine.
    void keep_within(MemoryBudget&);

    // Sets the function that is called when a component has reported something and no thread is in `work`. It is called
    // on any thread, must return at once and not call the engine; `work` must then be called soon.
    void on_report(std::function<void()> wake);

    // From now on, uses what can change while it runs (with_changes).
    void use(EngineSettings const&);

    // Call before the first session. Adds a component. Throws std::runtime_error if its ref is taken or the profile of a sub
    // component is unknown.
    void add(std::unique_ptr<Component>);
    // Adds a device of this provider. Its components have the same provider and `returns_at_once` (ComponentDescription).
    void add(std::shared_ptr<Device>, std::string const& provider, bool returns_at_once = true);

    // Removes and adds components, at any time. Throws std::runtime_error or std::invalid_argument, and changes nothing, if a ref
    // is taken or unknown, a sub component profile is unknown, or a frame or place is invalid or known already. Commands that run
    // on or wait for a removed component complete with ABORT, and its bindings end. Subscriptions stay, and apply again if the
    // component returns. New components are halted first. Notifies all sessions if anything changed, at most once a second.
    // Returns why frames and places of the space are left out.
    std::vector<std::string> change(ComponentChange, Instant now);

    // Sets the gateway's own frames and named places. Call once, before the first session.
    void describe(Places);

    // Performs an operation for the session, and answers it: within this call, or later if a component has to be asked (bind,
    // bind_any, set_parameter, execute, query), at the latest after question_deadline with TIMEOUT. `Connect` opens a session
    // unless the session is open. At the limit of sessions, `Connect` ends the session that has been idle for longest (no link,
    // no binding, no subscription); if no session is idle, it is refused. `Resume` only checks that notifications can be read on
    // from `last_sequence`; the caller reads them.
    void handle(std::shared_ptr<Asked> const&, Instant now);

    // Halts all components, which may be moving. Call once, before `handle`.
    void begin(Instant now);

    // Holds motion whose lease has ended, forgets expired data, ends sessions whose link was lost. The next `work` of the clock
    // advances the devices, and carries out delays and timeouts.
    void tick(Instant now);

    // Calls the components that must be called, and handles their reports, until nothing is left to do. `lock` holds the mutex
    // that serializes the calls to the engine; it is released while components run, and now and then while many reports wait.
    // `clock`: the thread that ticks; only it advances devices, and receives exceptions.
    void work(std::unique_lock<std::mutex>& lock, Instant now, Provider::Runner = Provider::Runner::client);

    // Returns the session's queue, or null, also if the session was opened with other rights. The queue stays readable after the
    // session's end.
    std::shared_ptr<NotificationQueue> notifications(SessionId const&, Rights const* = nullptr) const;
    // Returns whether the session was opened with other rights; false for an unknown one.
    bool is_of_another(SessionId const&, Rights const*) const;
    // Returns whether the session was opened by another engine (decision 39); false for an unknown one.
    bool is_engine(SessionId const&) const;

    // Signs of life, reported by the network layer: a request or pong was received, a WebSocket or notification stream has opened
    // or closed. Operations renew the motion lease without such a report. `note_request` returns what `notifications` does.
    std::shared_ptr<NotificationQueue> note_request(SessionId const&, Instant now, Rights const* = nullptr);
    void note_pong(SessionId const&, Instant now);
    void link_opened(SessionId const&, LinkKind, Instant now);
    void link_closed(SessionId const&, LinkKind, Closing, Instant now);

    // Ends a session, if it exists, as if it had disconnected.
    void end(SessionId const&, Instant now);
    // Ends the sessions whose rights were withdrawn.
    void end_withdrawn(Instant now);

    // Stops everything (decision 34): halts every component, bound or not, and ends all commands with ABORT. Nothing starts until
    // `clear`. Notifies all sessions, also those that are opened before `clear`.
    void stop_everything(Instant now);
    void clear();
    bool everything_is_stopped() const;
    // Sets the function that is called when everything is stopped, and at the end of that: within a call to the engine, before
    // the components are halted. It must return at once and not call the engine.
    void on_stop(std::function<void(bool is_stopped)>);
    // Returns the refs of the components that have not confirmed a halt (decision 35).
    std::vector<std::string> not_halted() const;
    // Returns the components of not_halted() that make the engine report "not ready". While everything is stopped, these are all
    // of them. Otherwise those whose halt has failed, and those that are halted for the first time since the start.
    std::vector<std::string> not_ready() const;

    // Ends every session. Later operations are refused.
    void shut_down(Instant now);
    // Halts all components, of the sub engines too, and begins no command. For a process that cannot go on: unlike
    // `stop_everything`, it does not stop the next one.
    void halt_everything(Instant now);

    // Without the members of logical components, and what the client may not see.
    std::shared_ptr<EngineProfile const> profile(Rights const* = nullptr) const;
    // All components that the client may see, ordered by ref.
    std::vector<ComponentEntry> components(Rights const* = nullptr) const;
    EngineStatistics statistics() const;

private:
    class Core;
    std::unique_ptr<Core> core_;
};

}  // namespace rois
