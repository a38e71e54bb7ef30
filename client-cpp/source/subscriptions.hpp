// What the application has subscribed to, and which streams hear it (decision 20).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "stream.hpp"
#include "types/messages.hpp"

namespace rois::client {

// One event type with one condition, as the application has written it.
struct Subscription {
    Subscribe operation;
    SubscribeId id;           // as the application knows it: the first that the engine gave, unless another one has that
    SubscribeId engine_id;    // as the engine knows it in this session; empty when it refused to
    bool by_request = false;  // the application has subscribed itself, beside the streams
    std::vector<std::weak_ptr<detail::Stream>> streams;

    bool heard() const;  // whether a stream is left
};

// Lives on the client's thread.
class Subscriptions {
public:
    // The one with this type and condition; made when there is none.
    Subscription& of(Subscribe const&, SubscribeId const& engine_id);
    // Null when there is none.
    Subscription* find(Subscribe const&);
    Subscription* find(SubscribeId const& id);

    // The streams that hear this event, with the subscribe_id that each of them knows; the event's becomes one of these.
    using Hearing = std::vector<std::pair<SubscribeId, std::shared_ptr<detail::Stream>>>;
    Hearing hearing(ReceiveEvent&);
    std::vector<std::shared_ptr<detail::Stream>> streams();

    // Forgets those that nobody hears any more, and gives the engine's ids that are to be ended.
    std::vector<SubscribeId> forget_unheard();
    void forget(SubscribeId const& id);
    // Whether the engine has nothing to end with it: another one is the same there, or it has none.
    bool ends_nothing(Subscription const&) const;

    // All, to make them anew.
    std::vector<Subscription*> all();

private:
    std::map<std::string, std::unique_ptr<Subscription>> known_;  // by type and condition
};

}  // namespace rois::client
