// The subscriptions of the application, and the streams that receive their events (decision 20).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/stream.hpp"
#include "types/messages.hpp"

namespace rois::client {

// A subscription to one event type with one condition.
struct Subscription {
    Subscribe operation;
    SubscribeId id;           // for the application: the engine's first id, made unique if another subscription has it
    SubscribeId engine_id;    // the engine's id in this session; empty if the engine refused the subscription
    bool by_request = false;  // the application has sent `subscribe` itself
    std::vector<std::weak_ptr<detail::Stream>> streams;

    bool has_streams() const;
};

// Used on the client's thread only.
class Subscriptions {
public:
    // Returns the subscription with this type and condition; adds it if it is missing.
    Subscription& of(Subscribe const&, SubscribeId const& engine_id);
    // Null if there is none.
    Subscription* find(Subscribe const&);
    Subscription* find(SubscribeId const& id);

    // Returns the streams of this event, each with its subscribe_id, and sets the event's subscribe_id to one of these.
    using Receivers = std::vector<std::pair<SubscribeId, std::shared_ptr<detail::Stream>>>;
    Receivers receivers_of(ReceiveEvent&);
    std::vector<std::shared_ptr<detail::Stream>> streams();

    // Removes the subscriptions that are no longer used. Returns the engine's ids to unsubscribe.
    std::vector<SubscribeId> forget_unused();
    void forget(SubscribeId const& id);
    // Whether the engine has refused this subscription, or another one shares its engine_id.
    bool needs_no_unsubscribe(Subscription const&) const;

    std::vector<Subscription*> all();

private:
    std::map<std::string, std::unique_ptr<Subscription>> known_;  // by type and condition
};

}  // namespace rois::client
