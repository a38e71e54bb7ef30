#include "core/subscriptions.hpp"

#include <algorithm>

#include "xml/codec/codec.hpp"

namespace rois::client {

namespace {

std::string key_of(Subscribe operation) {
    operation.inline_results = false;
    return xml::encode(Request{std::move(operation), {}});
}

}  // namespace

bool Subscription::has_streams() const {
    return std::ranges::any_of(streams, [](auto const& stream) { return !stream.expired(); });
}

Subscription& Subscriptions::of(Subscribe const& operation, SubscribeId const& engine_id) {
    auto id = engine_id;
    while (find(id) != nullptr) id.text += '+';  // an id of an earlier session: each session counts from 1
    auto& found = known_[key_of(operation)];
    if (!found) {
        found = std::make_unique<Subscription>();
        found->operation = operation;
        found->id = std::move(id);
    }
    found->engine_id = engine_id;
    found->operation.inline_results = found->operation.inline_results || operation.inline_results;
    return *found;
}

Subscription* Subscriptions::find(Subscribe const& operation) {
    auto const found = known_.find(key_of(operation));
    return found == known_.end() ? nullptr : found->second.get();
}

Subscription* Subscriptions::find(SubscribeId const& id) {
    auto const found = std::ranges::find_if(known_, [&](auto const& each) { return each.second->id == id; });
    return found == known_.end() ? nullptr : found->second.get();
}

Subscriptions::Receivers Subscriptions::receivers_of(ReceiveEvent& event) {
    Receivers receivers;
    auto const engine_id = event.subscribe_id;
    for (auto const& [key, subscription] : known_) {
        if (subscription->engine_id != engine_id) continue;
        event.subscribe_id = subscription->id;
        for (auto const& weak : subscription->streams)
            if (auto stream = weak.lock()) receivers.emplace_back(subscription->id, std::move(stream));
    }
    return receivers;
}

std::vector<std::shared_ptr<detail::Stream>> Subscriptions::streams() {
    std::vector<std::shared_ptr<detail::Stream>> list;
    for (auto const& [key, subscription] : known_)
        for (auto const& weak : subscription->streams)
            if (auto stream = weak.lock()) list.push_back(std::move(stream));
    return list;
}

std::vector<SubscribeId> Subscriptions::forget_unused() {
    std::vector<SubscribeId> over;
    for (auto each = known_.begin(); each != known_.end();) {
        auto const& subscription = *each->second;
        if (subscription.has_streams() || subscription.by_request) {
            ++each;
            continue;
        }
        if (!needs_no_unsubscribe(subscription)) over.push_back(subscription.engine_id);
        each = known_.erase(each);
    }
    return over;
}

void Subscriptions::forget(SubscribeId const& id) {
    std::erase_if(known_, [&](auto const& each) { return each.second->id == id; });
}

bool Subscriptions::needs_no_unsubscribe(Subscription const& one) const {
    return one.engine_id.text.empty() || std::ranges::any_of(known_, [&](auto const& each) {
               return each.second.get() != &one && each.second->engine_id == one.engine_id;
           });
}

std::vector<Subscription*> Subscriptions::all() {
    std::vector<Subscription*> list;
    list.reserve(known_.size());
    for (auto const& [key, subscription] : known_) list.push_back(subscription.get());
    return list;
}

}  // namespace rois::client
