#include "engine/notifications/subscriptions.hpp"

#include <algorithm>
#include <utility>

#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

namespace {

void take_out(auto& by_text, std::string_view text, Subscription* subscription) {
    auto const found = by_text.find(text);
    if (found == by_text.end()) return;
    found->second.erase(subscription);
    if (found->second.empty()) by_text.erase(found);
}

// The position of the session's entry, or where to insert it.
auto place_of(Session const& session, Subscription& subscription) {
    return std::ranges::lower_bound(subscription.subscribers, session.number, {}, &Subscription::Subscriber::number);
}

}  // namespace

void Subscriptions::OfType::add(Subscription& subscription) {
    subscription.demand = subscription.filter.demand();
    auto const& demand = subscription.demand;
    try {
        auto const [place, is_only] = by_meaning.emplace(subscription.filter.meaning(), &subscription);
        if (is_only) subscription.meaning = &place->first;
        if (!demand) without_demand.insert(&subscription);
        if (!demand) return;
        for (auto const ref : demand->refs) by_ref[std::string{ref}].insert(&subscription);
        for (auto const type : demand->types) by_type[std::string{type}].insert(&subscription);
    } catch (...) {
        remove(subscription);
        throw;
    }
}

void Subscriptions::OfType::remove(Subscription& subscription) noexcept {
    if (subscription.meaning != nullptr) by_meaning.erase(by_meaning.find(*subscription.meaning));
    without_demand.erase(&subscription);
    if (!subscription.demand) return;
    for (auto const ref : subscription.demand->refs) take_out(by_ref, ref, &subscription);
    for (auto const type : subscription.demand->types) take_out(by_type, type, &subscription);
}

Subscription* Subscriptions::find(std::string_view event_type, Filter const& filter) const {
    auto const alike = by_type_.find(event_type);
    if (alike == by_type_.end()) return nullptr;
    auto const known = alike->second.by_meaning.find(filter.meaning());
    return known == alike->second.by_meaning.end() ? nullptr : known->second;
}

Subscription::Subscriber const* Subscriptions::subscriber(Session const& session, Subscription& subscription) {
    auto const found = session.subscriptions.find(subscription.id.text);
    bool const has_it = found != session.subscriptions.end() && found->second == &subscription;
    return has_it ? &*place_of(session, subscription) : nullptr;
}

Subscription& Subscriptions::add(Session& session, std::string const& event_type, Filter filter, bool inline_results) {
    auto* known = find(event_type, filter);
    if (known != nullptr && session.subscriptions.contains(known->id.text) && subscriber(session, *known) == nullptr)
        known = nullptr;  // another subscription of the session has its id
    return add(session, event_type, std::move(filter), inline_results, known, {"s-" + std::to_string(last_ + 1)});
}

Subscription& Subscriptions::restore(Session& session, SubscribeId const& id, Subscribe const& asked, Filter filter) {
    auto* known = find(asked.event_type, filter);
    if (known != nullptr && known->id != id) known = nullptr;
    return add(session, asked.event_type, std::move(filter), asked.inline_results, known, id);
}

// Once the subscription is in the session's own list, no step can throw.
Subscription& Subscriptions::add(Session& session, std::string const& event_type, Filter filter, bool inline_results,
                                 Subscription* subscription, SubscribeId const& id) {
    if (subscription == nullptr) {
        auto made = std::make_unique<Subscription>();
        made->number = ++last_;
        made->id = id;
        made->event_type = event_type;
        made->filter = std::move(filter);
        subscription = &keep(std::move(made));
        predicates_ += subscription->filter.predicates();
    }
    auto& subscribers = subscription->subscribers;
    bool added = false;
    try {
        if (subscribers.size() == subscribers.capacity()) subscribers.reserve(2 * subscribers.size() + 1);
        added = session.subscriptions.emplace(subscription->id.text, subscription).second;
    } catch (...) {
        remove_if_unused(*subscription);
        throw;
    }
    auto const place = place_of(session, *subscription);
    if (added) {
        session.predicates += subscription->filter.predicates();
        session.condition_bytes += subscription->filter.text_bytes();
        subscribers.insert(place, {&session, session.number, session.events.slot, session.notifications.get(),
                                   session.rights.get(), inline_results});
    } else {
        place->inline_results = inline_results;
    }
    return *subscription;
}

