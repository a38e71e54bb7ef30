// A session of a service application (decisions 1 to 3): its bindings, subscriptions and commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/commands/command.hpp"
#include "engine/commands/deadlines.hpp"
#include "engine/commands/motion_lease.hpp"
#include "engine/conditions/effort.hpp"
#include "engine/journal/journal.hpp"
#include "engine/notifications/details.hpp"
#include "engine/notifications/notification_queue.hpp"
#include "types/codes.hpp"
#include "types/ids.hpp"
#include "types/instant.hpp"

namespace rois {

class RegisteredComponent;
class Rights;
struct Subscription;

// Owned by the engine. Plain data without functions.
struct Session {
    Session(MotionLease::Terms const& terms, Steady now)
        : connected{now}, lease{terms, now}, last_activity{now}, quiet_until{now} {}

    std::shared_ptr<NotificationQueue> notifications;
    SessionId id;
    std::uint64_t number = 0;              // in the order of connecting
    std::shared_ptr<Rights const> rights;  // of the client that opened it, and the only one that may use it; null: no limits
    Steady connected;
    Details::Asker events;  // decides which details the session may ask for (decision 24)
    Details::Asker errors;

    std::set<RegisteredComponent*> bound;
    std::vector<StoredBinding> absent;  // bindings from before a restart, until their components have returned and confirmed them
    std::map<std::string_view, Subscription*> subscriptions;  // by id
    std::map<std::string, Subscribe> absent_subscriptions;    // from before a restart, to events that no component has yet
    std::size_t predicates = 0;                               // total in the conditions of the subscriptions
    std::size_t condition_bytes = 0;                          // total length of the texts in these conditions
    Effort::Account effort;                                   // for matching conditions
    Effort::Account deliveries;                               // of events to its subscriptions with a condition
    std::uint64_t missed = 0;  // the last event (Core::event_) that was not compared with a condition of it
    std::unordered_map<CommandId, std::shared_ptr<Command>, IdHash> commands;  // all known commands (decision 17)
    std::list<std::shared_ptr<Command>> ended;  // the ended commands of `commands`, oldest end first
    std::size_t live_commands() const { return commands.size() - ended.size(); }

    // The session's links (decision 2). Before `quiet_until` they do not count as lost.
    MotionLease lease;
    Steady last_activity;  // the last HTTP request, or the last end of a link
    Steady quiet_until;
    std::optional<Deadlines::Ticket> end_of_window;  // when to check whether the link is lost

    // After this time without a link, the session ends.
    std::chrono::milliseconds window{};

    std::uint64_t last_stop = 0;  // number of the last stop of everything that it has asked for
    bool owns_stop = false;       // that stop does not end before this session has cleared it

    bool receives_switches = false;  // of all components

    bool is_stored = false;        // the journal keeps it
    bool has_been_stored = false;  // once, perhaps as it was earlier

    // The client is another engine (decision 39), or a logical component.
    bool is_engine = false;
    std::shared_ptr<RegisteredComponent> owner;  // the logical component (own_sessions.cpp)
    std::uint64_t delivered = 0;                 // sequence of the last notification that the owner was called with
    struct Notified {
        Steady at;
        ComponentStatus status = ComponentStatus::uninitialized;
        std::uint64_t state = 0;  // RegisteredComponent::reported_states
    };
    std::map<RegisteredComponent const*, Notified> notified;  // the last component_changed of each component

    // The session is ending: requests do not find it. If ending it fails for lack of memory, the next tick continues.
    bool ending = false;
    std::string_view why_it_ends;  // a string literal
};

}  // namespace rois
