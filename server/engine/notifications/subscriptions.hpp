// The subscriptions of all sessions to events (decisions 18 to 21).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/conditions/filter.hpp"
#include "engine/frames/perspective.hpp"
#include "types/ids.hpp"
#include "types/messages.hpp"

namespace rois {

class NotificationQueue;
class RegisteredComponent;
class Rights;
struct Session;

// An event type and a condition, and the sessions that subscribed to this pair.
struct Subscription {
    std::uint64_t number = 0;  // in the order of subscribing
    SubscribeId id;
    std::string event_type;
    Filter filter;
    // The keys in OfType. Kept so that removing the subscription needs no memory.
    std::string const* meaning = nullptr;  // null: another subscription with this meaning is listed
    std::optional<Demand> demand;
    struct Subscriber {
        Session* session;
        std::uint64_t number;      // number of the session
        std::uint32_t slot;        // copy of the session's slot in Details, to read it without the session
        NotificationQueue* queue;  // copy of the session's queue, likewise
        Rights const* rights;      // copy of the session's rights, likewise
        bool inline_results;
    };
    std::vector<Subscriber> subscribers;  // ordered by session number; empty: it waits for being deleted
};

// A subscription knows its sessions, and a session its subscriptions.
class Subscriptions {
public:
    // Returns the subscription, or null if no session has it.
    Subscription* find(std::string_view event_type, Filter const&) const;

    // Returns the session's entry in the subscription, or null.
    static Subscription::Subscriber const* subscriber(Session const&, Subscription&);

    // Subscribes a session. The same event type and condition give the same subscription; the last `inline_results` wins.
    Subscription& add(Session&, std::string const& event_type, Filter, bool inline_results);

    // The same, with the id from before a restart. It may be that of another pair, or this pair may have another id: conditions
    // that meant the same may have parted since, or come together.
    Subscription& restore(Session&, SubscribeId const&, Subscribe const&, Filter);
    // New ids continue after the last one.
    std::uint64_t last_id() const { return last_; }
    void continue_ids(std::uint64_t last) { last_ = last; }

    // Returns false if the session has no subscription with this id.
    bool remove(Session&, SubscribeId const&);
    // Many subscriptions without a session are only deleted by the next calls of `forget_unused`.
    void remove_all(Session&);

    // Deletes subscriptions that no session has any more. Call it in each tick: at once, very many would take too long.
    void forget_unused() noexcept;

    // Returns the subscriptions to this event type that the component may concern, in the order of subscribing.
    std::vector<Subscription*> possible(std::string_view event_type, RegisteredComponent const&) const;

    // Returns the sessions with a subscription that an event of this component may ever match.
    std::set<Session*> possible_subscribers(RegisteredComponent const&,
                                            std::function<bool(Subscription const&)> const& may_ever_match) const;

    std::size_t size() const { return all_.size(); }
    std::size_t predicates() const { return predicates_; }  // in the conditions of all subscriptions

private:
    struct Earlier {
        bool operator()(Subscription const* a, Subscription const* b) const { return a->number < b->number; }
    };
    using InOrder = std::set<Subscription*, Earlier>;
    using ByText = std::map<std::string, InOrder, std::less<>>;

    // Each subscription is listed under all refs and types that its condition demands, or else in `without_demand`.
    struct OfType {
        ByText by_ref;
        ByText by_type;
        InOrder without_demand;
        std::unordered_map<std::string, Subscription*> by_meaning;  // by the canonical text of the filter; the first of each

        void add(Subscription&);  // changes nothing if it throws
        void remove(Subscription&) noexcept;
    };

    // Adds the session to `known`, or to a new subscription if it is null.
    Subscription& add(Session&, std::string const& event_type, Filter, bool inline_results, Subscription* known,
                      SubscribeId const& id);
    Subscription& keep(std::unique_ptr<Subscription>);
    static void part(Session&, Subscription&);
    void remove_if_unused(Subscription&) noexcept;
    void forget_within_limit() noexcept;

    static constexpr std::size_t most_at_once = 5'000;  // predicates of subscriptions that are deleted in a tick: some 10 ms

    std::unordered_map<std::uint64_t, std::unique_ptr<Subscription>> all_;  // by number
    std::map<std::string, OfType, std::less<>> by_type_;
    std::uint64_t last_ = 0;
    std::size_t predicates_ = 0;
    std::vector<std::uint64_t> unused_;          // numbers of subscriptions to be deleted, unless a session has them again
    std::size_t left_to_delete_ = most_at_once;  // predicates, in this tick
};

}  // namespace rois
