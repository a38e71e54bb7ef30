// The HRI engine (section 7.2): sessions, components, commands, queries and events behind one door.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/component.hpp"
#include "engine/journal.hpp"
#include "engine/memory_budget.hpp"
#include "engine/motion_lease.hpp"
#include "engine/notification_queue.hpp"
#include "engine/places.hpp"
#include "engine/settings.hpp"
#include "types/messages.hpp"

namespace rois {

// The engine's door to those who carry notifications to their receivers. Called from within the engine's own calls.
class Outbox {
public:
    virtual ~Outbox() = default;
    // The session's queue has something to read, or was closed. Must not throw.
    virtual void notify(NotificationQueue&) = 0;
    // `notify` will be called soon: what that needs may be prefetched.
    virtual void approach(NotificationQueue const&) const {}
};

// Why an operation did not run at all; the network layer makes a fault of it.
enum class Refusal : std::uint8_t { no_session, too_many_sessions, no_memory, shutting_down };

// Components that come and go at once (profile_changed).
struct ComponentChange {
    std::vector<std::string> going;  // refs
    std::vector<std::unique_ptr<Component>> coming;
    std::vector<ComponentProfile> known_profiles;  // among which sub components are looked up from now on
};

// Numbers for /metrics, counted since the start.
struct SessionStatistics {
    std::uint64_t number = 0;  // in the order of connecting, from 1: unlike the id it is no secret
    Steady connected;
    std::vector<std::string> bound;  // refs
    std::size_t commands = 0;        // that wait or run
    std::size_t subscriptions = 0;
    std::size_t waiting_notifications = 0;
};

struct LimitStatistics {
    std::string_view of;
    std::size_t most = 0;
    std::uint64_t reached = 0;  // how often something was refused, dropped or ended because of it
};

struct EngineStatistics {
    std::size_t sessions = 0;                  // now
    std::uint64_t sessions_replaced = 0;       // idle ones that ended for a new one
    std::size_t components = 0;                // now
    std::size_t subscriptions = 0;             // now: distinct event types with conditions
    std::uint64_t commands_completed[5] = {};  // by CompletedStatus
    std::uint64_t events = 0;
    std::uint64_t notifications = 0;
    std::uint64_t notifications_lost = 0;
    std::uint64_t errors = 0;
    std::uint64_t stray_answers = 0;              // of components: late, double or of nobody
    bool everything_is_stopped = false;           // decision 34
    std::size_t not_halted = 0;                   // components that have not confirmed a halt
    std::vector<SessionStatistics> each_session;  // ordered by number
    std::vector<LimitStatistics> limits;
    std::size_t memory_budget = 0;  // bytes; 0: there is no limit
    std::size_t memory_used = 0;    // of it
};

// Plain and single-threaded: all calls, also those to a session's NotificationQueue, are made by one thread at a time. Time is
// passed in and never goes back on `steady`. A call runs everything that it causes before it returns.
class Engine {
public:
    using FreshSecret = std::function<std::string()>;  // an unguessable text of 128 bits or more, fit for an XML attribute

    // `profile` names the engine; its components and sub profiles are filled in as components are added.
    Engine(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings, Outbox&, FreshSecret);
    ~Engine();
    Engine(Engine const&) = delete;
    Engine& operator=(Engine const&) = delete;

    // Reports to this journal from now on; without one, to nobody. It must live until the last call of the engine.
    void report_to(Journal&);

    // From now on the engine checks this budget before it accepts anything that it must keep. Without a budget there is no limit.
    // The owner of the budget measures it, and keeps it until after the last call of the engine.
    void keep_within(MemoryBudget&);

    // Before the first session. Throws std::runtime_error for a ref that is taken or a sub component profile that is unknown.
    void add(std::unique_ptr<Component>);
    void add(std::shared_ptr<Device>);

    // At any time; all of it or nothing: throws std::runtime_error for a ref that is taken or unknown, or a sub component profile
    // that is unknown. What runs on a component that goes, or waits for it, completes with ABORT; its bindings are lost;
    // subscriptions stay, and hear it again should it come back. New components are halted first. All sessions are notified when
    // any component came or went.
    void change(ComponentChange, Instant now);

    // The frames that components and applications tell positions in, and the places that conditions speak of; none is known
    // before. Once, before the first session.
    void describe(Places);

    // Performs an operation for the session (an empty id: for nobody yet). The notifications that it causes are in the session's
    // queue when it returns. `Connect` opens a session unless `session` is one already;
    // when all places are taken, it ends the one that has been idle for longest, without link, binding and subscription. `Resume`
    // only checks that its session can be taken over from `last_sequence`; reading on from there is the caller's.
    std::variant<Reply, Refusal> handle(SessionId const& session, Operation const&, Instant now);

    // Halts all components, which may be moving already, and performs the first tick. To be called once, before `handle`.
    void begin(Instant now);

    // Does what is due by now: devices, delays, timeouts, expiry, sessions whose link was lost.
    void tick(Instant now);

    // Null when there is no such session. Whoever keeps it can read what the session was told last, also after its end.
    std::shared_ptr<NotificationQueue> notifications(SessionId const&) const;

    // The session's link. The gateway received an HTTP request or a pong of the session, or a WebSocket or notification stream of
    // it opened or closed. Operations renew the motion lease by themselves.
    void heard_from(SessionId const&, Instant now);
    void heard_pong(SessionId const&, Instant now);
    void link_opened(SessionId const&, Link, Instant now);
    void link_closed(SessionId const&, Link, Closing, Instant now);

    // Ends one session as if disconnected; nothing happens when there is none.
    void end(SessionId const&, Instant now);

    // Stop for everything (decision 34): halts every component, bound or not, and ends all commands with ABORT. Nothing starts
    // until `clear`. All sessions are notified, also those that are opened until then.
    void stop_everything(Instant now);
    void clear();
    bool everything_is_stopped() const;
    // Refs of the components that were told to halt and have not confirmed that they stand still (decision 35).
    std::vector<std::string> not_halted() const;
    // Those of them for which the engine is not ready: their halt has failed, it is their first one, or everything is stopped.
    std::vector<std::string> not_ready() const;

    // Ends every session, and refuses what comes later.
    void shut_down(Instant now);

    std::shared_ptr<EngineProfile const> profile() const;
    // All components, ordered by ref.
    std::vector<ComponentEntry> components() const;
    EngineStatistics statistics() const;

private:
    class Core;
    std::unique_ptr<Core> core_;
};

}  // namespace rois
