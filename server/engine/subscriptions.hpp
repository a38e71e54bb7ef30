// Who hears of which events (decisions 18 to 21).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/filter.hpp"
#include "engine/perspective.hpp"
#include "types/ids.hpp"
#include "types/messages.hpp"

namespace rois {

class NotificationQueue;
class RegisteredComponent;
struct Session;

// An event type and a condition, and those who asked for it.
struct Subscription {
    std::uint64_t number = 0;  // in the order of subscribing
    SubscribeId id;
    std::string event_type;
    Filter filter;
    // Its keys in OfType. Kept so that the subscription can be removed without allocating memory.
    std::string const* meaning = nullptr;
    std::optional<Demand> demand;
    struct Hearer {
        Session* session;
        std::uint64_t number;      // the session's
        std::uint32_t slot;        // copy of the session's slot in Details, to read without the session
        NotificationQueue* queue;  // the session's own queue, to read without the session
        bool inline_results;
    };
    std::vector<Hearer> hearers;  // in the order in which their sessions connected
};

// Kept both ways: a subscription knows its sessions, a session its subscriptions.
class Subscriptions {
public:
    // Null when nobody has this one.
    Subscription* find(std::string_view event_type, Filter const&) const;

    // The same type and condition give the same subscription; the last `inline_results` wins.
    Subscription& add(Session&, std::string const& event_type, Filter, bool inline_results);

    // Nothing happens when the session has none of that id.
    void remove(Session&, SubscribeId const&);
    void remove_all(Session&);

    // Those of an event type to which alone this component may matter, in the order of subscribing.
    std::vector<Subscription*> possible(std::string_view event_type, RegisteredComponent const&) const;

    // The sessions that have subscribed to an event that this component has and may match, whatever happens.
    std::set<Session*> hearers(RegisteredComponent const&, Perspective& ever) const;

    std::size_t size() const { return by_id_.size(); }
    std::size_t predicates() const { return predicates_; }  // in the conditions of all subscriptions

private:
    struct Earlier {
        bool operator()(Subscription const* a, Subscription const* b) const { return a->number < b->number; }
    };
    using InOrder = std::set<Subscription*, Earlier>;
    using ByText = std::map<std::string, InOrder, std::less<>>;

    // Each is found by all refs and types that its condition demands, or is one of the others.
    struct OfType {
        ByText by_ref;
        ByText by_type;
        InOrder others;
        std::unordered_map<std::string, Subscription*> by_meaning;  // of their filters

        void add(Subscription&);  // changes nothing if it throws
        void remove(Subscription&) noexcept;
    };

    Subscription& keep(std::unique_ptr<Subscription>);
    static void part(Session&, Subscription&);
    void forget_if_unheard(Subscription&) noexcept;

    std::unordered_map<SubscribeId, std::unique_ptr<Subscription>, IdHash> by_id_;
    std::map<std::string, OfType, std::less<>> by_type_;
    std::uint64_t last_ = 0;
    std::size_t predicates_ = 0;
};

}  // namespace rois