Subscription& Subscriptions::keep(std::unique_ptr<Subscription> made) {
    auto& of_type = by_type_[made->event_type];
    auto const place = all_.emplace(made->number, nullptr).first;
    try {
        of_type.add(*made);
    } catch (...) {
        all_.erase(place);
        throw;
    }
    place->second = std::move(made);
    return *place->second;
}

bool Subscriptions::remove(Session& session, SubscribeId const& id) {
    auto const found = session.subscriptions.find(id.text);
    if (found == session.subscriptions.end()) return false;
    auto& subscription = *found->second;
    session.subscriptions.erase(found);
    part(session, subscription);
    remove_if_unused(subscription);
    return true;
}

void Subscriptions::remove_all(Session& session) {
    unused_.reserve(unused_.size() + session.subscriptions.size());
    while (!session.subscriptions.empty()) {
        auto* const subscription = session.subscriptions.begin()->second;
        session.subscriptions.erase(session.subscriptions.begin());
        part(session, *subscription);
        if (subscription->subscribers.empty()) unused_.push_back(subscription->number);
    }
    forget_within_limit();
}

void Subscriptions::forget_unused() noexcept {
    left_to_delete_ = most_at_once;
    forget_within_limit();
}

void Subscriptions::forget_within_limit() noexcept {
    for (; left_to_delete_ > 0 && !unused_.empty(); unused_.pop_back()) {
        auto const found = all_.find(unused_.back());
        if (found == all_.end() || !found->second->subscribers.empty()) continue;
        auto const cost = found->second->filter.predicates() + 1;
        left_to_delete_ -= std::min(left_to_delete_, cost);
        remove_if_unused(*found->second);
    }
}

void Subscriptions::part(Session& session, Subscription& subscription) {
    subscription.subscribers.erase(place_of(session, subscription));
    session.predicates -= subscription.filter.predicates();
    session.condition_bytes -= subscription.filter.text_bytes();
}

std::vector<Subscription*> Subscriptions::possible(std::string_view event_type, RegisteredComponent const& component) const {
    std::vector<Subscription*> all;
    auto const found = by_type_.find(event_type);
    if (found == by_type_.end()) return all;
    auto const& of_type = found->second;
    auto const add = [&](InOrder const& more) {
        auto const middle = all.insert(all.end(), more.begin(), more.end());
        std::ranges::inplace_merge(all, middle, {}, &Subscription::number);
    };
    add(of_type.without_demand);
    if (auto const alike = of_type.by_type.find(component.type_key()); alike != of_type.by_type.end()) add(alike->second);
    if (component.is_member) std::erase_if(all, [](auto const* each) { return members_for(each->filter) == Members::hidden; });
    if (auto const of_ref = of_type.by_ref.find(component.ref().code); of_ref != of_type.by_ref.end()) add(of_ref->second);
    auto const again = std::ranges::unique(all);
    all.erase(again.begin(), again.end());
    return all;
}

std::set<Session*> Subscriptions::possible_subscribers(RegisteredComponent const& component,
                                                       std::function<bool(Subscription const&)> const& may_ever_match) const {
    std::set<Session*> sessions;
    for (auto const& message : component.profile().messages) {
        if (message.kind != MessageKind::event) continue;
        for (auto const* subscription : possible(message.name, component))
            if (!subscription->subscribers.empty() && may_ever_match(*subscription))
                for (auto const& subscriber : subscription->subscribers)
                    if (may_see(subscriber.rights, component.ref().code)) sessions.insert(subscriber.session);
    }
    return sessions;
}

void Subscriptions::remove_if_unused(Subscription& subscription) noexcept {
    if (!subscription.subscribers.empty()) return;
    predicates_ -= subscription.filter.predicates();
    by_type_.find(subscription.event_type)->second.remove(subscription);
    all_.erase(all_.find(subscription.number));
}

}  // namespace rois
