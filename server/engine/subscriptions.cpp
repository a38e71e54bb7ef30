#include "engine/subscriptions.hpp"

#include <algorithm>
#include <utility>

#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

Subscription* Subscriptions::find(std::string_view event_type, Filter const& filter) const {
    auto const alike = by_type_.find(event_type);
    if (alike == by_type_.end()) return nullptr;
    auto const known = alike->second.by_meaning.find(filter.meaning());
    return known == alike->second.by_meaning.end() ? nullptr : known->second;
}

Subscription& Subscriptions::add(Session& session, std::string const& event_type, Filter filter, bool inline_results) {
    auto* subscription = find(event_type, filter);
    if (subscription == nullptr) {
        auto made = std::make_unique<Subscription>();
        made->id.text = "s-" + std::to_string(++last_);
        made->event_type = event_type;
        made->filter = std::move(filter);
        subscription = made.get();
        auto& alike = by_type_[event_type];
        alike.all.push_back(subscription);
        alike.by_meaning.emplace(subscription->filter.meaning(), subscription);
        by_id_.emplace(subscription->id, std::move(made));
    }
    subscription->sessions[&session] = inline_results;
    if (session.subscriptions.insert(subscription).second) session.predicates += subscription->filter.predicates();
    return *subscription;
}

void Subscriptions::remove(Session& session, SubscribeId const& id) {
    auto const found = by_id_.find(id);
    if (found == by_id_.end()) return;
    auto& subscription = *found->second;
    if (!subscription.sessions.contains(&session)) return;
    session.subscriptions.erase(&subscription);
    part(session, subscription);
    forget_if_unheard(subscription);
}

void Subscriptions::remove_all(Session& session) {
    for (auto* subscription : std::exchange(session.subscriptions, {})) {
        part(session, *subscription);
        forget_if_unheard(*subscription);
    }
}

void Subscriptions::part(Session& session, Subscription& subscription) {
    subscription.sessions.erase(&session);
    session.predicates -= subscription.filter.predicates();
}

std::vector<Subscription*> const& Subscriptions::of(std::string_view event_type) const {
    static std::vector<Subscription*> const none;
    auto const found = by_type_.find(event_type);
    return found == by_type_.end() ? none : found->second.all;
}

bool Subscriptions::hears(Session const& session, RegisteredComponent const& component, Perspective& ever) {
    return std::ranges::any_of(session.subscriptions, [&](Subscription const* subscription) {
        return find_message(component.profile(), MessageKind::event, subscription->event_type) != nullptr &&
               subscription->filter.match(ever.candidate(component)) != Match::no;
    });
}

void Subscriptions::forget_if_unheard(Subscription& subscription) {
    if (!subscription.sessions.empty()) return;
    auto& alike = by_type_[subscription.event_type];
    std::erase(alike.all, &subscription);
    alike.by_meaning.erase(subscription.filter.meaning());
    by_id_.erase(subscription.id);
}

}  // namespace rois
